/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * watchdog.c - the board's watchdog: only a write pets it; when it bites, all outputs let go.
 */
#include "hm2.h"

enum { TIMER, STATUS, RESET, REGISTERS };

#define PET 0x5A000000u
#define DISABLED 0x80000000u
#define LONGEST 0x7FFFFFFFu
#define HAS_BIT 1

struct watchdog {
    struct hm2_md md;
    hal_bool_t has_bit;
    hal_uint_t timeout_ns;
    rtapi_u32 *status, *reset;         /* as read and as written */
    rtapi_u32 timer;                   /* in the register */
    rtapi_u32 timeout_known;           /* value of timeout_ns that `timer` is for */
    bool told;                         /* this bite */
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(BIT, IO, watchdog, has_bit, "has_bit", 0),
        HM2_ITEM(U32, RW, watchdog, timeout_ns, "timeout_ns", 5000000),
    };
    struct watchdog *s;
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0));
    if(*state) {
        HM2_ERR(hm2, "firmware has two watchdogs: inconsistent firmware\n");
        return -EINVAL;
    }
    s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->md = *md;
    s->timer = DISABLED;
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), s, "watchdog."));
    s->status = hm2_read_region(hm2, hm2_register_addr(md, STATUS, 0), 1);
    s->reset = hm2_write_region(hm2, hm2_register_addr(md, RESET, 0), 1);
    if(!s->status || !s->reset) return -ENOMEM;
    hm2->instances[md->gtag] = 1;
    return 1;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct watchdog *s = state;
    (void)period;
    if(!(*s->status & HAS_BIT)) {
        s->told = false;
        return;
    }
    if(hal_get_bool(s->has_bit)) { /* known; also when it was set by hand */
        s->told = true;
        hm2->io->needs_reset = true;
        return;
    }
    if(s->told && hm2->io->needs_reset) return; /* the user has answered: the next write makes it good */
    HM2_ERR(hm2, "Watchdog has bit! (set the .has-bit pin to False to resume)\n");
    HM2_ERR(hm2, "no write reached the board for %u ns: its outputs are off; look at lateness of the thread (period "
            "%ld ns), at lost packets, and at watchdog.timeout_ns\n", s->timeout_known, hm2->io->period);
    s->told = true;
    hal_set_bool(s->has_bit, 1);
    hm2->io->needs_reset = true;
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct watchdog *s = state;
    (void)hm2;
    (void)period;
    *s->reset = hal_get_bool(s->has_bit) ? 0 : PET;
}

/* The register's value for a time, limited to what it holds. */
static rtapi_u32 timer_of(struct hm2 *hm2, struct watchdog *s, rtapi_u32 timeout_ns)
{
    double ticks = timeout_ns * (s->md.clock / 1e9) - 1;
    if(ticks < 0) return 0;
    if(ticks <= LONGEST) return (rtapi_u32)ticks;
    s->timeout_known = (rtapi_u32)(((double)LONGEST + 1) * 1e9 / s->md.clock);
    hal_set_ui32(s->timeout_ns, s->timeout_known);
    HM2_ERR(hm2, "requested watchdog timeout of %u ns is too long, it is %u ns now\n", timeout_ns, s->timeout_known);
    return LONGEST;
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct watchdog *s = state;
    rtapi_u32 timeout = hal_get_ui32(s->timeout_ns);
    if(hal_get_bool(s->has_bit)) return;
    if(!hm2->written) { /* a bite from before the driver was loaded counts no more */
        if(force) hm2_queue_write(hm2, hm2_register_addr(&s->md, STATUS, 0), 0);
        hm2_write_changed(hm2, hm2_register_addr(&s->md, TIMER, 0), DISABLED, &s->timer, force);
        return;
    }
    bool changed = timeout != s->timeout_known || s->timer == DISABLED;
    if(!changed && !force) return;
    s->timeout_known = timeout;
    rtapi_u32 timer = timer_of(hm2, s, timeout);
    if(changed && s->timeout_known < 1.5 * (double)hm2->io->period)
        HM2_ERR(hm2, "Watchdog timeout (%u ns) is dangerously short compared to hm2_write() period (%ld ns)\n",
                s->timeout_known, hm2->io->period);
    if(force) hm2_queue_write(hm2, hm2_register_addr(&s->md, STATUS, 0), 0);
    hm2_write_changed(hm2, hm2_register_addr(&s->md, TIMER, 0), timer, &s->timer, true);
}

static void print(struct hm2 *hm2, void *state)
{
    struct watchdog *s = state;
    HM2_PRINT(hm2, "Watchdog: timeout_ns %u timer 0x%08X status 0x%08X\n", hal_get_ui32(s->timeout_ns), s->timer,
              *s->status);
}

const struct hm2_function_ops hm2_watchdog = {
    .gtag = {HM2_GTAG_WATCHDOG},
    .claim = claim,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
    .print = print,
};

bool hm2_watchdog_bitten(struct hm2 *hm2)
{
    struct watchdog *s = hm2_state(hm2, &hm2_watchdog);
    return s && hal_get_bool(s->has_bit);
}

void hm2_watchdog_force_bite(struct hm2 *hm2)
{
    struct watchdog *s = hm2_state(hm2, &hm2_watchdog);
    if(s) hm2_write_now(hm2, hm2_register_addr(&s->md, TIMER, 0), 0);
}
