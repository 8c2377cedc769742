/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * report.c - operator errors of motmod.   In, out: motion_priv.h   Thread: any
 */
#include <stdarg.h>
#include "motion_priv.h"

static rtapi_msg_handler_t console; /* the handler before ours */

void report_error(const char *fmt, ...)
{
    char line[EMCMOT_ERROR_LEN / 2]; /* the format with a newline */
    va_list ap;
    va_start(ap, fmt);
    if (motion_state_.shared)
        emcmotErrorPutfv(&motion_state_.shared->error, fmt, ap);
    va_end(ap);
    if (!console || rtapi_get_msg_level() < RTAPI_MSG_ERR)
        return;
    rtapi_snprintf(line, sizeof(line), "%s\n", fmt);
    va_start(ap, fmt);
    console(RTAPI_MSG_ERR, line, ap);
    va_end(ap);
}

static void hook(msg_level_t level, const char *fmt, va_list ap)
{
    va_list copy;
    if (level == RTAPI_MSG_ERR && motion_state_.shared) {
        va_copy(copy, ap);
        emcmotErrorPutfv(&motion_state_.shared->error, fmt, copy);
        va_end(copy);
    }
    if (console)
        console(level, fmt, ap);
}

void report_hook(void)
{
    console = rtapi_get_msg_handler();
    rtapi_set_msg_handler(hook);
}

void report_unhook(void)
{
    rtapi_set_msg_handler(console);
}
