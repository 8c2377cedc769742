/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_check.h - is the HAL database in order? For tests.
 */
#ifndef HAL_CHECK_H
#define HAL_CHECK_H

/* [user] Walks the whole database (HAL mapped, lock taken inside). Returns how many
 * things are wrong and prints each on standard error. */
int hal_check(void);

#endif
