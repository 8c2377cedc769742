/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_port.c - byte queues between two components.
 *
 * In:     the value of a port pin: where the queue is in HAL memory
 * Thread: [rt] one reader, one writer, no locks; the waits [user]
 * Method: ring with two indices; each is written by one side only (release) and
 *         read by the other (acquire). One byte stays free, so read == write
 *         always means empty.
 */
#include "hal_priv.h"

#include <errno.h>
#include <string.h>
#include "kerf_clock.h"

/* The queue of a port, or NULL after a message. Everything read from shared
 * memory is checked: a stray value must not lead outside of it. */
static struct hal_port_shm *queue(const hal_port_t *port, const char *who, const char *what)
{
    hal_off off = port ? (hal_off)__atomic_load_n(
                             (const hal_cell_u32_ *)(const volatile void *)port, __ATOMIC_ACQUIRE)
                       : 0;
    if (hal_data && off && off < HAL_SIZE - sizeof(struct hal_port_shm)) {
        struct hal_port_shm *q = halp_ptr(off);
        if (q->size > 0 && q->size <= HAL_PORT_SIZE_MAX) {
            return q;
        }
    }
    halp_err("%s: invalid port %s%p\n", who, what, (const void *)(uintptr_t)port);
    return NULL;
}
#define QUEUE(port) queue(port, __func__, "")

static unsigned filled(const struct hal_port_shm *q, unsigned read, unsigned write)
{
    return write >= read ? write - read : q->size - read + write;
}

/* Indices are kept below size even when the memory was damaged. */
static unsigned index_of(const struct hal_port_shm *q, _Atomic uint32_t *at, memory_order order)
{
    unsigned i = atomic_load_explicit(at, order);
    return i < q->size ? i : 0;
}

static unsigned readable(struct hal_port_shm *q)
{
    unsigned write = index_of(q, &q->write, memory_order_acquire);
    return filled(q, index_of(q, &q->read, memory_order_acquire), write);
}

static unsigned writable(struct hal_port_shm *q)
{
    unsigned read = index_of(q, &q->read, memory_order_acquire);
    return q->size - 1 - filled(q, read, index_of(q, &q->write, memory_order_acquire));
}

static void copy_out(struct hal_port_shm *q, char *dest, unsigned count)
{
    unsigned read = index_of(q, &q->read, memory_order_relaxed);
    unsigned first = q->size - read < count ? q->size - read : count;
    memcpy(dest, q->data + read, first);
    memcpy(dest + first, q->data, count - first);
}

static void drop(struct hal_port_shm *q, unsigned count)
{
    unsigned read = index_of(q, &q->read, memory_order_relaxed);
    unsigned to_end = q->size - read;
    atomic_store_explicit(&q->read, count >= to_end ? count - to_end : read + count, memory_order_release);
}

bool hal_port_read(const hal_port_t *port, char *dest, unsigned count)
{
    struct hal_port_shm *q = count ? QUEUE(port) : NULL;
    if (!q || readable(q) < count) {
        return false;
    }
    copy_out(q, dest, count);
    drop(q, count);
    return true;
}

bool hal_port_peek(const hal_port_t *port, char *dest, unsigned count)
{
    struct hal_port_shm *q = count ? QUEUE(port) : NULL;
    if (!q || readable(q) < count) {
        return false;
    }
    copy_out(q, dest, count);
    return true;
}

bool hal_port_peek_commit(const hal_port_t *port, unsigned count)
{
    struct hal_port_shm *q = count ? QUEUE(port) : NULL;
    if (!q || readable(q) < count) {
        return false;
    }
    drop(q, count);
    return true;
}

bool hal_port_write(const hal_port_t *port, const char *src, unsigned count)
{
    struct hal_port_shm *q = count ? QUEUE(port) : NULL;
    if (!q || writable(q) < count) {
        return false;
    }
    unsigned write = index_of(q, &q->write, memory_order_relaxed);
    unsigned to_end = q->size - write;
    unsigned first = to_end < count ? to_end : count;
    memcpy(q->data + write, src, first);
    memcpy(q->data, src + first, count - first);
    atomic_store_explicit(&q->write, count >= to_end ? count - to_end : write + count, memory_order_release);
    return true;
}

unsigned hal_port_readable(const hal_port_t *port)
{
    struct hal_port_shm *q = QUEUE(port);
    return q ? readable(q) : 0;
}

unsigned hal_port_writable(const hal_port_t *port)
{
    struct hal_port_shm *q = QUEUE(port);
    return q ? writable(q) : 0;
}

unsigned hal_port_buffer_size(const hal_port_t *port)
{
    struct hal_port_shm *q = QUEUE(port);
    return q ? q->size : 0;
}

void hal_port_clear(const hal_port_t *port)
{
    struct hal_port_shm *q = queue(port, __func__, "address ");
    if (q) {
        atomic_store_explicit(&q->read, index_of(q, &q->write, memory_order_acquire), memory_order_release);
    }
}

#ifdef ULAPI
#define WAIT_NS 10000000

void hal_port_wait_readable(hal_port_t **port, unsigned count, sig_atomic_t *stop)
{
    while (!(stop && *(volatile sig_atomic_t *)stop) && hal_port_readable(*port) < count) {
        kerf_clock_sleep_ns(WAIT_NS);
    }
}

void hal_port_wait_writable(hal_port_t **port, unsigned count, sig_atomic_t *stop)
{
    while (!(stop && *(volatile sig_atomic_t *)stop) && hal_port_writable(*port) < count) {
        kerf_clock_sleep_ns(WAIT_NS);
    }
}
#endif

/* The buffer stays with the place of the signal in HAL memory and is used again
 * when a later signal there needs no more. Lock held. */
int halp_port_alloc(struct hal_sig *sig, unsigned size)
{
    if (sig->value.p) {
        return -EISCONN;
    }
    if (size == 0 || size > HAL_PORT_SIZE_MAX) {
        return -EINVAL;
    }
    struct hal_port_shm *q = halp_ptr(sig->port);
    if (!q || q->room < size) {
        hal_off at = halp_alloc_high(sizeof *q + size);
        if (!at) {
            return -ENOMEM;
        }
        q = halp_ptr(at);
        q->room = size;
        sig->port = at;
    }
    q->size = size;
    atomic_store(&q->read, 0);
    atomic_store(&q->write, 0);
    __atomic_store_n((hal_cell_u64_ *)&sig->value, halp_off(q), __ATOMIC_RELEASE);
    return 0;
}

int hal_port_alloc(unsigned size, hal_port_t *port);
int hal_port_alloc(unsigned size, hal_port_t *port)
{
    if (!hal_data) {
        return -EFAULT;
    }
    if (!port || size == 0 || size > HAL_PORT_SIZE_MAX) {
        return -EINVAL;
    }
    halp_lock();
    halp_change();
    hal_off at = halp_alloc_high(sizeof(struct hal_port_shm) + size);
    halp_unlock();
    if (!at) {
        return -ENOMEM;
    }
    struct hal_port_shm *q = halp_ptr(at);
    q->room = size;
    q->size = size;
    *port = (int)at;
    return 0;
}
