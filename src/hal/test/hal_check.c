/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_check.c - walks the HAL database and names everything that is not as
 * hal_priv.h promises. Independent of the code that keeps it so.
 */
#include "hal_check.h"

#include <stdio.h>
#include <string.h>
#include "hal_priv.h"

static int wrong;
#define EXPECT(condition, ...)             \
    do {                                   \
        if (!(condition)) {                \
            wrong++;                       \
            fprintf(stderr, "hal_check: "); \
            fprintf(stderr, __VA_ARGS__);  \
            fputc('\n', stderr);           \
        }                                  \
    } while (0)

static const char *const words[] = {"component", "pin", "parameter", "signal", "function", "thread", "alias"};

static bool inside(hal_off at)
{
    return at >= sizeof(struct hal_segment) && at < HAL_SIZE;
}

static struct hal_obj *object(hal_off at)
{
    return halp_ptr(at);
}

static int live_places[HAL_KIND_COUNT], free_places[HAL_KIND_COUNT];

static void look_at_place(struct hal_obj *o, void *arg)
{
    (void)arg;
    EXPECT(o->state == HAL_LIVE || o->state == HAL_FREE, "%s '%s' is in state %d", words[o->kind], o->name, o->state);
    if (o->state == HAL_LIVE) {
        live_places[o->kind]++;
        EXPECT(strlen(o->name) <= HAL_NAME_LEN, "unfinished name");
        EXPECT(halp_find(o->kind == HAL_KIND_ALIAS ? ((struct hal_alias *)o)->target_kind : o->kind, o->name) != NULL,
               "%s '%s' can not be found", words[o->kind], o->name);
    } else {
        free_places[o->kind]++;
    }
}

static int depth_of(hal_off at, const char *low, const char *high, int depth, int *count)
{
    if (!at || depth > 200) {
        EXPECT(depth <= 200, "a tree is deeper than 200");
        return depth;
    }
    EXPECT(inside(at), "a tree leads outside");
    const struct hal_obj *o = object(at);
    ++*count;
    EXPECT((!low || strcmp(low, o->name) < 0) && (!high || strcmp(o->name, high) < 0), "'%s' is misplaced in its tree",
           o->name);
    int a = depth_of(o->left, low, o->name, depth + 1, count);
    int b = depth_of(o->right, o->name, high, depth + 1, count);
    return a > b ? a : b;
}

static void check_order(enum hal_kind kind)
{
    const struct hal_tree *tree = &hal_data->trees[kind];
    bool sorted = kind == HAL_KIND_PIN || kind == HAL_KIND_PARAM || kind == HAL_KIND_SIG || kind == HAL_KIND_FUNCT;
    hal_off before = 0;
    int n = 0, in_tree = 0;
    for (hal_off at = tree->first; at && n <= live_places[kind]; at = object(at)->next, n++) {
        const struct hal_obj *o = object(at);
        EXPECT(o->state == HAL_LIVE && o->kind == kind, "the list of %ss holds something else", words[kind]);
        EXPECT(o->prev == before, "'%s' does not know the one before it", o->name);
        if (before && sorted) {
            EXPECT(strcmp(object(before)->name, o->name) < 0, "'%s' is not in order", o->name);
        } else if (before) {
            EXPECT(object(before)->serial > o->serial, "'%s' is not newest first", o->name);
        }
        before = at;
    }
    if (kind != HAL_KIND_ALIAS) {
        EXPECT(n == live_places[kind], "%d %ss in the list, %d exist", n, words[kind], live_places[kind]);
    }
    if (sorted) {
        depth_of(tree->root, NULL, NULL, 0, &in_tree);
        EXPECT(in_tree == live_places[kind], "%d %ss in the tree, %d exist", in_tree, words[kind], live_places[kind]);
    }
    const struct hal_pool *pool = &hal_data->pools[kind];
    EXPECT((int)pool->nlive == live_places[kind], "%u %ss counted, %d exist", pool->nlive, words[kind],
           live_places[kind]);
    EXPECT((int)pool->nfree == free_places[kind], "%u free %ss counted, %d exist", pool->nfree, words[kind],
           free_places[kind]);
    n = 0;
    for (hal_off at = pool->free_first; at && n <= free_places[kind]; at = object(at)->next, n++) {
        EXPECT(object(at)->state == HAL_FREE, "a free %s is in use", words[kind]);
    }
    EXPECT(n == free_places[kind], "%d free %ss in the list, %d exist", n, words[kind], free_places[kind]);
}

static void check_hash(void)
{
    uint32_t n = 0, live = 0;
    const hal_off *buckets = halp_ptr(hal_data->buckets);
    for (uint32_t b = 0; buckets && b < hal_data->nbuckets; b++) {
        for (hal_off at = buckets[b]; at && n < 10000000; at = object(at)->hash_next, n++) {
            EXPECT(inside(at) && object(at)->state == HAL_LIVE, "bucket %u holds something dead", b);
            EXPECT((object(at)->hash & (hal_data->nbuckets - 1)) == b, "'%s' is in a wrong bucket", object(at)->name);
        }
    }
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        live += (uint32_t)live_places[k];
    }
    EXPECT(n == live && hal_data->nhashed == live, "%u names hashed, %u counted, %u exist", n, hal_data->nhashed, live);
}

