/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_tsan.c - the whole library under ThreadSanitizer: hal-tsan CHANGES [SEED]
 *
 * Four threads make and delete signals, link, unlink, alias, set, read and list at random, each
 * with a component of its own and all with the same signals; two more do what a realtime cycle
 * does: they read and write through the components' pins all the time. A value is one of two
 * patterns, so that a torn one would show.
 */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "hal.h"

/* gcc 12's ThreadSanitizer does not know this way to take a mutex: the library gets this one. */
int pthread_mutex_clocklock(pthread_mutex_t *mutex, clockid_t clock, const struct timespec *until)
{
    (void)clock, (void)until;
    return pthread_mutex_lock(mutex);
}

enum { THREADS = 4, PINS = 6, SIGNALS = 5 };
#define PATTERN_A 0x1111111122222222ULL
#define PATTERN_B 0xeeeeeeeeddddddddULL

struct pins {
    hal_uint_t pin[PINS]; /* even: IN, odd: OUT */
};
static struct pins *all[THREADS];
static long changes;
static _Atomic int over, torn;

static void quiet(msg_level_t level, const char *fmt, va_list ap)
{
    (void)level, (void)fmt, (void)ap;
}

static unsigned next_random(unsigned *state)
{
    return *state = *state * 1664525u + 1013904223u, *state >> 8;
}

static int count(hal_query_t *q, void *arg)
{
    (void)q;
    ++*(int *)arg;
    return 0;
}

static void change(int me, unsigned *rnd)
{
    char pin[64], signal[64], alias[64];
    hal_query_t q = {0};
    int seen = 0;
    snprintf(pin, sizeof pin, "t%u.%u", next_random(rnd) % 4 ? (unsigned)me : next_random(rnd) % THREADS,
             next_random(rnd) % PINS);
    snprintf(signal, sizeof signal, "s%u", next_random(rnd) % SIGNALS);
    snprintf(alias, sizeof alias, "a%u.%u", (unsigned)me, next_random(rnd) % 3);
    switch (next_random(rnd) % 10) {
    case 0: hal_signal_new(signal, HAL_U64); break;
    case 1: hal_signal_delete(signal); break;
    case 2:
    case 3:
    case 4: hal_link(pin, signal); break;
    case 5: hal_unlink(pin); break;
    case 6: hal_pin_alias(pin, next_random(rnd) % 2 ? alias : NULL); break;
    case 7:
        q.name = pin;
        q.pp.type = HAL_U64;
        q.pp.value.u = next_random(rnd) % 2 ? PATTERN_A : PATTERN_B;
        hal_set_p(&q, NULL, NULL);
        break;
    case 8:
        q.name = pin;
        if (hal_get_p(&q, NULL, NULL) == 0 && q.pp.value.u && q.pp.value.u != PATTERN_A && q.pp.value.u != PATTERN_B) {
            torn++;
        }
        break;
    case 9: next_random(rnd) % 2 ? hal_list_p(&q, count, &seen) : hal_list_s(&q, count, &seen); break;
    }
}

static void *changer(void *arg)
{
    int me = (int)(intptr_t)arg & 0xff;
    unsigned rnd = (unsigned)((intptr_t)arg >> 8);
    for (long i = 0; i < changes; i++) {
        change(me, &rnd);
    }
    return NULL;
}

/* References are changed by a link: one load, as the compiler makes for a plain one. */
static hal_uint_t reference(hal_uint_t *where)
{
    return __atomic_load_n(where, __ATOMIC_ACQUIRE);
}

static void *cycle(void *arg)
{
    unsigned long n = (unsigned long)(intptr_t)arg;
    while (!atomic_load(&over)) {
        for (int t = 0; t < THREADS; t++) {
            for (int p = 0; p < PINS; p++) {
                hal_uint_t pin = reference(&all[t]->pin[p]);
                if (p % 2) {
                    hal_set_uint(pin, n++ % 2 ? PATTERN_A : PATTERN_B);
                } else {
                    rtapi_uint value = hal_get_uint(pin);
                    if (value && value != PATTERN_A && value != PATTERN_B) {
                        torn++;
                    }
                }
            }
        }
    }
    return NULL;
}

int main(int argc, char **argv)
{
    pthread_t changers[THREADS], cycles[2];
    unsigned seed = argc > 2 ? (unsigned)atol(argv[2]) : 1;
    int id[THREADS];
    changes = argc > 1 ? atol(argv[1]) : 10000;
    rtapi_set_msg_handler(quiet);
    for (int t = 0; t < THREADS; t++) {
        char name[8];
        snprintf(name, sizeof name, "t%d", t);
        id[t] = hal_init(name);
        all[t] = id[t] > 0 ? hal_malloc(sizeof *all[t]) : NULL;
        for (int p = 0; p < PINS && all[t]; p++) {
            if (hal_pin_new_uint(id[t], p % 2 ? HAL_OUT : HAL_IN, &all[t]->pin[p], 0, "t%d.%d", t, p) != 0) {
                return 1;
            }
        }
        if (!all[t] || hal_ready(id[t]) != 0) {
            return 1;
        }
    }
    for (int c = 0; c < 2; c++) {
        pthread_create(&cycles[c], NULL, cycle, (void *)(intptr_t)c);
    }
    for (int t = 0; t < THREADS; t++) {
        pthread_create(&changers[t], NULL, changer, (void *)(intptr_t)(t | (long)(seed + (unsigned)t) << 8));
    }
    for (int t = 0; t < THREADS; t++) {
        pthread_join(changers[t], NULL);
    }
    over = 1;
    for (int c = 0; c < 2; c++) {
        pthread_join(cycles[c], NULL);
    }
    for (int t = 0; t < THREADS; t++) {
        hal_exit(id[t]);
    }
    printf("%d torn values\n", torn);
    return torn != 0;
}
