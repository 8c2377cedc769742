/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tooldata.h - the tool data store and the tool table file.
 *
 * Store:  1001 records in one memory map: a file that other processes attach
 *         ($HOME/.tool.mmap, "<name>.<instance>" in an instance), or a private one.
 * File:   one tool a line; what a save does not understand is kept as it stands.
 * Units:  offsets and diameter in machine units, angles in degrees.
 * Thread: [task]; the map carries its own lock, so any process may read and write.
 * Source: tools reference, sections 2 and 3; canonical sheet, section 5
 */
#ifndef KERF_TOOLDATA_H
#define KERF_TOOLDATA_H

#include "emcpos.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CANON_POCKETS_MAX 1001
#define CANON_TOOL_ENTRY_LEN 256
#define CANON_TOOL_COMMENT_SIZE 40 /* with the final NUL */

typedef struct CANON_TOOL_TABLE {
    int toolno;   /* -1: no tool */
    int pocketno; /* -1: none */
    EmcPose offset;
    double diameter;
    double frontangle, backangle; /* degrees */
    int orientation;              /* 0..9 */
    char comment[CANON_TOOL_COMMENT_SIZE];
} CANON_TOOL_TABLE;

typedef enum { IDX_OK = 0, IDX_NEW, IDX_FAIL } toolidx_t;
typedef enum { DB_NOTUSED = 0, DB_ACTIVE } tooldb_t;
typedef enum { SPINDLE_LOAD = 0, SPINDLE_UNLOAD, TOOL_OFFSET } tool_notify_t;

/* A record without a tool: numbers -1, all else zero. */
CANON_TOOL_TABLE tooldata_entry_init(void);

/* The memory map. Name: default $HOME/.tool.mmap with the instance's suffix. */
void tool_mmap_set_fname(const char *path);
/* Makes (truncates) the file, attaches it and empties the store. toolcurrent, if not
 * NULL, receives a copy of each record written at index 0. 0, or -1 with a message. */
int tool_mmap_creator(CANON_TOOL_TABLE *toolcurrent, int random_toolchanger);
/* Attaches what another process made. 0, or -1 with a message (silent if env is absent). */
int tool_mmap_user(void);
/* Detaches; the creator also unlinks the file. */
void tool_mmap_close(void);
int tool_mmap_is_random_toolchanger(void);
int tool_mmap_is_attached(void);

/* The records. idx 0..1000; 0 is the spindle. */
void tooldata_init(int random_toolchanger);
void tooldata_reset(void);      /* all records without a tool, last index 0 */
int tooldata_last_index_get(void);
void tooldata_last_index_set(int idx);
toolidx_t tooldata_put(CANON_TOOL_TABLE rec, int idx);
toolidx_t tooldata_get(CANON_TOOL_TABLE *rec, int idx);
/* Index of a tool number, -1 when there is none (rules: canonical sheet 5). */
int tooldata_find_index_for_tool(int toolno);

/* Text. buf: CANON_TOOL_ENTRY_LEN bytes; a newline ends it. */
void tooldata_format_toolline(int idx, int ignore_zero_values, CANON_TOOL_TABLE rec, char *buf);
void tooldata_add_init(int start_idx); /* next index for lines of a non-random table */
/* Stores one line. Its index, 0 for a comment or an empty line, -1 when rejected (with a message). */
int tooldata_read_entry(const char *line);

/* The file. 0, or -1 with a message. tooldata_save() writes a new file, syncs and renames it;
 * comment lines, blank lines and lines that were not understood keep their places. */
int tooldata_load(const char *filename);
int tooldata_save(const char *filename);
/* What the last load or save met, one "FILE:LINE:COLUMN: TEXT" a line; "" when all was well.
 * Valid until the next load or save. Printed on standard error too. */
const char *tooldata_problems(void);

/* The database program ([EMCIO]DB_PROGRAM). */
void tooldata_set_db(tooldb_t mode);
int tooldata_db_init(const char *program_with_args, int random_toolchanger);
int tooldata_db_notify(tool_notify_t type, int toolno, int pocketno, CANON_TOOL_TABLE rec);
int tooldata_db_getall(void);
int tooldata_db_active(void); /* 0: none, or it died */

#ifdef __cplusplus
}
#endif
#endif
