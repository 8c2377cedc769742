/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * clp.h - ladder projects: one .clp file, or a folder with its parts as files.
 */
#ifndef CLP_H
#define CLP_H

#include "classicladder/ladder.h"

#define CLP_MESSAGE 256

/* [task] Replaces the program in l, which must be stopped, by a project. Parts and keys
 * that are not known are left alone; what does not fit into the sizes of l is reported.
 * Returns 0, or -1 with FILE:LINE: what is wrong in message; l is then empty. */
int clp_read(struct ladder *l, const char *path, char message[CLP_MESSAGE]);

#endif
