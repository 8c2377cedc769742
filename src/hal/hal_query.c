/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_query.c - looking at the HAL database and setting values in it.
 *
 * Thread: [user]. Callbacks run with the lock held and may change anything: lists
 *         go on behind the last name they gave.
 */
#include "hal_priv.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int unmapped(const char *who)
{
    halp_err("%s: HAL shared memory not mapped\n", who);
    return -EFAULT;
}

static int invalid(const char *who)
{
    halp_err("%s: Invalid query arguments\n", who);
    return -EINVAL;
}

#define CHECK_MAPPED()             \
    if (!hal_data) {               \
        return unmapped(__func__); \
    }
#define CHECK_ARGS(condition)     \
    if (!(condition)) {           \
        return invalid(__func__); \
    }

/* ---- Values ------------------------------------------------------------------------ */

static hal_query_value_u value_get(const hal_data_u *cell, int type)
{
    hal_query_value_u v = {.u = 0};
    switch (type) {
    case HAL_BIT: v.b = __atomic_load_n((const hal_cell_u8_ *)cell, __ATOMIC_RELAXED) != 0; break;
    case HAL_FLOAT:
    case HAL_S64:
    case HAL_U64: v.u = __atomic_load_n((const hal_cell_u64_ *)cell, __ATOMIC_RELAXED); break;
    case HAL_S32: v.s = __atomic_load_n((const hal_cell_s32_ *)cell, __ATOMIC_RELAXED); break;
    case HAL_U32: v.u = __atomic_load_n((const hal_cell_u32_ *)cell, __ATOMIC_RELAXED); break;
    default: break;
    }
    return v;
}

/* whole: the cell is 8 bytes wide (pins, signals, typed parameters); else exactly
 * the type's width is written. */
static void value_set(hal_data_u *cell, int type, hal_query_value_u v, bool whole)
{
    rtapi_u64 bits;
    switch (type) {
    case HAL_BIT: bits = v.b ? 1 : 0; break;
    case HAL_S32: bits = (rtapi_u64)(rtapi_s64)(rtapi_s32)v.s; break;
    case HAL_U32: bits = (rtapi_u32)v.u; break;
    default: bits = v.u; break;
    }
    if (whole || type == HAL_FLOAT || type == HAL_S64 || type == HAL_U64) {
        __atomic_store_n((hal_cell_u64_ *)cell, bits, __ATOMIC_RELAXED);
    } else if (type == HAL_BIT) {
        __atomic_store_n((hal_cell_u8_ *)cell, (rtapi_u8)bits, __ATOMIC_RELAXED);
    } else {
        __atomic_store_n((hal_cell_u32_ *)cell, (rtapi_u32)bits, __ATOMIC_RELAXED);
    }
}

static const char *comp_name(hal_off comp)
{
    const struct hal_comp *c = halp_ptr(comp);
    return c ? c->o.name : NULL;
}

static int comp_id(hal_off comp)
{
    const struct hal_comp *c = halp_ptr(comp);
    return c ? c->comp_id : 0;
}

/* ---- Pins and parameters -------------------------------------------------------------- */

static void fill_pin(hal_query_t *q, struct hal_pin *pin)
{
    q->name = pin->o.name;
    q->qtype = HAL_QTYPE_PIN;
    q->pp.type = (hal_type_t)pin->type;
    q->pp.ref.u = halp_pin_cell(pin);
    q->pp.value = value_get(halp_pin_cell(pin), pin->type);
    q->pp.dir = (hal_pdir_t)pin->dir;
    q->pp.alias = pin->alias ? ((struct hal_obj *)halp_ptr(pin->alias))->name : NULL;
    q->pp.signal = pin->signal ? ((struct hal_obj *)halp_ptr(pin->signal))->name : NULL;
    q->pp.comp = comp_name(pin->owner);
    q->pp.comp_id = comp_id(pin->owner);
}

