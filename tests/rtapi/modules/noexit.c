/* SPDX-License-Identifier: GPL-2.0-or-later
 * A module without rtapi_app_exit. */
int rtapi_app_main(void);
int rtapi_app_main(void)
{
    return 0;
}