static void check_pin(struct hal_pin *pin)
{
    const struct hal_comp *comp = halp_ptr(pin->owner);
    EXPECT(comp && comp->o.state == HAL_LIVE, "pin '%s' has no owner", pin->o.name);
    struct hal_sig *sig = halp_ptr(pin->signal);
    if (sig) {
        EXPECT(sig->o.state == HAL_LIVE && sig->o.kind == HAL_KIND_SIG, "pin '%s' is linked to nothing", pin->o.name);
        EXPECT(sig->type == pin->type, "pin '%s' and its signal differ in type", pin->o.name);
    }
    if (comp) {
        uint64_t points = *(uint64_t *)halp_ptr(pin->var);
        EXPECT(points == comp->base + halp_off(sig ? &sig->value : &pin->own),
               "pin '%s' points elsewhere", pin->o.name);
    }
    const struct hal_alias *a = halp_ptr(pin->alias);
    if (a) {
        EXPECT(a->o.state == HAL_LIVE && a->target == halp_off(pin) && strcmp(a->alias, pin->o.name) == 0,
               "the alias of pin '%s' is another's", pin->o.name);
    }
}

static void check_signal(struct hal_sig *sig)
{
    int in = 0, out = 0, io = 0, n = 0;
    hal_off before = 0;
    for (hal_off at = sig->members; at && n <= live_places[HAL_KIND_PIN]; n++) {
        const struct hal_pin *pin = halp_ptr(at);
        EXPECT(pin->o.state == HAL_LIVE && pin->signal == halp_off(sig), "signal '%s' lists a stranger", sig->o.name);
        EXPECT(pin->member_prev == before, "members of '%s' are not chained", sig->o.name);
        in += (pin->dir & HAL_IN) != 0;
        out += pin->dir == HAL_OUT;
        io += pin->dir == HAL_IO;
        before = at;
        at = pin->member_next;
    }
    EXPECT(in == sig->readers && out == sig->writers && io == sig->bidirs,
           "signal '%s' counts %d/%d/%d pins, has %d/%d/%d", sig->o.name, sig->readers,
           sig->writers, sig->bidirs, in, out, io);
    EXPECT(out <= 1 && !(out && io), "signal '%s' has more than one writer", sig->o.name);
}

static void check_comp(struct hal_comp *c, int *pins, int *params)
{
    EXPECT(halp_find_comp_id(c->comp_id) == c, "component '%s' can not be found by id", c->o.name);
    for (hal_off at = c->pins; at && *pins <= live_places[HAL_KIND_PIN]; ++*pins) {
        const struct hal_pin *pin = halp_ptr(at);
        EXPECT(pin->owner == halp_off(c) && pin->o.state == HAL_LIVE, "component '%s' lists a foreign pin", c->o.name);
        at = pin->owner_next;
    }
    for (hal_off at = c->params; at && *params <= live_places[HAL_KIND_PARAM]; ++*params) {
        const struct hal_param *param = halp_ptr(at);
        EXPECT(param->owner == halp_off(c) && param->o.state == HAL_LIVE, "component '%s' lists a foreign parameter",
               c->o.name);
        at = param->owner_next;
    }
}

static void check_functs(void)
{
    for (struct hal_funct *f = halp_first(HAL_KIND_FUNCT); f; f = halp_next(f)) {
        int users = 0;
        for (struct hal_thread *t = halp_first(HAL_KIND_THREAD); t; t = halp_next(t)) {
            const struct hal_flist *lists[] = {halp_ptr(atomic_load(&t->list)), halp_ptr(atomic_load(&t->inits))};
            for (int l = 0; l < 2; l++) {
                for (uint32_t i = 0; lists[l] && i < lists[l]->count; i++) {
                    const struct hal_obj *o = halp_ptr(lists[l]->functs[i]);
                    EXPECT(o->state == HAL_LIVE && o->kind == HAL_KIND_FUNCT, "thread '%s' runs something dead",
                           t->o.name);
                    users += o == &f->o;
                }
            }
        }
        EXPECT(users == f->users, "function '%s' counts %d users, has %d", f->o.name, f->users, users);
    }
}

int hal_check(void)
{
    wrong = 0;
    memset(live_places, 0, sizeof live_places);
    memset(free_places, 0, sizeof free_places);
    halp_lock();
    halp_drain_inits();
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        halp_each_slot(k, look_at_place, NULL);
    }
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        check_order(k);
    }
    check_hash();
    int pins = 0, params = 0;
    for (struct hal_comp *c = halp_first(HAL_KIND_COMP); c; c = halp_next(c)) {
        check_comp(c, &pins, &params);
    }
    EXPECT(pins == live_places[HAL_KIND_PIN], "components own %d pins, %d exist", pins, live_places[HAL_KIND_PIN]);
    EXPECT(params == live_places[HAL_KIND_PARAM], "components own %d parameters, %d exist", params,
           live_places[HAL_KIND_PARAM]);
    for (struct hal_pin *p = halp_first(HAL_KIND_PIN); p; p = halp_next(p)) {
        check_pin(p);
    }
    for (struct hal_sig *s = halp_first(HAL_KIND_SIG); s; s = halp_next(s)) {
        check_signal(s);
    }
    check_functs();
    halp_unlock();
    return wrong;
}