static void fill_param(hal_query_t *q, struct hal_param *param)
{
    q->name = param->o.name;
    q->qtype = HAL_QTYPE_PARAM;
    q->pp.type = (hal_type_t)param->type;
    q->pp.ref.u = halp_ptr(param->data);
    q->pp.value = value_get(halp_ptr(param->data), param->type);
    q->pp.dir = (hal_pdir_t)param->dir;
    q->pp.alias = param->alias ? ((struct hal_obj *)halp_ptr(param->alias))->name : NULL;
    q->pp.signal = NULL;
    q->pp.comp = comp_name(param->owner);
    q->pp.comp_id = comp_id(param->owner);
}

/* Finds and fills, pins first unless qtype says parameter. *obj: what was found. */
static int lookup_p(hal_query_t *q, struct hal_obj **obj)
{
    struct hal_obj *found = NULL;
    if (q->qtype != HAL_QTYPE_PARAM && (found = halp_find(HAL_KIND_PIN, q->name))) {
        fill_pin(q, (struct hal_pin *)found);
    } else if (q->qtype != HAL_QTYPE_PIN && (found = halp_find(HAL_KIND_PARAM, q->name))) {
        fill_param(q, (struct hal_param *)found);
    }
    if (!found) {
        return -ENOENT;
    }
    if (obj) {
        *obj = found;
    }
    return q->pp.ref.u ? 0 : -EIO;
}

static bool names_pp(const hal_query_t *q)
{
    return q && q->name &&
           (q->qtype == HAL_QTYPE_ANY || q->qtype == HAL_QTYPE_PIN || q->qtype == HAL_QTYPE_PARAM);
}

int hal_getref_p(hal_query_t *q)
{
    CHECK_MAPPED();
    CHECK_ARGS(names_pp(q));
    halp_lock();
    int result = lookup_p(q, NULL);
    halp_unlock();
    return result;
}

int hal_get_p(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(names_pp(q));
    hal_type_t type = q->pp.type;
    halp_lock();
    int result = lookup_p(q, NULL);
    if (result == 0 && (int)type > 0 && type != q->pp.type) {
        result = -EEXIST;
    }
    if (result == 0 && cb) {
        result = cb(q, arg);
    }
    halp_unlock();
    return result;
}

int hal_set_p(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(names_pp(q));
    hal_type_t type = q->pp.type;
    hal_query_value_u value = q->pp.value;
    if (!cb && (int)type <= 0) {
        halp_err("%s: Must have callback if type is not specified\n", __func__);
        return -EINVAL;
    }
    struct hal_obj *obj = NULL;
    halp_lock();
    int result = lookup_p(q, &obj);
    if (result == 0 && (int)type > 0 && type != q->pp.type) {
        result = -EEXIST;
    } else if (result == 0 && obj->kind == HAL_KIND_PIN && (q->pp.dir == HAL_OUT || q->pp.signal)) {
        result = -EACCES;
    } else if (result == 0 && obj->kind == HAL_KIND_PARAM && q->pp.dir == HAL_RO) {
        result = -EACCES;
    } else if (result == 0 && q->pp.type == HAL_PORT) {
        result = -EBADF;
    }
    if (result == 0 && cb) {
        result = cb(q, arg);
        value = q->pp.value;
    }
    if (result == 0) {
        hal_data_u *cell = (hal_data_u *)q->pp.ref.u;
        bool whole = obj->kind == HAL_KIND_PIN || cell == &((struct hal_param *)obj)->own;
        value_set(cell, obj->kind == HAL_KIND_PIN ? ((struct hal_pin *)obj)->type : ((struct hal_param *)obj)->type,
                  value, whole);
        q->pp.value = value;
    }
    halp_unlock();
    return result;
}

/* ---- Signals ------------------------------------------------------------------------------ */

