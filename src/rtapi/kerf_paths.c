/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_paths.c - finds the tree from the place of this library or program.
 *
 * Out:    absolute paths, see kerf_paths.h
 * Thread: [init]
 */
#include "kerf_paths.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where modules are installed: below PREFIX, or "=" and an absolute path. */
#ifndef KERF_MODULE_DIR
#define KERF_MODULE_DIR "/lib/linuxcnc/modules"
#endif

#define PATH_LEN 1024 /* longer trees are refused by falling back to /usr */

static const struct {
    const char *in_place; /* below TOP */
    const char *installed; /* below PREFIX; a leading "!" means below SYSCONF, "=" absolute */
} places[KERF_PATH_COUNT] = {
    [KERF_PATH_HOME] = {"", ""},
    [KERF_PATH_BIN] = {"/bin", "/bin"},
    [KERF_PATH_LIB] = {"/lib", "/lib"},
    [KERF_PATH_RTLIB] = {"/rtlib", KERF_MODULE_DIR},
    [KERF_PATH_SCRIPTS] = {"/scripts", "/bin"},
    [KERF_PATH_REALTIME] = {"/scripts/realtime", "/lib/linuxcnc/realtime"},
    [KERF_PATH_RTAPICONF] = {"/scripts/rtapi.conf", "!/linuxcnc/rtapi.conf"},
    [KERF_PATH_HALLIB] = {"/lib/hallib", "/share/linuxcnc/hallib"},
    [KERF_PATH_NMLFILE] = {"/configs/common/linuxcnc.nml", "/share/linuxcnc/linuxcnc.nml"},
    [KERF_PATH_CONFIGS] = {"/configs", "/share/doc/linuxcnc/examples/sample-configs"},
    [KERF_PATH_NCFILES] = {"/nc_files", "/share/linuxcnc/ncfiles"},
    [KERF_PATH_HELP] = {"/docs/help", "/share/doc/linuxcnc"},
    [KERF_PATH_INCLUDE] = {"/include", "/include/linuxcnc"},
    [KERF_PATH_PYTHON] = {"/lib/python", "/lib/python3/dist-packages"},
    [KERF_PATH_TCL] = {"/tcl", "/share/tcltk/linuxcnc"},
    [KERF_PATH_SHARE] = {"/share", "/share"},
    [KERF_PATH_LOCALE] = {"/share/locale", "/share/locale"},
};

static char paths[KERF_PATH_COUNT][PATH_LEN + 64];
static int in_place;
static pthread_once_t paths_once = PTHREAD_ONCE_INIT;

/* Where this code was loaded from: the library's file, or the program's. The
 * program is asked of the kernel: its argv[0] is the caller's word only. */
static int own_file(char *out)
{
    Dl_info info;
    struct link_map *map = NULL;
    if (dladdr1((void *)&kerf_path, &info, (void **)&map, RTLD_DL_LINKMAP) && map && map->l_name[0]) {
        return realpath(map->l_name, out) != NULL;
    }
    return realpath("/proc/self/exe", out) != NULL;
}

/* Cuts file at the last "/lib/" or "/bin/": what stands before it holds both. */
static int cut_at_tree(char *file)
{
    char *end = NULL;
    for (char *p = file; (p = strchr(p, '/')); p++) {
        if (!strncmp(p, "/lib/", 5) || !strncmp(p, "/bin/", 5)) {
            end = p;
        }
    }
    if (!end) {
        return 0;
    }
    *end = 0;
    return 1;
}

static void paths_find(void)
{
    char top[PATH_MAX], probe[PATH_MAX + 16];
    if (!own_file(top) || !cut_at_tree(top) || strlen(top) > PATH_LEN - 64) {
        strcpy(top, "/usr");
    }
    snprintf(probe, sizeof probe, "%s/rtlib", top);
    in_place = access(probe, F_OK) == 0;

    char sysconf_dir[PATH_MAX + 8];
    size_t len = strlen(top);
    if (len >= 4 && !strcmp(top + len - 4, "/usr")) {
        snprintf(sysconf_dir, sizeof sysconf_dir, "%.*s/etc", (int)(len - 4), top);
    } else {
        snprintf(sysconf_dir, sizeof sysconf_dir, "%s/etc", top);
    }
    for (int i = 0; i < KERF_PATH_COUNT; i++) {
        const char *tail = in_place ? places[i].in_place : places[i].installed;
        const char *base = *tail == '!' ? sysconf_dir : *tail == '=' ? "" : top;
        snprintf(paths[i], sizeof paths[i], "%.*s%s", PATH_LEN, base, *tail == '!' || *tail == '=' ? tail + 1 : tail);
    }
}

const char *kerf_path(enum kerf_path_id id)
{
    pthread_once(&paths_once, paths_find);
    return (unsigned)id < KERF_PATH_COUNT ? paths[id] : NULL;
}

int kerf_path_run_in_place(void)
{
    pthread_once(&paths_once, paths_find);
    return in_place;
}
