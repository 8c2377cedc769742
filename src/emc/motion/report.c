/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * report.c - operator errors of motmod.   In, out: motion_priv.h   Thread: any
 */
#include <stdarg.h>
#include <string.h>
#include "motion_priv.h"

static rtapi_msg_handler_t console; /* the handler before ours */

/* A message for the operator has no newline; on the console it is a line of its own. */
static void console_line(msg_level_t level, const char *fmt, va_list ap)
{
    char line[EMCMOT_ERROR_LEN / 2];
    rtapi_snprintf(line, sizeof(line), "%s\n", fmt);
    console(level, line, ap);
}

void report_error(const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    if (motion_state_.shared)
        emcmotErrorPutfv(&motion_state_.shared->error, fmt, ap);
    va_end(ap);
    if (!console || rtapi_get_msg_level() < RTAPI_MSG_ERR)
        return;
    va_start(ap, fmt);
    console_line(RTAPI_MSG_ERR, fmt, ap);
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
    if (!console)
        return;
    if (level == RTAPI_MSG_ERR && fmt[0] && fmt[strlen(fmt) - 1] != '\n')
        console_line(level, fmt, ap);
    else
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
