/* SPDX-License-Identifier: GPL-2.0-or-later
 * A module without rtapi_app_main. */
void rtapi_app_exit(void);
void rtapi_app_exit(void)
{
}