static void fill_sig(hal_query_t *q, struct hal_sig *sig)
{
    q->name = sig->o.name;
    q->qtype = HAL_QTYPE_SIGNAL;
    q->sig.type = (hal_type_t)sig->type;
    q->sig.ref.u = (hal_uint_t)(void *)&sig->value;
    q->sig.value = value_get(&sig->value, sig->type);
    if (sig->type == HAL_PORT) {
        q->sig.value.u = hal_port_buffer_size(&sig->value.p);
    }
    q->sig.writers = sig->writers;
    q->sig.readers = sig->readers;
    q->sig.bidirs = sig->bidirs;
}

static int lookup_s(hal_query_t *q, struct hal_sig **found)
{
    struct hal_sig *sig = halp_find_sig(q->name);
    if (!sig) {
        return -ENOENT;
    }
    *found = sig;
    return 0;
}

static bool names_sig(const hal_query_t *q)
{
    return q && q->name && (q->qtype == HAL_QTYPE_ANY || q->qtype == HAL_QTYPE_SIGNAL);
}

int hal_getref_s(hal_query_t *q)
{
    CHECK_MAPPED();
    CHECK_ARGS(names_sig(q));
    struct hal_sig *sig;
    halp_lock();
    int result = lookup_s(q, &sig);
    if (result == 0) {
        q->name = sig->o.name;
        q->qtype = HAL_QTYPE_SIGNAL;
        q->sig.type = (hal_type_t)sig->type;
        q->sig.ref.u = (hal_uint_t)(void *)&sig->value;
    }
    halp_unlock();
    return result;
}

int hal_get_s(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(names_sig(q));
    hal_type_t type = q->sig.type;
    struct hal_sig *sig;
    halp_lock();
    int result = lookup_s(q, &sig);
    if (result == 0) {
        fill_sig(q, sig);
        if ((int)type > 0 && type != q->sig.type) {
            result = -EEXIST;
        }
    }
    if (result == 0 && cb) {
        result = cb(q, arg);
    }
    halp_unlock();
    return result;
}

int hal_set_s(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(names_sig(q));
    hal_type_t type = q->sig.type;
    hal_query_value_u value = q->sig.value;
    if (!cb && (int)type <= 0) {
        halp_err("%s: Must have callback if type is not specified\n", __func__);
        return -EINVAL;
    }
    struct hal_sig *sig;
    halp_lock();
    int result = lookup_s(q, &sig);
    if (result < 0) {
        halp_unlock();
        return result;
    }
    q->name = sig->o.name;
    q->qtype = HAL_QTYPE_SIGNAL;
    q->sig.type = (hal_type_t)sig->type;
    q->sig.ref.u = (hal_uint_t)(void *)&sig->value;
    q->sig.value = value_get(&sig->value, sig->type);
    q->sig.writers = sig->writers;
    q->sig.readers = sig->readers;
    q->sig.bidirs = sig->bidirs;
    if (sig->type != HAL_PORT && sig->writers > 0) {
        result = -EACCES;
    } else if ((int)type > 0 && type != q->sig.type) {
        result = -EEXIST;
    } else if (cb) {
        result = cb(q, arg);
        value = q->sig.value;
    }
    if (result == 0) {
        if (sig->type == HAL_PORT) {
            halp_change();
            result = halp_port_alloc(sig, value.u > HAL_PORT_SIZE_MAX ? 0 : (unsigned)value.u);
        } else {
            value_set(&sig->value, sig->type, value, true);
        }
        q->sig.value = value;
    }
    halp_unlock();
    return result;
}

/* ---- Lists ----------------------------------------------------------------------------------- */

/* Walks a kind in order while callbacks may change it. */
struct walk {
    enum hal_kind kind;
    struct hal_obj *at;
    uint32_t changes;
    char name[HAL_NAME_LEN + 1];
};

static struct hal_obj *walk_first(struct walk *w, enum hal_kind kind)
{
    w->kind = kind;
    w->at = halp_first(kind);
    return w->at;
}

/* To be called before the callback that may change things. */
static void walk_mark(struct walk *w)
{
    w->changes = hal_data->trees[w->kind].changes;
    strcpy(w->name, w->at->name);
}

