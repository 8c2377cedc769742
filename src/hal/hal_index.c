/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_index.c - objects of the HAL database and how they are found.
 *
 * In:     pools of equal places per kind
 * Out:    by name (hash), in order of names (treap and list), newest first
 * Thread: [init], with the lock held
 * Method: separate chaining, table doubled at load 1; treap with the hash of the
 *         name as priority (Seidel and Aragon 1996), neighbours also linked
 */
#include "hal_priv.h"

#include <string.h>

#define CHUNK_HEAD 64
#define FIRST_BUCKETS 1024
/* Places of signals and pins hold values that realtime code may still be writing
 * to; so many wait before the oldest is used again. */
#define PLACES_KEPT 16

static const size_t sizes[HAL_KIND_COUNT] = {
    [HAL_KIND_COMP] = sizeof(struct hal_comp),     [HAL_KIND_PIN] = sizeof(struct hal_pin),
    [HAL_KIND_PARAM] = sizeof(struct hal_param),   [HAL_KIND_SIG] = sizeof(struct hal_sig),
    [HAL_KIND_FUNCT] = sizeof(struct hal_funct),   [HAL_KIND_THREAD] = sizeof(struct hal_thread),
    [HAL_KIND_ALIAS] = sizeof(struct hal_alias),
};

void halp_index_init(void)
{
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        hal_data->pools[k].size = (uint32_t)(sizes[k] + 15) & ~15u;
        hal_data->pools[k].per_chunk = k == HAL_KIND_COMP || k == HAL_KIND_THREAD ? 16 : 64;
    }
}

static bool is_sorted(int kind)
{
    return kind == HAL_KIND_PIN || kind == HAL_KIND_PARAM || kind == HAL_KIND_SIG || kind == HAL_KIND_FUNCT;
}

/* FNV-1a; good spread on short texts. */
static uint32_t hash_name(const char *name)
{
    uint64_t h = 0xcbf29ce484222325ULL;
    for (const unsigned char *p = (const unsigned char *)name; *p; p++) {
        h = (h ^ *p) * 0x100000001b3ULL;
    }
    return (uint32_t)(h ^ (h >> 32));
}

static inline struct hal_obj *obj_at(hal_off off)
{
    return halp_ptr(off);
}

/* ---- Places ------------------------------------------------------------------ */

static struct hal_obj *slot_of(const struct hal_pool *pool, hal_off chunk, uint32_t i)
{
    return halp_ptr(chunk + CHUNK_HEAD + i * pool->size);
}

static struct hal_obj *slot_new(enum hal_kind kind)
{
    struct hal_pool *pool = &hal_data->pools[kind];
    uint32_t keep = kind == HAL_KIND_SIG || kind == HAL_KIND_PIN ? PLACES_KEPT : 0;
    if (pool->nfree > keep) {
        struct hal_obj *obj = obj_at(pool->free_first);
        pool->free_first = obj->next;
        pool->nfree--;
        return obj;
    }
    if (!pool->chunks || pool->used == pool->per_chunk) {
        hal_off chunk = halp_alloc_high(CHUNK_HEAD + (size_t)pool->size * pool->per_chunk);
        if (!chunk) {
            return NULL;
        }
        *(hal_off *)halp_ptr(chunk) = pool->chunks;
        pool->used = pool->per_chunk; /* until the store below the old chunk is full */
        HALP_COMMIT(pool->chunks, chunk);
        HALP_COMMIT(pool->used, 0);
    }
    struct hal_obj *obj = slot_of(pool, pool->chunks, pool->used);
    HALP_COMMIT(pool->used, pool->used + 1);
    return obj;
}

void *halp_obj_new(enum hal_kind kind)
{
    struct hal_obj *obj = slot_new(kind);
    if (!obj) {
        return NULL;
    }
    obj->state = HAL_NEW;
    atomic_signal_fence(memory_order_seq_cst);
    hal_off port = kind == HAL_KIND_SIG ? ((struct hal_sig *)obj)->port : 0;
    memset((char *)obj + offsetof(struct hal_obj, unused), 0, sizes[kind] - offsetof(struct hal_obj, unused));
    if (kind == HAL_KIND_SIG) {
        ((struct hal_sig *)obj)->port = port;
    }
    obj->kind = (uint8_t)kind;
    obj->serial = ++hal_data->serial;
    return obj;
}

void halp_slot_free(struct hal_obj *obj)
{
    struct hal_pool *pool = &hal_data->pools[obj->kind];
    HALP_COMMIT(obj->state, HAL_FREE);
    obj->next = 0;
    if (pool->nfree) {
        obj_at(pool->free_last)->next = halp_off(obj);
    } else {
        pool->free_first = halp_off(obj);
    }
    pool->free_last = halp_off(obj);
    pool->nfree++;
}

void halp_obj_free(struct hal_obj *obj)
{
    halp_slot_free(obj);
}

