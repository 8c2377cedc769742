/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_speaker.c - the PC's speaker clicks when one of eight bits changes.
 *
 * Thread: speaker.0.write [any]
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include <hal_parport.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Clicks of the PC's speaker");

#define BASE 0x60               /* of the keyboard controller; its second register has the speaker's line */
#define SYSTEM_CONTROL 1
#define LINE 0x02
#define PINS 8

static struct speaker {
    hal_bool_t pin[PINS];
    rtapi_parport_t io;
    unsigned last;              /* bits of the pins in the cycle before */
    int clicking;               /* the line is inverted until the next cycle */
} *speaker;

static int comp_id;

static void invert_line(void)
{
    rtapi_parport_out(&speaker->io, SYSTEM_CONTROL, rtapi_parport_in(&speaker->io, SYSTEM_CONTROL) ^ LINE);
}

static void write_pins(void *arg, long period)
{
    unsigned bits = 0;
    int n;
    (void)arg;
    (void)period;
    for(n = 0; n < PINS; n++) bits |= (unsigned)(hal_get_bool(speaker->pin[n]) != 0) << n;
    if(speaker->clicking) invert_line();
    speaker->clicking = bits != speaker->last;
    if(speaker->clicking) invert_line();
    speaker->last = bits;
}

static int export_pins(void)
{
    int n;
    speaker = hal_malloc(sizeof *speaker);
    if(!speaker) return -ENOMEM;
    for(n = 0; n < PINS; n++)
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &speaker->pin[n], 0, "speaker.0.pin-%02d-out", n));
    COMP_TRY(hal_parport_get(comp_id, &speaker->io, BASE, 0, RTAPI_PARPORT_OTHER_DEVICE));
    return hal_export_funct("speaker.0.write", write_pins, NULL, 0, 0, comp_id);
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hal_speaker");
    if(comp_id < 0) return comp_id;
    r = export_pins();
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    if(speaker->clicking) invert_line();
    hal_exit(comp_id);
    hal_parport_release(&speaker->io);
}
