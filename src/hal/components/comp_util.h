/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp_util.h - what the components written in C have in common. [init]
 */
#ifndef KERF_COMP_UTIL_H
#define KERF_COMP_UTIL_H

#include <rtapi.h>
#include <rtapi_errno.h>
#include <rtapi_math.h>

/* Makes the calling function return the error of `call`, if it is one. */
#define COMP_TRY(call) \
    do { \
        int comp_try_result_ = (call); \
        if(comp_try_result_ < 0) return comp_try_result_; \
    } while(0)

/* How many instances num_chan= or names= ask for; fallback if neither does. tag
 * begins the messages. Returns 1..max, -EINVAL if both are given, -1 if the number
 * is out of range. An empty name ends the list. */
static inline int comp_instances(const char *tag, int num_chan, char *const names[], int max, int fallback)
{
    int n = 0;
    while(n < max && names[n] && names[n][0]) n++;
    if(n && num_chan) {
        rtapi_print_msg(RTAPI_MSG_ERR, "num_chan= and names= are mutually exclusive\n");
        return -EINVAL;
    }
    if(n) return n;
    if(num_chan == 0) num_chan = fallback;
    if(num_chan < 1 || num_chan > max) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: ERROR: invalid number of channels: %d\n", tag, num_chan);
        return -1;
    }
    return num_chan;
}

/* What a scale was before it was first looked at: no value is equal to it, so that the first
 * one is checked, too. */
#define COMP_SCALE_UNSEEN NAN

/* A scale that can divide: 1.0 in place of one that is nearly zero or no number. */
static inline double comp_scale(double scale)
{
    return fabs(scale) >= 1e-20 && isfinite(scale) ? scale : 1.0;
}

#endif