void halp_each_slot(enum hal_kind kind, void (*fn)(struct hal_obj *obj, void *arg), void *arg)
{
    struct hal_pool *pool = &hal_data->pools[kind];
    uint32_t n = pool->used;
    for (hal_off chunk = pool->chunks; chunk; chunk = *(hal_off *)halp_ptr(chunk), n = pool->per_chunk) {
        for (uint32_t i = 0; i < n; i++) {
            struct hal_obj *obj = slot_of(pool, chunk, i);
            obj->kind = (uint8_t)kind;
            fn(obj, arg);
        }
    }
}

/* ---- By name ------------------------------------------------------------------- */

static void chain_add(struct hal_obj *obj)
{
    hal_off *bucket = (hal_off *)halp_ptr(hal_data->buckets) + (obj->hash & (hal_data->nbuckets - 1));
    obj->hash_next = *bucket;
    *bucket = halp_off(obj);
}

static void rehash_slot(struct hal_obj *obj, void *arg)
{
    (void)arg;
    if (obj->state == HAL_LIVE) {
        chain_add(obj);
    }
}

/* Room for one more name; false: no memory (only when there is no table at all). */
static bool hash_room(void)
{
    if (hal_data->nhashed < hal_data->nbuckets) {
        return true;
    }
    uint32_t n = hal_data->nbuckets ? hal_data->nbuckets * 2 : FIRST_BUCKETS;
    hal_off table = halp_block_new(n * sizeof(hal_off));
    if (!table) {
        return hal_data->nbuckets != 0;
    }
    memset(halp_ptr(table), 0, n * sizeof(hal_off));
    if (hal_data->buckets) {
        halp_block_free(hal_data->buckets, hal_data->nbuckets * sizeof(hal_off));
    }
    hal_data->buckets = table;
    hal_data->nbuckets = n;
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        halp_each_slot(k, rehash_slot, NULL);
    }
    return true;
}

static void hash_add(struct hal_obj *obj)
{
    chain_add(obj);
    hal_data->nhashed++;
}

static void hash_remove(struct hal_obj *obj)
{
    hal_off *link = (hal_off *)halp_ptr(hal_data->buckets) + (obj->hash & (hal_data->nbuckets - 1));
    hal_off self = halp_off(obj);
    while (*link && *link != self) {
        link = &obj_at(*link)->hash_next;
    }
    if (*link) {
        *link = obj->hash_next;
        hal_data->nhashed--;
    }
}

struct hal_obj *halp_find(enum hal_kind kind, const char *name)
{
    if (!hal_data->buckets) {
        return NULL;
    }
    uint32_t h = hash_name(name);
    hal_off at = ((hal_off *)halp_ptr(hal_data->buckets))[h & (hal_data->nbuckets - 1)];
    for (; at; at = obj_at(at)->hash_next) {
        struct hal_obj *obj = obj_at(at);
        if (obj->hash != h || strcmp(obj->name, name) != 0) {
            continue;
        }
        if (obj->kind == kind) {
            return obj;
        }
        if (obj->kind == HAL_KIND_ALIAS && ((struct hal_alias *)obj)->target_kind == kind) {
            return obj_at(((struct hal_alias *)obj)->target);
        }
    }
    return NULL;
}

/* ---- In order ------------------------------------------------------------------- */

/* Priority of a treap node; spreads what the buckets use. */
static uint32_t priority(const struct hal_obj *obj)
{
    uint32_t x = obj->hash * 0x9e3779b1u;
    return x ^ (x >> 15);
}

static void list_insert(struct hal_tree *tree, struct hal_obj *obj, struct hal_obj *before)
{
    hal_off self = halp_off(obj);
    if (before) {
        obj->next = before->next;
        obj->prev = halp_off(before);
        before->next = self;
    } else {
        obj->next = tree->first;
        obj->prev = 0;
        tree->first = self;
    }
    if (obj->next) {
        obj_at(obj->next)->prev = self;
    }
}

static void list_remove(struct hal_tree *tree, struct hal_obj *obj)
{
    if (obj->prev) {
        obj_at(obj->prev)->next = obj->next;
    } else {
        tree->first = obj->next;
    }
    if (obj->next) {
        obj_at(obj->next)->prev = obj->prev;
    }
}

static void tree_insert(struct hal_tree *tree, struct hal_obj *obj)
{
    hal_off self = halp_off(obj);
    hal_off *link = &tree->root;
    struct hal_obj *below = NULL; /* the greatest one with a lesser name */
    uint32_t pri = priority(obj);
    while (*link && priority(obj_at(*link)) >= pri) {
        struct hal_obj *cur = obj_at(*link);
        if (strcmp(cur->name, obj->name) < 0) {
            below = cur;
            link = &cur->right;
        } else {
            link = &cur->left;
        }
    }
    /* obj takes this place; what was there is split around it. */
    hal_off rest = *link;
    hal_off *lesser = &obj->left, *greater = &obj->right;
    *link = self;
    while (rest) {
        struct hal_obj *cur = obj_at(rest);
        if (strcmp(cur->name, obj->name) < 0) {
            below = cur;
            *lesser = rest;
            lesser = &cur->right;
            rest = cur->right;
        } else {
            *greater = rest;
            greater = &cur->left;
            rest = cur->left;
        }
    }
    *lesser = 0;
    *greater = 0;
    list_insert(tree, obj, below);
}