static struct hal_obj *walk_next(struct walk *w)
{
    if (hal_data->trees[w->kind].changes == w->changes) {
        w->at = halp_next(w->at);
    } else {
        w->at = halp_find_above(w->kind, w->name);
    }
    return w->at;
}

int hal_list_p(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(q && cb && (q->qtype == HAL_QTYPE_ANY || q->qtype == HAL_QTYPE_PIN || q->qtype == HAL_QTYPE_PARAM));
    hal_qtype_t which = q->qtype;
    struct walk w;
    int result = 0;
    halp_lock();
    if (which != HAL_QTYPE_PARAM) {
        for (struct hal_obj *o = walk_first(&w, HAL_KIND_PIN); o && result == 0; o = walk_next(&w)) {
            walk_mark(&w);
            fill_pin(q, (struct hal_pin *)o);
            result = cb(q, arg);
        }
    }
    if (which != HAL_QTYPE_PIN && result == 0) {
        for (struct hal_obj *o = walk_first(&w, HAL_KIND_PARAM); o && result == 0; o = walk_next(&w)) {
            walk_mark(&w);
            fill_param(q, (struct hal_param *)o);
            result = cb(q, arg);
        }
    }
    halp_unlock();
    return result;
}

/* Offsets of objects, collected before callbacks run; each is looked at again
 * (same object, still there) before it is given out. */
struct snapshot {
    struct {
        hal_off at;
        uint32_t serial;
    } *items;
    size_t n;
};

static bool snapshot_add(struct snapshot *s, const struct hal_obj *obj)
{
    if ((s->n & (s->n - 1)) == 0) {
        void *more = realloc(s->items, (s->n ? s->n * 2 : 1) * sizeof *s->items);
        if (!more) {
            return false;
        }
        s->items = more;
    }
    s->items[s->n].at = halp_off(obj);
    s->items[s->n].serial = obj->serial;
    s->n++;
    return true;
}

static struct hal_obj *snapshot_get(const struct snapshot *s, size_t i)
{
    struct hal_obj *obj = halp_ptr(s->items[i].at);
    return obj->state == HAL_LIVE && obj->serial == s->items[i].serial ? obj : NULL;
}

static int by_name(const void *a, const void *b)
{
    const struct hal_obj *x = halp_ptr(*(const hal_off *)a), *y = halp_ptr(*(const hal_off *)b);
    return strcmp(x->name, y->name);
}

int hal_list_p_s(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(q && q->name && cb);
    struct snapshot s = {NULL, 0};
    int result = 0;
    halp_lock();
    struct hal_sig *sig = halp_find_sig(q->name);
    if (!sig) {
        result = -ENOENT;
    } else {
        for (struct hal_pin *p = halp_ptr(sig->members); p; p = halp_ptr(p->member_next)) {
            if (!snapshot_add(&s, &p->o)) {
                result = -ENOMEM;
                break;
            }
        }
        if (s.n > 1) {
            qsort(s.items, s.n, sizeof *s.items, by_name);
        }
    }
    for (size_t i = 0; i < s.n && result == 0; i++) {
        struct hal_pin *p = (struct hal_pin *)snapshot_get(&s, i);
        if (p && p->signal == halp_off(sig)) {
            fill_pin(q, p);
            result = cb(q, arg);
        }
    }
    halp_unlock();
    free(s.items);
    return result;
}

int hal_list_s(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(q && cb);
    struct walk w;
    int result = 0;
    halp_lock();
    for (struct hal_obj *o = walk_first(&w, HAL_KIND_SIG); o && result == 0; o = walk_next(&w)) {
        walk_mark(&w);
        fill_sig(q, (struct hal_sig *)o);
        result = cb(q, arg);
    }
    halp_unlock();
    return result;
}

static void fill_comp(hal_query_t *q, struct hal_comp *c)
{
    q->name = c->o.name;
    q->qtype = HAL_QTYPE_COMP;
    q->comp.comp_id = c->comp_id;
    q->comp.type = (hal_comp_type_t)c->type;
    q->comp.pid = c->pid;
    q->comp.ready = c->ready != 0;
    q->comp.insmod = halp_ptr(c->insmod);
}

