/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * halstreamer.c - puts lines of numbers into a streamer channel.
 *
 * In:     lines of white-space separated fields; lines with # in front are comments
 * Out:    stream 0x48535430+channel
 * Thread: [user]; waits in the clock's time, 10 ms while the stream is full
 */
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "hal.h"
#include "halstream_main.h"

#define STREAMER_KEY 0x48535430
#define LINE_MAX_CHARS 4000

/* Reads one field at *p of the given type and goes behind it. NULL, or what is wrong. */
static const char *parse_field(const char **p, hal_type_t type, hal_stream_data_u *value)
{
    while (isspace((unsigned char)**p)) {
        ++*p;
    }
    const char *start = *p;
    char *end = (char *)(uintptr_t)start;
    if (!*start) {
        return "premature end of line";
    }
    value->k = 0;
    switch (type) {
    case HAL_BIT:
        if (*start != '0' && *start != '1') {
            return "bit value not 0 or 1";
        }
        value->b = *start == '1';
        end++;
        break;
    case HAL_FLOAT: value->f = strtod(start, &end); break;
    case HAL_U32: value->u = (rtapi_u32)strtoul(start, &end, 10); break;
    case HAL_S32: value->s = (rtapi_s32)strtol(start, &end, 10); break;
    case HAL_U64: value->k = strtoull(start, &end, 10); break;
    case HAL_S64: value->l = strtoll(start, &end, 10); break;
    default: break;
    }
    *p = end;
    if (end == start) {
        return "bad character";
    }
    if (!*end) {
        return "premature end of line";
    }
    return isspace((unsigned char)*end) ? NULL : "bad character";
}

/* 0, or 1 after a message: the line is left out. */
static int parse_line(const char *line, int line_number, const hal_type_t *types, int n, hal_stream_data_u *data)
{
    const char *p = line;
    for (int i = 0; i < n; i++) {
        const char *wrong = parse_field(&p, types[i], &data[i]);
        if (wrong) {
            fprintf(stderr, "line %d, field %d: %s, skipping the line\n", line_number, i, wrong);
            return 1;
        }
    }
    return 0;
}

static void feed(hal_stream_t *stream)
{
    char line[LINE_MAX_CHARS + 1];
    hal_stream_data_u data[HAL_STREAM_MAX_PINS];
    hal_type_t types[HAL_STREAM_MAX_PINS];
    int n = hal_stream_element_count(stream);
    for (int i = 0; i < n; i++) {
        types[i] = hal_stream_element_type(stream, i);
    }
    for (int number = 0; !stream_stop && fgets(line, sizeof line, stdin); number++) {
        if (line[0] == '#' || parse_line(line, number, types, n, data)) {
            continue;
        }
        hal_stream_wait_writable(stream, &stream_stop);
        if (!stream_stop) {
            hal_stream_write(stream, data);
        }
    }
}

int main(int argc, char **argv)
{
    struct stream_options o;
    setlocale(LC_NUMERIC, "C");
    if (stream_parse(argc, argv, "", &o)) {
        return 1;
    }
    if (o.file) {
        int fd = open(o.file, O_RDONLY);
        if (fd < 0) {
            fd = open("/dev/null", O_RDONLY); /* documented: no file is an empty one */
        }
        dup2(fd, STDIN_FILENO);
        close(fd);
    }
    signal(SIGPIPE, SIG_IGN);
    int id = stream_begin("halstreamer", o.channel);
    if (id < 0) {
        return 1;
    }
    hal_stream_t stream;
    int result = hal_stream_attach(&stream, id, STREAMER_KEY + o.channel, NULL);
    if (result < 0) {
        fprintf(stderr, "hal_stream_attach: %s\n", strerror(-result));
    } else {
        feed(&stream);
        hal_stream_detach(&stream);
    }
    stream_end(id);
    return result < 0;
}
