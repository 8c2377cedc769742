/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stores.c - what code compiled with -fsanitize=thread calls, see stores.h.
 */
#include "stores.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <unistd.h>

long stores_left;

static void store(void)
{
    if (stores_left > 0 && --stores_left == 0) {
        kill(getpid(), SIGKILL);
    }
}

#define IGNORED(name) \
    void name(void *at); \
    void name(void *at) { (void)at; }
#define STORE(name) \
    void name(void *at); \
    void name(void *at) { (void)at; store(); }
IGNORED(__tsan_func_entry)
IGNORED(__tsan_read1)
IGNORED(__tsan_read2)
IGNORED(__tsan_read4)
IGNORED(__tsan_read8)
IGNORED(__tsan_read16)
IGNORED(__tsan_unaligned_read2)
IGNORED(__tsan_unaligned_read4)
IGNORED(__tsan_unaligned_read8)
IGNORED(__tsan_unaligned_read16)
STORE(__tsan_write1)
STORE(__tsan_write2)
STORE(__tsan_write4)
STORE(__tsan_write8)
STORE(__tsan_write16)
STORE(__tsan_unaligned_write2)
STORE(__tsan_unaligned_write4)
STORE(__tsan_unaligned_write8)
STORE(__tsan_unaligned_write16)

void __tsan_init(void);
void __tsan_init(void) {}
void __tsan_func_exit(void);
void __tsan_func_exit(void) {}
void __tsan_read_range(void *at, size_t n);
void __tsan_read_range(void *at, size_t n) { (void)at, (void)n; }
void __tsan_write_range(void *at, size_t n);
void __tsan_write_range(void *at, size_t n) { (void)at, (void)n, store(); }
void __tsan_atomic_thread_fence(int order);
void __tsan_atomic_thread_fence(int order) { (void)order, __atomic_thread_fence(__ATOMIC_SEQ_CST); }
void __tsan_atomic_signal_fence(int order);
void __tsan_atomic_signal_fence(int order) { (void)order, __atomic_signal_fence(__ATOMIC_SEQ_CST); }

#define ATOMICS(bits, type)                                                                                   \
    type __tsan_atomic##bits##_load(const volatile type *at, int order);                                      \
    type __tsan_atomic##bits##_load(const volatile type *at, int order)                                       \
    {                                                                                                         \
        (void)order;                                                                                          \
        return __atomic_load_n(at, __ATOMIC_SEQ_CST);                                                         \
    }                                                                                                         \
    void __tsan_atomic##bits##_store(volatile type *at, type value, int order);                               \
    void __tsan_atomic##bits##_store(volatile type *at, type value, int order)                                \
    {                                                                                                         \
        (void)order;                                                                                          \
        store();                                                                                              \
        __atomic_store_n(at, value, __ATOMIC_SEQ_CST);                                                        \
    }                                                                                                         \
    type __tsan_atomic##bits##_exchange(volatile type *at, type value, int order);                            \
    type __tsan_atomic##bits##_exchange(volatile type *at, type value, int order)                             \
    {                                                                                                         \
        (void)order;                                                                                          \
        store();                                                                                              \
        return __atomic_exchange_n(at, value, __ATOMIC_SEQ_CST);                                              \
    }                                                                                                         \
    type __tsan_atomic##bits##_fetch_add(volatile type *at, type value, int order);                           \
    type __tsan_atomic##bits##_fetch_add(volatile type *at, type value, int order)                            \
    {                                                                                                         \
        (void)order;                                                                                          \
        store();                                                                                              \
        return __atomic_fetch_add(at, value, __ATOMIC_SEQ_CST);                                               \
    }                                                                                                         \
    type __tsan_atomic##bits##_fetch_sub(volatile type *at, type value, int order);                           \
    type __tsan_atomic##bits##_fetch_sub(volatile type *at, type value, int order)                            \
    {                                                                                                         \
        (void)order;                                                                                          \
        store();                                                                                              \
        return __atomic_fetch_sub(at, value, __ATOMIC_SEQ_CST);                                               \
    }                                                                                                         \
    bool __tsan_atomic##bits##_compare_exchange_strong(volatile type *at, type *expected, type value, int o, int f); \
    bool __tsan_atomic##bits##_compare_exchange_strong(volatile type *at, type *expected, type value, int o, int f) \
    {                                                                                                         \
        (void)o, (void)f;                                                                                     \
        store();                                                                                              \
        return __atomic_compare_exchange_n(at, expected, value, false, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);   \
    }
ATOMICS(8, uint8_t)
ATOMICS(32, uint32_t)
ATOMICS(64, uint64_t)

/* Calls of these (linked with --wrap) may die in the middle, too. */
void *__real_memset(void *to, int byte, size_t n);
void *__wrap_memset(void *to, int byte, size_t n);
void *__wrap_memset(void *to, int byte, size_t n)
{
    store();
    __real_memset(to, byte, n / 2);
    store();
    __real_memset((char *)to + n / 2, byte, n - n / 2);
    return to;
}

void *__real_memcpy(void *to, const void *from, size_t n);
void *__wrap_memcpy(void *to, const void *from, size_t n);
void *__wrap_memcpy(void *to, const void *from, size_t n)
{
    store();
    __real_memcpy(to, from, n / 2);
    store();
    return (char *)__real_memcpy((char *)to + n / 2, (const char *)from + n / 2, n - n / 2) - n / 2;
}

char *__wrap_strcpy(char *to, const char *from);
char *__wrap_strcpy(char *to, const char *from)
{
    size_t n = __builtin_strlen(from) + 1;
    __wrap_memcpy(to, from, n);
    return to;
}
