/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stores.h - ends the process before a chosen store to memory. For tests.
 *
 * The code under test is compiled with -fsanitize=thread, so that the compiler calls
 * a function before each store; stores.c is that function instead of the sanitizer.
 */
#ifndef STORES_H
#define STORES_H

/* n > 0: the process kills itself before the n-th store from now on. */
extern long stores_left;

#endif
