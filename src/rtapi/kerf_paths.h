/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_paths.h - where the files of this installation are.
 *
 * The tree is found from the place of the library or program that asks, so it
 * may be moved. Run in place when a folder rtlib/ stands beside bin/ or lib/,
 * else the installed layout below the prefix.  [init]
 */
#ifndef KERF_PATHS_H
#define KERF_PATHS_H

#ifdef __cplusplus
extern "C" {
#endif

enum kerf_path_id {      /* run in place (TOP)           installed (PREFIX)              */
    KERF_PATH_HOME,      /* TOP                          PREFIX                          */
    KERF_PATH_BIN,       /* TOP/bin                      PREFIX/bin                      */
    KERF_PATH_LIB,       /* TOP/lib                      PREFIX/lib                      */
    KERF_PATH_RTLIB,     /* TOP/rtlib                    PREFIX/lib/linuxcnc/modules     */
    KERF_PATH_SCRIPTS,   /* TOP/scripts                  PREFIX/bin                      */
    KERF_PATH_REALTIME,  /* TOP/scripts/realtime         PREFIX/lib/linuxcnc/realtime    */
    KERF_PATH_RTAPICONF, /* TOP/scripts/rtapi.conf       SYSCONF/linuxcnc/rtapi.conf     */
    KERF_PATH_HALLIB,    /* TOP/lib/hallib               PREFIX/share/linuxcnc/hallib    */
    KERF_PATH_NMLFILE,   /* TOP/configs/common/linuxcnc.nml  PREFIX/share/linuxcnc/linuxcnc.nml */
    KERF_PATH_CONFIGS,   /* TOP/configs                  PREFIX/share/doc/linuxcnc/examples/sample-configs */
    KERF_PATH_NCFILES,   /* TOP/nc_files                 PREFIX/share/linuxcnc/ncfiles   */
    KERF_PATH_HELP,      /* TOP/docs/help                PREFIX/share/doc/linuxcnc       */
    KERF_PATH_INCLUDE,   /* TOP/include                  PREFIX/include/linuxcnc         */
    KERF_PATH_PYTHON,    /* TOP/lib/python               PREFIX/lib/python3/dist-packages */
    KERF_PATH_TCL,       /* TOP/tcl                      PREFIX/share/tcltk/linuxcnc     */
    KERF_PATH_SHARE,     /* TOP/share                    PREFIX/share                    */
    KERF_PATH_LOCALE,    /* TOP/share/locale             PREFIX/share/locale             */
    KERF_PATH_COUNT
};

/* The absolute path, owned by the library; never NULL for a valid id. The file
 * need not exist. SYSCONF is /etc for the prefix /usr (beside usr/ in a staged
 * tree), else PREFIX/etc. */
const char *kerf_path(enum kerf_path_id id);

/* 1 when this is a run-in-place tree, else 0. */
int kerf_path_run_in_place(void);

#ifdef __cplusplus
}
#endif
#endif
