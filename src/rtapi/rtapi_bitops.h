/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_bitops.h - atomic operations on bit nr (>= 0) of an array of unsigned
 * long. [any] The test_and_ functions return the old bit, 0 or 1. */
#ifndef RTAPI_BITOPS_H
#define RTAPI_BITOPS_H

#define RTAPI_LONG_BIT (8 * (int)sizeof(unsigned long))

static inline volatile unsigned long *rtapi_bit_word(int nr, volatile void *addr)
{
    return (volatile unsigned long *)addr + nr / RTAPI_LONG_BIT;
}
static inline unsigned long rtapi_bit_mask(int nr)
{
    return 1UL << (nr % RTAPI_LONG_BIT);
}
static inline void set_bit(int nr, volatile void *addr)
{
    __atomic_fetch_or(rtapi_bit_word(nr, addr), rtapi_bit_mask(nr), __ATOMIC_SEQ_CST);
}
static inline void clear_bit(int nr, volatile void *addr)
{
    __atomic_fetch_and(rtapi_bit_word(nr, addr), ~rtapi_bit_mask(nr), __ATOMIC_SEQ_CST);
}
static inline int test_bit(int nr, const volatile void *addr)
{
    const volatile unsigned long *word = (const volatile unsigned long *)addr + nr / RTAPI_LONG_BIT;
    return (__atomic_load_n(word, __ATOMIC_SEQ_CST) & rtapi_bit_mask(nr)) != 0;
}
static inline long test_and_set_bit(int nr, volatile void *addr)
{
    unsigned long mask = rtapi_bit_mask(nr);
    return (__atomic_fetch_or(rtapi_bit_word(nr, addr), mask, __ATOMIC_SEQ_CST) & mask) != 0;
}
static inline long test_and_clear_bit(int nr, volatile void *addr)
{
    unsigned long mask = rtapi_bit_mask(nr);
    return (__atomic_fetch_and(rtapi_bit_word(nr, addr), ~mask, __ATOMIC_SEQ_CST) & mask) != 0;
}

#endif