static void tree_remove(struct hal_tree *tree, struct hal_obj *obj)
{
    hal_off self = halp_off(obj);
    hal_off *link = &tree->root;
    while (*link && *link != self) {
        struct hal_obj *cur = obj_at(*link);
        link = strcmp(cur->name, obj->name) < 0 ? &cur->right : &cur->left;
    }
    /* Its two subtrees become one. */
    hal_off a = obj->left, b = obj->right;
    while (a && b) {
        if (priority(obj_at(a)) >= priority(obj_at(b))) {
            *link = a;
            link = &obj_at(a)->right;
            a = *link;
        } else {
            *link = b;
            link = &obj_at(b)->left;
            b = *link;
        }
    }
    *link = a ? a : b;
    list_remove(tree, obj);
}

static void order_insert(struct hal_obj *obj)
{
    struct hal_tree *tree = &hal_data->trees[obj->kind];
    if (is_sorted(obj->kind)) {
        tree_insert(tree, obj);
    } else if (obj->kind != HAL_KIND_ALIAS) {
        list_insert(tree, obj, NULL);
    }
    tree->changes++;
}

static void order_remove(struct hal_obj *obj)
{
    struct hal_tree *tree = &hal_data->trees[obj->kind];
    if (is_sorted(obj->kind)) {
        tree_remove(tree, obj);
    } else if (obj->kind != HAL_KIND_ALIAS) {
        list_remove(tree, obj);
    }
    tree->changes++;
}

void *halp_first(enum hal_kind kind)
{
    return halp_ptr(hal_data->trees[kind].first);
}

void *halp_next(const void *obj)
{
    return halp_ptr(((const struct hal_obj *)obj)->next);
}

struct hal_obj *halp_find_above(enum hal_kind kind, const char *name)
{
    struct hal_obj *best = NULL;
    hal_off at = hal_data->trees[kind].root;
    while (at) {
        struct hal_obj *cur = obj_at(at);
        if (strcmp(cur->name, name) > 0) {
            best = cur;
            at = cur->left;
        } else {
            at = cur->right;
        }
    }
    return best;
}

/* ---- Components by id ---------------------------------------------------------------- */

static hal_off *id_bucket(int comp_id)
{
    return &hal_data->ids[(unsigned)comp_id % HAL_ID_BUCKETS];
}

struct hal_comp *halp_find_comp_id(int comp_id)
{
    struct hal_comp *c = halp_ptr(*id_bucket(comp_id));
    while (c && c->comp_id != comp_id) {
        c = halp_ptr(c->id_next);
    }
    return c;
}

static void id_add(struct hal_comp *c)
{
    hal_off *bucket = id_bucket(c->comp_id);
    c->id_next = *bucket;
    *bucket = halp_off(c);
}

static void id_remove(struct hal_comp *c)
{
    hal_off *link = id_bucket(c->comp_id);
    while (*link && *link != halp_off(c)) {
        link = &((struct hal_comp *)halp_ptr(*link))->id_next;
    }
    if (*link) {
        *link = c->id_next;
    }
}

/* ---- All together -------------------------------------------------------------------------- */

static void index_add(struct hal_obj *obj)
{
    obj->hash = hash_name(obj->name);
    hash_add(obj);
    order_insert(obj);
    if (obj->kind == HAL_KIND_COMP) {
        id_add((struct hal_comp *)obj);
    }
    hal_data->pools[obj->kind].nlive++;
}

bool halp_obj_insert(struct hal_obj *obj)
{
    if (!hash_room()) {
        return false;
    }
    index_add(obj);
    HALP_COMMIT(obj->state, HAL_LIVE);
    return true;
}

void halp_obj_remove(struct hal_obj *obj)
{
    hash_remove(obj);
    order_remove(obj);
    if (obj->kind == HAL_KIND_COMP) {
        id_remove((struct hal_comp *)obj);
    }
    hal_data->pools[obj->kind].nlive--;
}

void halp_index_clear(void)
{
    memset(hal_data->blocks, 0, sizeof hal_data->blocks); /* what was free is lost, not used twice */
    for (int k = 0; k < HAL_KIND_COUNT; k++) {
        struct hal_pool *pool = &hal_data->pools[k];
        pool->free_first = pool->free_last = 0;
        pool->nfree = pool->nlive = 0;
        hal_data->trees[k].root = 0;
        hal_data->trees[k].first = 0;
        hal_data->trees[k].changes++;
    }
    memset(hal_data->ids, 0, sizeof hal_data->ids);
    if (hal_data->buckets) {
        memset(halp_ptr(hal_data->buckets), 0, hal_data->nbuckets * sizeof(hal_off));
    }
    hal_data->nhashed = 0;
}

void halp_reindex(struct hal_obj *obj)
{
    obj->left = obj->right = obj->prev = obj->next = obj->hash_next = 0;
    hash_room();
    index_add(obj);
}
