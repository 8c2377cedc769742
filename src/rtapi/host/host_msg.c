/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_msg.c - messages in the realtime host.
 *
 * In:     rtapi_print and rtapi_print_msg of any thread
 * Out:    stdout (level ALL), stderr (the rest)
 * Thread: the command thread prints at once; others put a text into a ring
 *         [rt] which the thread "rtapi_app:mesg" empties every 10 ms.
 * Method: bounded ring of many writers and one reader at a time; each entry has
 *         a sequence number that says whose turn it is (D. Vyukov's scheme). A
 *         full ring loses the message.
 */
#include "host.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define RING_SIZE 128
#define TEXT_LEN 1020 /* with the NUL */

struct entry {
    _Atomic unsigned turn;
    msg_level_t level;
    char text[TEXT_LEN];
};
static struct entry ring[RING_SIZE];
static _Atomic unsigned ring_head; /* next to write */
static unsigned ring_tail;         /* next to read; under reader_mutex */
static pthread_mutex_t reader_mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_t command_thread;
static bool queueing;

static void ring_put(msg_level_t level, const char *fmt, va_list ap)
{
    unsigned pos = atomic_load_explicit(&ring_head, memory_order_relaxed);
    struct entry *e;
    for (int tries = 0;; tries++) { /* at most as many rounds as writers collide */
        e = &ring[pos % RING_SIZE];
        int diff = (int)(atomic_load_explicit(&e->turn, memory_order_acquire) - pos);
        if (diff < 0 || tries > MAX_TASKS) {
            return;
        }
        if (diff == 0 && atomic_compare_exchange_weak(&ring_head, &pos, pos + 1)) {
            break;
        }
        if (diff > 0) {
            pos = atomic_load_explicit(&ring_head, memory_order_relaxed);
        }
    }
    e->level = level;
    vsnprintf(e->text, TEXT_LEN, fmt, ap);
    atomic_store_explicit(&e->turn, pos + 1, memory_order_release);
}

void host_messages_flush(void)
{
    if (pthread_mutex_lock(&reader_mutex) != 0) {
        return;
    }
    for (;;) {
        struct entry *e = &ring[ring_tail % RING_SIZE];
        if (atomic_load_explicit(&e->turn, memory_order_acquire) != ring_tail + 1) {
            break;
        }
        FILE *to = e->level == RTAPI_MSG_ALL ? stdout : stderr;
        fputs(e->text, to);
        fflush(to);
        atomic_store_explicit(&e->turn, ring_tail + RING_SIZE, memory_order_release);
        ring_tail++;
    }
    pthread_mutex_unlock(&reader_mutex);
}

void rtapi_default_msg_handler(msg_level_t level, const char *fmt, va_list ap)
{
    if (queueing && !pthread_equal(pthread_self(), command_thread)) {
        ring_put(level, fmt, ap);
        return;
    }
    if (queueing) {
        host_messages_flush(); /* keeps the order between tasks and commands */
    }
    FILE *to = level == RTAPI_MSG_ALL ? stdout : stderr;
    vfprintf(to, fmt, ap);
    fflush(to);
}

static void *message_thread(void *arg)
{
    (void)arg;
    pthread_setname_np(pthread_self(), "rtapi_app:mesg");
    struct timespec pause = {0, 10000000};
    for (;;) {
        host_messages_flush();
        nanosleep(&pause, NULL);
    }
    return NULL;
}

void host_messages_init(void)
{
    for (unsigned i = 0; i < RING_SIZE; i++) {
        atomic_store(&ring[i].turn, i);
    }
    command_thread = pthread_self();
    queueing = true;
}

void host_messages_start(void)
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, message_thread, NULL) == 0) {
        pthread_detach(thread);
    }
}
