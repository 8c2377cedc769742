/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * halsampler.c - prints the records of a sampler channel, one a line.
 *
 * In:     stream 0x48534130+channel
 * Thread: [user]; waits in the clock's time, 10 ms when there is nothing to read
 */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "hal.h"
#include "halstream_main.h"

#define SAMPLER_KEY 0x48534130

static int print_record(const hal_stream_data_u *data, const hal_type_t *types, int n)
{
    for (int i = 0; i < n; i++) {
        switch (types[i]) {
        case HAL_FLOAT: printf("%f ", data[i].f); break;
        case HAL_BIT: fputs(data[i].b ? "1 " : "0 ", stdout); break;
        case HAL_U32: printf("%" PRIu32 " ", data[i].u); break;
        case HAL_S32: printf("%" PRId32 " ", data[i].s); break;
        case HAL_U64: printf("%" PRIu64 " ", data[i].k); break;
        case HAL_S64: printf("%" PRId64 " ", data[i].l); break;
        default: break;
        }
    }
    return putchar('\n') == EOF ? -1 : 0;
}

static void print_all(hal_stream_t *stream, const struct stream_options *o)
{
    hal_stream_data_u data[HAL_STREAM_MAX_PINS];
    hal_type_t types[HAL_STREAM_MAX_PINS];
    int n = hal_stream_element_count(stream);
    unsigned last = 0, sample = 0;
    for (int i = 0; i < n; i++) {
        types[i] = hal_stream_element_type(stream, i);
    }
    for (long left = o->count; left != 0 && !stream_stop; left -= left > 0) {
        hal_stream_wait_readable(stream, &stream_stop);
        if (stream_stop || hal_stream_read(stream, data, &sample) < 0) {
            return;
        }
        if (sample != ++last) {
            printf("overrun\n");
            last = sample;
        }
        if (o->tag) {
            printf("%u ", sample - 1);
        }
        if (print_record(data, types, n) < 0) {
            return;
        }
    }
}

int main(int argc, char **argv)
{
    struct stream_options o;
    if (stream_parse(argc, argv, "nt", &o)) {
        return 1;
    }
    if (o.file) {
        int fd = open(o.file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (fd < 0) {
            fprintf(stderr, "ERROR: could not open '%s': %s\n", o.file, strerror(errno));
            return 1;
        }
        dup2(fd, STDOUT_FILENO);
        close(fd);
    }
    signal(SIGPIPE, SIG_IGN); /* a write fails instead and ends the loop */
    int id = stream_begin("halsampler", o.channel);
    if (id < 0) {
        return 1;
    }
    hal_stream_t stream;
    int result = hal_stream_attach(&stream, id, SAMPLER_KEY + o.channel, NULL);
    if (result < 0) {
        fprintf(stderr, "hal_stream_attach: %s\n", strerror(-result));
    } else {
        print_all(&stream, &o);
        fflush(stdout);
        hal_stream_detach(&stream);
    }
    stream_end(id);
    return result < 0;
}