static bool snapshot_kind(struct snapshot *s, enum hal_kind kind)
{
    for (struct hal_obj *o = halp_first(kind); o; o = halp_next(o)) {
        if (!snapshot_add(s, o)) {
            return false;
        }
    }
    return true;
}

int hal_list_comp(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(q && cb);
    struct snapshot s = {NULL, 0};
    halp_lock();
    halp_reap(NULL);
    int result = snapshot_kind(&s, HAL_KIND_COMP) ? 0 : -ENOMEM;
    for (size_t i = 0; i < s.n && result == 0; i++) {
        struct hal_obj *o = snapshot_get(&s, i);
        if (o) {
            fill_comp(q, (struct hal_comp *)o);
            result = cb(q, arg);
        }
    }
    halp_unlock();
    free(s.items);
    return result;
}

int hal_comp_by_name(const char *name, hal_query_t *q)
{
    CHECK_MAPPED();
    CHECK_ARGS(name);
    halp_lock();
    struct hal_comp *c = (struct hal_comp *)halp_find(HAL_KIND_COMP, name);
    if (c) {
        halp_reap(c);
        c = (struct hal_comp *)halp_find(HAL_KIND_COMP, name);
    }
    if (c && q) {
        fill_comp(q, c);
    }
    halp_unlock();
    return c ? 0 : -ENOENT;
}

int hal_comp_by_id(int id, hal_query_t *q)
{
    CHECK_MAPPED();
    CHECK_ARGS(id > 0);
    halp_lock();
    struct hal_comp *c = halp_find_comp_id(id);
    if (c) {
        halp_reap(c);
        c = halp_find_comp_id(id);
    }
    if (c && q) {
        fill_comp(q, c);
    }
    halp_unlock();
    return c ? 0 : -ENOENT;
}

int hal_list_funct(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(q && cb);
    struct walk w;
    int result = 0;
    halp_lock();
    halp_drain_inits();
    for (struct hal_obj *o = walk_first(&w, HAL_KIND_FUNCT); o && result == 0; o = walk_next(&w)) {
        struct hal_funct *f = (struct hal_funct *)o;
        walk_mark(&w);
        q->name = f->o.name;
        q->qtype = HAL_QTYPE_FUNCT;
        q->funct.comp_id = comp_id(f->owner);
        q->funct.comp = comp_name(f->owner);
        q->funct.users = f->users;
        q->funct.funct = (rtapi_intptr_t)f->funct;
        q->funct.arg = (rtapi_intptr_t)f->arg;
        q->funct.reentrant = f->reentrant != 0;
        result = cb(q, arg);
    }
    halp_unlock();
    return result;
}

static void fill_thread(hal_query_t *q, struct hal_thread *t)
{
    struct hal_comp *c = halp_find_comp_id(t->comp_id);
    q->name = t->o.name;
    q->qtype = HAL_QTYPE_THREAD;
    q->thread.comp_id = t->comp_id;
    q->thread.comp = c ? c->o.name : "?";
    q->thread.priority = t->priority;
    q->thread.period = (long)t->period;
    q->thread.functidx = 0;
    q->thread.funct = NULL;
    q->thread.is_init = false;
}

/* Lists are never changed once published, so one may be walked while callbacks
 * publish others; its memory is used again later than that. */
static int list_functs(hal_query_t *q, struct hal_thread *t, hal_off list, bool is_init, hal_query_cb cb, void *arg)
{
    struct hal_flist *fl = halp_ptr(list);
    uint32_t n = fl ? fl->count : 0;
    int result = 0;
    for (uint32_t i = 0; i < n && result == 0; i++) {
        fill_thread(q, t);
        q->qtype = HAL_QTYPE_THREAD_FUNCT;
        q->thread.functidx = (int)i;
        q->thread.funct = ((struct hal_obj *)halp_ptr(fl->functs[i]))->name;
        q->thread.is_init = is_init;
        result = cb(q, arg);
    }
    return result;
}

