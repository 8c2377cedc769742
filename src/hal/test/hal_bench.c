/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_bench.c - what HAL's database costs, in CPU time per call: hal-bench COUNT...
 *
 * For each count: so many pins and signals are made, every pin is linked, values are looked
 * up by name in random order, and all is taken away again. Part of `make bench`.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "hal.h"

/* CPU time of this process: other work on the machine does not count. */
static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void fail(const char *what, long n)
{
    fprintf(stderr, "hal-bench: %s %ld failed\n", what, n);
    exit(1);
}

#define LOOKUPS 100000

/* Prints one row: seconds for all pins and signals, then microseconds per call. */
static void bench(long count)
{
    char pin[HAL_NAME_LEN + 1], signal[HAL_NAME_LEN + 1];
    int id = hal_init("bench");
    hal_float_t **data = id > 0 ? hal_malloc(count * (long)sizeof *data) : NULL;
    if (!data) {
        fail("component for", count);
    }
    double start = now_s();
    for (long i = 0; i < count; i++) {
        if (hal_pin_float_newf(HAL_IN, &data[i], id, "bench.joint-%ld.value", i) != 0) {
            fail("pin", i);
        }
    }
    hal_ready(id);
    double pins = now_s();
    for (long i = 0; i < count; i++) {
        snprintf(signal, sizeof signal, "signal-%ld", i);
        if (hal_signal_new(signal, HAL_FLOAT) != 0) {
            fail("signal", i);
        }
    }
    double signals = now_s();
    for (long i = 0; i < count; i++) {
        snprintf(pin, sizeof pin, "bench.joint-%ld.value", i);
        snprintf(signal, sizeof signal, "signal-%ld", i);
        if (hal_link(pin, signal) != 0) {
            fail("link", i);
        }
    }
    double links = now_s();
    for (long i = 0; i < LOOKUPS; i++) {
        hal_query_t q = {0};
        snprintf(pin, sizeof pin, "bench.joint-%ld.value", random() % count);
        q.name = pin;
        if (hal_get_p(&q, NULL, NULL) != 0) {
            fail("look-up", i);
        }
    }
    double lookups = now_s();
    hal_statistics_t memory;
    hal_statistics(&memory);
    for (long i = 0; i < count; i++) {
        snprintf(signal, sizeof signal, "signal-%ld", i);
        hal_signal_delete(signal);
    }
    hal_exit(id);
    double end = now_s();
    double each = 1e6 / (double)count;
    printf("%8ld %9.3f s %8.2f %8.2f %8.2f %8.2f %8.2f %8.1f MiB\n", count, links - start, (pins - start) * each,
           (signals - pins) * each, (links - signals) * each, (lookups - links) * 1e6 / LOOKUPS, (end - lookups) * each,
           (double)(memory.mem_total - memory.mem_free) / (1 << 20));
    fflush(stdout);
}

int main(int argc, char **argv)
{
    printf("    pins  make+link   pin us   sig us  link us  find us  away us   memory\n");
    for (int i = 1; i < argc; i++) {
        long count = atol(argv[i]);
        if (count < 1 || hal_lib_init() != 0) {
            fail("count", count);
        }
        bench(count);
        hal_lib_exit(); /* the segment goes with its last user: each count starts anew */
    }
    return 0;
}
