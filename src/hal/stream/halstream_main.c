/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * halstream_main.c - command line and life of halsampler and halstreamer.
 */
#include "halstream_main.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "hal.h"
#include "kerf_clock.h"

sig_atomic_t stream_stop;

static void on_signal(int number)
{
    (void)number;
    *(volatile sig_atomic_t *)&stream_stop = 1;
}

/* Value of an option: attached, or the next argument; none counts as "". */
static const char *option_value(int argc, char **argv, int *n)
{
    if (argv[*n][2]) {
        return argv[*n] + 2;
    }
    return ++*n < argc ? argv[*n] : "";
}

static int number(const char *text, long min, long max, long *value)
{
    char *end;
    *value = strtol(text, &end, 10);
    while (isspace((unsigned char)*end)) {
        end++;
    }
    return *end == 0 && *value >= min && *value <= max;
}

int stream_parse(int argc, char **argv, const char *with, struct stream_options *o)
{
    long value;
    int n;
    *o = (struct stream_options){.count = -1};
    for (n = 1; n < argc && argv[n][0] == '-'; n++) {
        const char *arg = argv[n];
        if (arg[1] == 'c') {
            const char *text = option_value(argc, argv, &n);
            if (!number(text, 0, 7, &value)) {
                fprintf(stderr, "ERROR: invalid channel number '%s'\n", text);
                return 1;
            }
            o->channel = (int)value;
        } else if (arg[1] == 'n' && strchr(with, 'n')) {
            const char *text = option_value(argc, argv, &n);
            if (!number(text, 0, 0x7fffffffL, &value)) {
                fprintf(stderr, "ERROR: invalid sample count '%s'\n", text);
                return 1;
            }
            o->count = value;
        } else if (arg[1] == 't' && strchr(with, 't')) {
            o->tag = 1;
        } else {
            fprintf(stderr, "ERROR: unknown option '%s'\n", arg + 1);
            return 1;
        }
    }
    if (argc > n + 1) {
        fprintf(stderr, "ERROR: At most one filename may be specified\n");
        return 1;
    }
    o->file = n < argc ? argv[n] : NULL;
    return 0;
}

int stream_begin(const char *name, int channel)
{
    char comp[HAL_NAME_LEN + 1];
    struct sigaction action = {.sa_handler = on_signal};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    snprintf(comp, sizeof comp, "%s%d", name, channel);
    int id = hal_init(comp);
    if (id < 0) {
        fprintf(stderr, "ERROR: hal_init() failed: %d\n", id);
        return -1;
    }
    hal_ready(id);
    kerf_clock_join(name, KERF_CLOCK_PRIO_USER);
    return id;
}

void stream_end(int comp_id)
{
    kerf_clock_leave();
    hal_exit(comp_id);
}