int hal_list_thread(hal_query_t *q, hal_query_cb cb, void *arg)
{
    CHECK_MAPPED();
    CHECK_ARGS(q && cb);
    bool functs = q->qtype == HAL_QTYPE_THREAD_FUNCT;
    struct snapshot s = {NULL, 0};
    halp_lock();
    halp_drain_inits();
    int result = snapshot_kind(&s, HAL_KIND_THREAD) ? 0 : -ENOMEM;
    for (size_t i = 0; i < s.n && result == 0; i++) {
        struct hal_thread *t = (struct hal_thread *)snapshot_get(&s, i);
        if (!t) {
            continue;
        }
        fill_thread(q, t);
        result = cb(q, arg);
        if (functs && result == 0) {
            result = list_functs(q, t, atomic_load(&t->list), false, cb, arg);
        }
        if (functs && result == 0) {
            result = list_functs(q, t, atomic_load(&t->inits), true, cb, arg);
        }
    }
    halp_unlock();
    free(s.items);
    return result;
}

/* ---- Legacy ------------------------------------------------------------------------------------ */

int hal_get_pin_value_by_name(const char *name, hal_type_t *type, hal_data_u **data, bool *connected)
{
    if (!hal_data || !name) {
        return -1;
    }
    halp_lock();
    struct hal_pin *pin = halp_find_pin(name);
    if (pin) {
        *type = (hal_type_t)pin->type;
        *data = halp_pin_cell(pin);
        if (connected) {
            *connected = pin->signal != 0;
        }
    }
    halp_unlock();
    return pin ? 0 : -1;
}

int hal_get_signal_value_by_name(const char *name, hal_type_t *type, hal_data_u **data, bool *has_writers)
{
    if (!hal_data || !name) {
        return -1;
    }
    halp_lock();
    struct hal_sig *sig = halp_find_sig(name);
    if (sig) {
        *type = (hal_type_t)sig->type;
        *data = &sig->value;
        if (has_writers) {
            *has_writers = sig->writers > 0;
        }
    }
    halp_unlock();
    return sig ? 0 : -1;
}

int hal_get_param_value_by_name(const char *name, hal_type_t *type, hal_data_u **data)
{
    if (!hal_data || !name) {
        return -1;
    }
    halp_lock();
    struct hal_param *param = halp_find_param(name);
    if (param) {
        *type = (hal_type_t)param->type;
        *data = halp_ptr(param->data);
    }
    halp_unlock();
    return param ? 0 : -1;
}

int hal_statistics(hal_statistics_t *stat)
{
    CHECK_MAPPED();
    CHECK_ARGS(stat);
    halp_lock();
    const struct hal_pool *p = hal_data->pools;
    *stat = (hal_statistics_t){
        .mem_total = (long)hal_data->size,
        .mem_free = (long)(hal_data->top - hal_data->bottom),
        .ncomps = (int)p[HAL_KIND_COMP].nlive,
        .ncomps_free = (int)p[HAL_KIND_COMP].nfree,
        .npins = (int)p[HAL_KIND_PIN].nlive,
        .npins_free = (int)p[HAL_KIND_PIN].nfree,
        .nparams = (int)p[HAL_KIND_PARAM].nlive,
        .nparams_free = (int)p[HAL_KIND_PARAM].nfree,
        .naliases = (int)p[HAL_KIND_ALIAS].nlive,
        .naliases_free = (int)p[HAL_KIND_ALIAS].nfree,
        .nsignals = (int)p[HAL_KIND_SIG].nlive,
        .nsignals_free = (int)p[HAL_KIND_SIG].nfree,
        .nthreads = (int)p[HAL_KIND_THREAD].nlive,
        .nthreads_free = (int)p[HAL_KIND_THREAD].nfree,
        .nfuncts = (int)p[HAL_KIND_FUNCT].nlive,
        .nfuncts_free = (int)p[HAL_KIND_FUNCT].nfree,
    };
    halp_unlock();
    return 0;
}
