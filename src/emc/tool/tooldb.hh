/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tooldb.hh - what the tool file functions need to know of the database program.
 */
#ifndef KERF_TOOLDB_HH
#define KERF_TOOLDB_HH

/// Its path, for messages.
const char *tooldb_program();
/// Random changers: writes ./db_spindle.tbl. 0 or -1.
int tooldb_save_spindle();

#endif
