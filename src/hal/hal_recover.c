/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_recover.c - what dead processes left: half-made changes, components.
 *
 * Thread: [init], with the lock held
 * Method: objects in state LIVE are the truth; everything else is made again from
 *         them. Running it twice, or dying in it, does no harm.
 */
#include "hal_priv.h"

#include <stdlib.h>
#include <string.h>

/* ---- Half-made changes ------------------------------------------------------------ */

static bool live(hal_off off)
{
    const struct hal_obj *o = halp_ptr(off);
    return o && o->state == HAL_LIVE;
}

/* Nothing of these kinds owns others: only LIVE ones stay. */
static void settle_plain(struct hal_obj *o, void *arg)
{
    (void)arg;
    if (o->state != HAL_LIVE) {
        halp_slot_free(o);
    }
}

/* First the components that are being removed or made lose their life, then what
 * belongs to them. */
static void settle_owned(struct hal_obj *o, void *arg)
{
    (void)arg;
    hal_off owner = o->kind == HAL_KIND_PIN     ? ((struct hal_pin *)o)->owner
                    : o->kind == HAL_KIND_PARAM ? ((struct hal_param *)o)->owner
                                                : ((struct hal_funct *)o)->owner;
    if (o->state == HAL_LIVE && live(owner)) {
        return;
    }
    if (o->kind == HAL_KIND_PIN && o->state != HAL_FREE) {
        struct hal_pin *pin = (struct hal_pin *)o;
        if (pin->var && owner) {
            pin->signal = 0;
            *(hal_cell_u64_ *)halp_ptr(pin->var) =
                ((struct hal_comp *)halp_ptr(owner))->base + halp_off(&hal_data->scratch);
        }
    }
    halp_slot_free(o);
}

static void settle_alias(struct hal_obj *o, void *arg)
{
    (void)arg;
    struct hal_alias *a = (struct hal_alias *)o;
    struct hal_obj *target = halp_ptr(a->target);
    hal_off *link = NULL;
    if (o->state == HAL_LIVE && target && target->state == HAL_LIVE && target->kind == a->target_kind) {
        link = target->kind == HAL_KIND_PIN ? &((struct hal_pin *)target)->alias : &((struct hal_param *)target)->alias;
    }
    if (!link || *link != halp_off(a)) {
        halp_slot_free(o);
    } else if (a->ending) {
        strcpy(target->name, a->o.name);
        *link = 0;
        halp_slot_free(o);
    } else {
        strcpy(target->name, a->alias);
    }
}

static void collect(struct hal_obj *o, void *arg)
{
    hal_off **next = arg;
    if (o->state == HAL_LIVE) {
        *(*next)++ = halp_off(o);
    }
}

static void count_live(struct hal_obj *o, void *arg)
{
    *(size_t *)arg += o->state == HAL_LIVE;
}

static int by_serial(const void *a, const void *b)
{
    uint32_t x = ((const struct hal_obj *)halp_ptr(*(const hal_off *)a))->serial;
    uint32_t y = ((const struct hal_obj *)halp_ptr(*(const hal_off *)b))->serial;
    return (x > y) - (x < y);
}

static void relink_pin(struct hal_pin *pin)
{
    struct hal_comp *comp = halp_ptr(pin->owner);
    pin->owner_prev = pin->member_next = pin->member_prev = 0;
    pin->owner_next = comp->pins;
    if (comp->pins) {
        ((struct hal_pin *)halp_ptr(comp->pins))->owner_prev = halp_off(pin);
    }
    comp->pins = halp_off(pin);
    struct hal_sig *sig = halp_ptr(pin->signal);
    if (sig && sig->o.state != HAL_LIVE) {
        if (pin->type != HAL_PORT) {
            halp_copy_value(&pin->own, &sig->value, pin->type);
        }
        pin->signal = 0;
        sig = NULL;
    }
    if (sig) {
        halp_member_add(sig, pin);
    }
    halp_pin_point(pin);
}

static void relink_param(struct hal_param *param)
{
    struct hal_comp *comp = halp_ptr(param->owner);
    param->owner_prev = 0;
    param->owner_next = comp->params;
    if (comp->params) {
        ((struct hal_param *)halp_ptr(comp->params))->owner_prev = halp_off(param);
    }
    comp->params = halp_off(param);
}

static void relink_funct(struct hal_funct *f)
{
    struct hal_comp *comp = halp_ptr(f->owner);
    f->users = 0;
    f->owner_prev = 0;
    f->owner_next = comp->functs;
    if (comp->functs) {
        ((struct hal_funct *)halp_ptr(comp->functs))->owner_prev = halp_off(f);
    }
    comp->functs = halp_off(f);
}

/* Index and cross links of one LIVE object, in the order of enum hal_kind but with
 * signals before pins. */
