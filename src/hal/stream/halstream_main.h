/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * halstream_main.h - command line and life of halsampler and halstreamer.
 */
#ifndef HALSTREAM_MAIN_H
#define HALSTREAM_MAIN_H

#include <signal.h>

struct stream_options {
    int channel;        /* 0 to 7 */
    long count;         /* records; < 0: no end */
    int tag;            /* print sample numbers */
    const char *file;   /* NULL: standard input or output */
};

extern sig_atomic_t stream_stop; /* set by SIGINT and SIGTERM */

/* Reads the options; letters of `with` are allowed beside c. 0, or 1 after a message
 * on standard error. */
int stream_parse(int argc, char **argv, const char *with, struct stream_options *o);

/* Makes the component NAME<channel>, ready, and takes a place in the clock's order.
 * Its id, or < 0 after a message. */
int stream_begin(const char *name, int channel);
void stream_end(int comp_id);

#endif
