/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * board.h - which board this is, and its registers. For tests, the folder KERF_BOARD_ROOT has the files (not for a
 * program that is setuid). In simulated time without that folder registers are memory: no pin moves. [init]
 */
#ifndef KERF_BOARD_H
#define KERF_BOARD_H

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <kerf_clock.h>
#include <rtapi.h>

#define BOARD_MAP_BYTES 4096
#define BOARD_MODEL "/proc/device-tree/model"

static inline const char *board_root(void)
{
    return secure_getenv("KERF_BOARD_ROOT");
}

/* Any board will do: its registers are memory. */
static inline int board_is_simulated(void)
{
    return kerf_clock_is_virtual() && !board_root();
}

/* Where a file of the board is; good until the next call. */
static inline const char *board_path(const char *file)
{
    static char path[256];
    const char *root = board_root();
    snprintf(path, sizeof path, "%s%s", root ? root : "", file);
    return path;
}

/* The text of a file; empty if there is none. Texts of the device tree end with a NUL each: they become blanks. */
static inline void board_text(const char *file, char *text, size_t size)
{
    FILE *f = fopen(board_path(file), "re");
    size_t length = f ? fread(text, 1, size - 1, f) : 0, i;
    if(f) fclose(f);
    while(length && !text[length - 1]) length--;
    for(i = 0; i < length; i++)
        if(!text[i]) text[i] = ' ';
    text[length] = 0;
}

/* A page of registers at an address of a device of memory, 0 or -errno. */
static inline int board_map(const char *device, unsigned long address, volatile rtapi_u32 **registers)
{
    int memory = board_is_simulated(), fd = -1, err;
    void *map;
    if(!memory) fd = rtapi_open_as_root(board_path(device), O_RDWR | O_SYNC);
    if(!memory && fd < 0) return fd;
    map = mmap(NULL, BOARD_MAP_BYTES, PROT_READ | PROT_WRITE, memory ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED, fd,
               memory ? 0 : (off_t)address);
    err = errno;
    if(fd >= 0) close(fd);
    if(map == MAP_FAILED) return -err;
    *registers = map;
    return 0;
}

static inline void board_unmap(volatile rtapi_u32 *registers)
{
    munmap((void *)registers, BOARD_MAP_BYTES);
}

#endif