static void relink(struct hal_obj *o)
{
    halp_reindex(o);
    switch (o->kind) {
    case HAL_KIND_COMP: {
        struct hal_comp *c = (struct hal_comp *)o;
        c->pins = c->params = c->functs = 0;
        break;
    }
    case HAL_KIND_SIG: {
        struct hal_sig *sig = (struct hal_sig *)o;
        sig->members = 0;
        sig->readers = sig->writers = sig->bidirs = 0;
        break;
    }
    case HAL_KIND_PIN: relink_pin((struct hal_pin *)o); break;
    case HAL_KIND_PARAM: relink_param((struct hal_param *)o); break;
    case HAL_KIND_FUNCT: relink_funct((struct hal_funct *)o); break;
    case HAL_KIND_THREAD: halp_thread_filter((struct hal_thread *)o); break;
    default: break;
    }
}

void halp_recover(int dead_pid)
{
    static const enum hal_kind order[] = {HAL_KIND_COMP,  HAL_KIND_SIG,    HAL_KIND_PIN,  HAL_KIND_PARAM,
                                          HAL_KIND_FUNCT, HAL_KIND_THREAD, HAL_KIND_ALIAS};
    halp_index_clear();
    halp_each_slot(HAL_KIND_COMP, settle_plain, NULL);
    halp_each_slot(HAL_KIND_THREAD, settle_plain, NULL);
    halp_each_slot(HAL_KIND_PIN, settle_owned, NULL);
    halp_each_slot(HAL_KIND_PARAM, settle_owned, NULL);
    halp_each_slot(HAL_KIND_FUNCT, settle_owned, NULL);
    halp_each_slot(HAL_KIND_ALIAS, settle_alias, NULL);
    /* Signals last: pins of a dying one still take its value. */
    size_t most = 1;
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        size_t n = 0;
        halp_each_slot(k, count_live, &n);
        most = n > most ? n : most;
    }
    hal_off *items = malloc(most * sizeof *items);
    for (size_t i = 0; items && i < sizeof order / sizeof *order; i++) {
        hal_off *end = items;
        halp_each_slot(order[i], collect, &end);
        qsort(items, (size_t)(end - items), sizeof *items, by_serial);
        for (hal_off *p = items; p < end; p++) {
            relink(halp_ptr(*p));
        }
        if (order[i] == HAL_KIND_PIN) {
            halp_each_slot(HAL_KIND_SIG, settle_plain, NULL);
        }
    }
    free(items);
    hal_data->repairs++;
    atomic_store(&hal_data->dirty, 0);
    halp_err("HAL: ERROR: process %d ended while it changed HAL; the database was repaired\n", dead_pid);
    halp_reap(NULL);
}

/* ---- Components of dead processes ------------------------------------------------------ */

static int count_owned_pins(const struct hal_comp *c)
{
    int n = 0;
    for (hal_off p = c->pins; p; p = ((struct hal_pin *)halp_ptr(p))->owner_next) {
        n++;
    }
    return n;
}

static int count_owned_params(const struct hal_comp *c)
{
    int n = 0;
    for (hal_off p = c->params; p; p = ((struct hal_param *)halp_ptr(p))->owner_next) {
        n++;
    }
    return n;
}

/* What a killed process had switched on must not stay on in the signal: back to the value of power-up. */
static void drop_bits(const struct hal_comp *c)
{
    for (hal_off o = c->pins; o;) {
        struct hal_pin *p = halp_ptr(o);
        o = p->owner_next;
        struct hal_sig *s = p->signal ? halp_ptr(p->signal) : NULL;
        if (s && p->type == HAL_BIT && p->dir == HAL_OUT) {
            s->value.b = 0;
        }
    }
}

static void reap_comp(struct hal_comp *c)
{
    struct hal_process owner = {.pid = c->pid, .start = c->pid_start, .ns = c->pid_ns};
    if (c->type != HAL_COMP_TYPE_USER || !halp_process_gone(&owner)) {
        return;
    }
    halp_err("HAL: ERROR: component '%s' was left by process %d, which ended without hal_exit; "
             "removed with %d pins and "
             "%d parameters\n",
             c->o.name, c->pid, count_owned_pins(c), count_owned_params(c));
    halp_change();
    drop_bits(c);
    halp_comp_remove(c);
}

static void reap_host(void)
{
    struct hal_process host = hal_data->host;
    if (!halp_process_gone(&host)) {
        return;
    }
    int comps = 0, threads = 0;
    struct hal_thread *t;
    halp_change();
    while ((t = halp_first(HAL_KIND_THREAD))) {
        halp_thread_remove(t);
        threads++;
    }
    for (struct hal_comp *c = halp_first(HAL_KIND_COMP), *next; c; c = next) {
        next = halp_next(c);
        if (c->type == HAL_COMP_TYPE_REALTIME) {
            halp_comp_remove(c);
            comps++;
        }
    }
    atomic_store(&hal_data->threads_running, 0);
    hal_data->realtime_type = REALTIME_TYPE_UNINITIALIZED;
    hal_data->host.pid = 0;
    halp_err("HAL: ERROR: the realtime host (process %d) ended without unloading; removed %d "
             "threads and %d components\n",
             host.pid, threads, comps);
}

void halp_reap(struct hal_comp *only)
{
    reap_host();
    if (only) {
        if (only->o.state == HAL_LIVE) {
            reap_comp(only);
        }
        return;
    }
    for (struct hal_comp *c = halp_first(HAL_KIND_COMP), *next; c; c = next) {
        next = halp_next(c);
        reap_comp(c);
    }
}
