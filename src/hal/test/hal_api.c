/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_api.c - calls of the HAL interface from an ordinary process, case by case:
 *
 *   hal-api CASE     prints results and HAL's messages
 *
 * The tests in tests/hal compare the output with what the reference documents.
 */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "hal.h"
#include "kerf_clock.h"

static void to_stdout(msg_level_t level, const char *fmt, va_list ap)
{
    printf(level == RTAPI_MSG_ERR ? "  | " : "  (%d) ", (int)level);
    vprintf(fmt, ap);
}

static const char *errno_word(int r)
{
    switch (r) {
    case -EINVAL: return "-EINVAL";
    case -EPERM: return "-EPERM";
    case -ENOENT: return "-ENOENT";
    case -EEXIST: return "-EEXIST";
    case -EFAULT: return "-EFAULT";
    case -ENOMEM: return "-ENOMEM";
    case -EACCES: return "-EACCES";
    case -EBADF: return "-EBADF";
    case -EISCONN: return "-EISCONN";
    case -ENOSPC: return "-ENOSPC";
    default: return NULL;
    }
}

static void show(const char *what, int r)
{
    if (errno_word(r)) {
        printf("%s: %s\n", what, errno_word(r));
    } else {
        printf("%s: %d\n", what, r);
    }
}
#define SHOW(call) show(#call, call)

static char long_name[] = "a23456789b123456789c123456789d123456789e123456789f12345x"; /* 56 */

struct pins {
    hal_float_t *f1, *f2, *f3;
    hal_s32_t *s1;
    hal_u32_t *u1;
    hal_s64_t *s64;
    hal_bit_t *b1, *b2;
    hal_port_t *p1, *p2;
    hal_real_t real;
    hal_sint_t si32, sint, port;
    hal_uint_t ui32, uint;
    hal_bool_t boolean;
    hal_float_t fpar;
    hal_s32_t spar;
    hal_u64_t upar;
    hal_bit_t bpar;
    hal_real_t rpar;
    hal_sint_t sipar;
    hal_refs_u fake;
};

static int id;
static struct pins *p;

static void begin(void)
{
    id = hal_init("api");
    p = hal_malloc(sizeof *p);
}

/* ---- Cases ------------------------------------------------------------------------------ */

static void case_life(void)
{
    SHOW(hal_is_init());
    SHOW(hal_exit(5));
    SHOW(hal_init(NULL));
    SHOW(hal_init(long_name));
    SHOW(hal_malloc(8) == NULL);
    SHOW(hal_get_realtime_type());
    int a = hal_init("one");
    SHOW(a > 0);
    SHOW(hal_is_init());
    SHOW(hal_init("one"));
    SHOW(strcmp(hal_comp_name(a), "one"));
    SHOW(hal_comp_name(a + 1000) == NULL);
    SHOW(hal_ready(a));
    SHOW(hal_ready(a));
    SHOW(hal_unready(a));
    SHOW(hal_unready(a));
    SHOW(hal_set_unready(a));
    SHOW(hal_set_unready(99999));
    SHOW(hal_ready(99999));
    SHOW(hal_get_realtime_type());
    int b = hal_init("two");
    SHOW(b > a);
    SHOW(hal_comp_by_name("two", NULL));
    SHOW(hal_comp_by_name("three", NULL));
    SHOW(hal_comp_by_id(a, NULL));
    char *args = hal_malloc(16);
    strcpy(args, "x=1");
    SHOW(hal_comp_insmod_args("one", args));
    SHOW(hal_comp_insmod_args("one", "literal"));
    SHOW(hal_comp_insmod_args("none", args));
    hal_query_t q = {0};
    SHOW(hal_comp_by_name("one", &q));
    printf("%s type %d ready %d insmod %s\n", q.name, q.comp.type, q.comp.ready, q.comp.insmod);
    void *m1 = hal_malloc(1), *m2 = hal_malloc(8), *m3 = hal_malloc(17);
    printf("aligned %d %d %d\n", (int)((uintptr_t)m1 % 8), (int)((uintptr_t)m2 % 8), (int)((uintptr_t)m3 % 16));
    SHOW(hal_malloc(0) == NULL);
    SHOW(hal_malloc(-4) == NULL);
    SHOW(hal_reference_map(hal_reference_unmap(m3)) == m3);
    SHOW(hal_reference_unmap(&q) == 0);
    SHOW(hal_exit(a));
    SHOW(hal_exit(a));
    SHOW(hal_is_init());
    SHOW(hal_exit(b));
    SHOW(hal_is_init());
    hal_lib_exit();
    SHOW(hal_lib_init());
    SHOW(hal_lib_init());
    int c = hal_init("three");
    hal_lib_exit();
    hal_lib_exit();
    hal_lib_exit();
    SHOW(hal_exit(c));
    SHOW(hal_is_init());
    for (int e = 1; e < 110; e++) {
        if (strcmp(hal_strerror(-e), "unknown error")) {
            printf("%d %s\n", e, hal_strerror(-e));
        }
    }
}

static void case_pins(void)
{
    static hal_float_t *outside;
    SHOW(hal_pin_float_new("a", HAL_IN, &outside, 1));
    begin();
    SHOW(hal_pin_float_newf(HAL_IN, &p->f1, id, "%s-%s", long_name, "x"));
    SHOW(hal_pin_float_new(long_name, HAL_IN, &p->f1, id));
    SHOW(hal_pin_new("a", (hal_type_t)0, HAL_IN, (void **)&p->f1, id));
    SHOW(hal_pin_new("a", (hal_type_t)8, HAL_IN, (void **)&p->f1, id));
    SHOW(hal_pin_float_new("a", HAL_RO, &p->f1, id));
    SHOW(hal_pin_port_new("a", HAL_IO, &p->p1, id));
    hal_set_lock(HAL_LOCK_LOAD);
    SHOW(hal_pin_float_new("a", HAL_IN, &p->f1, id));
    hal_set_lock(HAL_LOCK_NONE);
    SHOW(hal_pin_float_new("a", HAL_IN, &p->f1, 9999));
    SHOW(hal_pin_float_new("a", HAL_IN, &outside, id));
    SHOW(hal_pin_float_new("a", HAL_IN, &p->f1, id));
    SHOW(hal_pin_float_new("a", HAL_IN, &p->f2, id));
    SHOW(hal_param_float_new("b", HAL_RW, &p->fpar, id));
    SHOW(hal_pin_s32_new("b", HAL_OUT, &p->s1, id));
    SHOW(hal_param_s32_new("a", HAL_RO, &p->spar, id));
    p->f3 = p->f1;
    SHOW(hal_pin_float_new("c", HAL_IO, &p->f3, id));
    SHOW(hal_pin_bit_newf(HAL_IO, &p->b1, id, "bit.%d", 1));
    SHOW(hal_pin_u32_newf(HAL_IN, &p->u1, id, "u32.%d", 1));
    SHOW(hal_pin_s64_newf(HAL_IN, &p->s64, id, "s64.%d", 1));
    SHOW(hal_pin_port_newf(HAL_OUT, &p->p1, id, "port.%d", 1));
    printf("%g %d %d %u %lld %d\n", *p->f1, *p->s1, *p->b1, *p->u1, (long long)*p->s64, *p->p1);
    SHOW(hal_pin_new_real(id, HAL_IN, &p->real, 2.5, "real"));
    SHOW(hal_pin_new_bool(id, HAL_IN, &p->boolean, true, "bool"));
    SHOW(hal_pin_new_si32(id, HAL_IN, &p->si32, -5, "si32"));
    SHOW(hal_pin_new_ui32(id, HAL_IN, &p->ui32, 0xfffffffb, "ui32"));
    SHOW(hal_pin_new_sint(id, HAL_IN, &p->sint, INT64_MIN, "sint"));
    SHOW(hal_pin_new_uint(id, HAL_IN, &p->uint, UINT64_MAX, "uint"));
    SHOW(hal_pin_new_port(id, HAL_IN, &p->port, "port"));
    printf("%g %d %d %u %lld %llu\n", hal_get_real(p->real), hal_get_bool(p->boolean), hal_get_si32(p->si32),
           hal_get_ui32(p->ui32), (long long)hal_get_sint(p->sint), (unsigned long long)hal_get_uint(p->uint));
    printf("%lld %d %d %u\n", (long long)hal_get_sint(p->si32), hal_get_si32_clamped(p->sint), hal_get_si32(p->sint),
           hal_get_ui32_clamped(p->uint));
    printf("%d %d %u\n", hal_set_bool(p->boolean, false), hal_set_si32(p->si32, -7), hal_set_ui32(p->ui32, 7));
    printf("%lld %llu\n", (long long)hal_get_sint(p->si32), (unsigned long long)hal_get_uint(p->ui32));
    SHOW(hal_ready(id));
    SHOW(hal_pin_float_new("late", HAL_IN, &p->f2, id));
    SHOW(hal_pdir_is_pin(HAL_IO));
    SHOW(hal_pdir_is_pin(HAL_RW));
    SHOW(hal_pdir_is_param(HAL_RO));
    SHOW(hal_pdir_is_neither((hal_pdir_t)(HAL_IN | HAL_RO)));
    SHOW((int)hal_extend_counter(250, 3, 8));
    SHOW((int)hal_extend_counter(5, 250, 8));
    hal_exit(id);
}

static void case_params(void)
{
    SHOW(hal_param_float_new("a", HAL_RW, NULL, 1));
    begin();
    SHOW(hal_param_new("a", HAL_PORT, HAL_RW, (void *)&p->fpar, id));
    SHOW(hal_param_new("a", (hal_type_t)77, HAL_IN, (void *)&p->fpar, id));
    SHOW(hal_param_float_new("a", HAL_IN, &p->fpar, id));
    SHOW(hal_param_float_new("a", HAL_WO, &p->fpar, id));
    SHOW(hal_param_float_new(long_name, HAL_RW, &p->fpar, id));
    SHOW(hal_param_float_newf(HAL_RW, &p->fpar, id, "%s", long_name));
    SHOW(hal_param_new_real(id, HAL_RW, &p->rpar, 0, "%s", long_name));
    hal_set_lock(HAL_LOCK_LOAD);
    SHOW(hal_param_float_new("a", HAL_RW, &p->fpar, id));
    hal_set_lock(0);
    SHOW(hal_param_float_new("a", HAL_RW, &p->fpar, 9999));
    static hal_float_t outside;
    SHOW(hal_param_float_new("a", HAL_RW, &outside, id));
    p->fpar = 1.5;
    SHOW(hal_param_float_new("a", HAL_RW, &p->fpar, id));
    SHOW(hal_param_float_new("a", HAL_RW, &p->fpar, id));
    SHOW(hal_param_s32_new("s", HAL_RW, &p->spar, id));
    SHOW(hal_param_u64_new("u", HAL_RW, &p->upar, id));
    SHOW(hal_param_bit_new("b", HAL_RO, &p->bpar, id));
    SHOW(hal_param_new_real(id, HAL_RW, &p->rpar, 4.5, "r"));
    SHOW(hal_param_new_si32(id, HAL_RO, &p->sipar, -3, "si"));
    SHOW(hal_param_new_fake(id, &p->fake));
    SHOW(hal_param_new_fake(id, NULL));
    printf("%g %g %d %llu\n", p->fpar, hal_get_real(p->rpar), hal_get_si32(p->sipar),
           (unsigned long long)hal_get_uint(p->fake.u));
    SHOW(hal_param_float_set("a", 7.25));
    SHOW(hal_param_float_set("r", 8.25));
    SHOW(hal_param_s32_set("s", -9));
    SHOW(hal_param_u64_set("u", 9));
    SHOW(hal_param_bit_set("b", 1));
    SHOW(hal_param_bit_set("none", 1));
    SHOW(hal_param_s32_set("a", 1));
    hal_set_lock(HAL_LOCK_PARAMS);
    SHOW(hal_param_float_set("a", 1));
    hal_set_lock(0);
    printf("%g %g %d %llu %d\n", p->fpar, hal_get_real(p->rpar), p->spar, (unsigned long long)p->upar, p->bpar);
    SHOW(hal_param_alias("a", "alias-of-a"));
    SHOW(hal_param_alias("a", "s"));
    SHOW(hal_param_alias("none", "x"));
    SHOW(hal_param_float_set("alias-of-a", 2));
    SHOW(hal_param_float_set("a", 3));
    hal_ready(id);
    SHOW(hal_param_float_new("late", HAL_RW, &p->fpar, id));
    hal_exit(id);
}

static int list_cb(hal_query_t *q, void *arg)
{
    (void)arg;
    printf("%s%s%s%s%s ", q->name, q->pp.alias ? "(" : "", q->pp.alias ? q->pp.alias : "", q->pp.alias ? ")" : "",
           q->pp.signal ? "*" : "");
    return 0;
}

static void list_pins(void)
{
    hal_query_t q = {.qtype = HAL_QTYPE_PIN};
    hal_list_p(&q, list_cb, NULL);
    printf("\n");
}

static void case_aliases(void)
{
    begin();
    hal_pin_float_new("b", HAL_IN, &p->f1, id);
    hal_pin_float_new("a", HAL_IN, &p->f2, id);
    hal_pin_float_new("c", HAL_IN, &p->f3, id);
    list_pins();
    SHOW(hal_pin_alias("a", "z"));
    list_pins();
    SHOW(hal_pin_alias("b", "a"));
    SHOW(hal_pin_alias("b", "z"));
    SHOW(hal_pin_alias("b", long_name));
    SHOW(hal_pin_alias("none", "y"));
    SHOW(hal_pin_alias("none", "c"));
    SHOW(hal_pin_alias("z", "0"));
    list_pins();
    SHOW(hal_pin_alias("a", NULL));
    SHOW(hal_pin_alias("a", NULL));
    list_pins();
    hal_set_lock(HAL_LOCK_CONFIG);
    SHOW(hal_pin_alias("a", "q"));
    hal_set_lock(0);
    SHOW(hal_pin_alias("a", "q"));
    hal_ready(id);
    int other = hal_init("other");
    hal_bit_t **b = hal_malloc(sizeof *b);
    SHOW(hal_pin_bit_new("a", HAL_IN, b, other));
    SHOW(hal_pin_bit_new("q", HAL_IN, b, other));
    hal_exit(id);
    SHOW(hal_pin_bit_new("a", HAL_IN, b, other));
    list_pins();
    hal_exit(other);
}

static void show_signal(const char *name)
{
    hal_query_t q = {.name = name};
    if (hal_get_s(&q, NULL, NULL) < 0) {
        printf("%s: none\n", name);
        return;
    }
    printf("%s: type %d readers %d writers %d bidirs %d value %llx\n", name, q.sig.type, q.sig.readers, q.sig.writers,
           q.sig.bidirs, (unsigned long long)q.sig.value.u);
}

static void case_signals(void)
{
    SHOW(hal_signal_new("s", HAL_BIT));
    SHOW(hal_link("a", "b"));
    begin();
    hal_pin_float_new("in", HAL_IN, &p->f1, id);
    hal_pin_float_new("out", HAL_OUT, &p->f2, id);
    hal_pin_float_new("io", HAL_IO, &p->f3, id);
    hal_pin_bit_new("bit", HAL_OUT, &p->b1, id);
    hal_pin_bit_new("bit2", HAL_IN, &p->b2, id);
    hal_pin_port_new("pout", HAL_OUT, &p->p1, id);
    hal_pin_port_new("pin", HAL_IN, &p->p2, id);
    SHOW(hal_signal_new(long_name, HAL_BIT));
    SHOW(hal_signal_new("x", (hal_type_t)-1));
    SHOW(hal_signal_new("x", HAL_TYPE_MAX));
    SHOW(hal_signal_new("f", HAL_FLOAT));
    SHOW(hal_signal_new("f", HAL_BIT));
    SHOW(hal_signal_new("g", HAL_FLOAT));
    SHOW(hal_signal_new("port", HAL_PORT));
    hal_set_lock(HAL_LOCK_CONFIG);
    SHOW(hal_signal_new("h", HAL_FLOAT));
    SHOW(hal_signal_delete("f"));
    SHOW(hal_link("in", "f"));
    SHOW(hal_unlink("in"));
    hal_set_lock(0);
    SHOW(hal_link(NULL, "f"));
    SHOW(hal_link("in", NULL));
    SHOW(hal_link("none", "f"));
    SHOW(hal_link("in", "none"));
    SHOW(hal_link("bit", "f"));
    SHOW(hal_unlink("none"));
    SHOW(hal_unlink(NULL));
    SHOW(hal_unlink("in"));
    *p->f1 = 1;
    *p->f2 = 2;
    *p->f3 = 3;
    SHOW(hal_link("in", "f"));
    show_signal("f");
    SHOW(hal_link("out", "f"));
    show_signal("f");
    rtapi_set_msg_level(RTAPI_MSG_WARN);
    SHOW(hal_link("in", "f"));
    rtapi_set_msg_level(RTAPI_MSG_ERR);
    SHOW(hal_link("in", "g"));
    SHOW(hal_link("io", "f"));
    SHOW(hal_link("io", "g"));
    show_signal("g");
    SHOW(hal_unlink("out"));
    SHOW(hal_link("out", "g"));
    *p->f1 = 55;
    SHOW(hal_unlink("io"));
    SHOW(hal_link("io", "f"));
    show_signal("f");
    printf("io reads %g, out keeps %g\n", *p->f3, *p->f2);
    SHOW(hal_signal_delete("f"));
    printf("in keeps %g, io keeps %g\n", *p->f1, *p->f3);
    SHOW(hal_signal_delete("f"));
    SHOW(hal_link("pout", "port"));
    SHOW(hal_link("pin", "port"));
    hal_query_t q = {.name = "port", .sig = {.type = HAL_PORT, .value = {.u = 32}}};
    SHOW(hal_set_s(&q, NULL, NULL));
    printf("ports share %d\n", *p->p1 != 0 && *p->p1 == *p->p2);
    SHOW(hal_unlink("pin"));
    printf("unlinked port %d\n", *p->p2);
    hal_exit(id);
}

/* Narrow values fill their whole cell, whatever way they go. */
static void case_widths(void)
{
    begin();
    hal_pin_s32_new("s32", HAL_OUT, &p->s1, id);
    hal_pin_new_si32(id, HAL_IN, &p->si32, -5, "si32");
    hal_pin_new_ui32(id, HAL_IN, &p->ui32, 0xfffffffb, "ui32");
    hal_pin_new_sint(id, HAL_OUT, &p->sint, -5000000000LL, "sint");
    hal_pin_new_bool(id, HAL_IN, &p->boolean, true, "bool");
    hal_signal_new("s32sig", HAL_S32);
    hal_signal_new("u32sig", HAL_U32);
    hal_signal_new("s64sig", HAL_S64);
    hal_signal_new("bsig", HAL_BIT);
    hal_link("si32", "s32sig");
    printf("%lld %d\n", (long long)hal_get_sint(p->si32), hal_get_si32_clamped(p->si32));
    *p->s1 = -6;
    hal_link("s32", "s32sig");
    printf("%lld\n", (long long)hal_get_sint(p->si32));
    hal_unlink("si32");
    printf("%lld\n", (long long)hal_get_sint(p->si32));
    hal_link("ui32", "u32sig");
    hal_unlink("ui32");
    printf("%llu\n", (unsigned long long)hal_get_uint(p->ui32));
    hal_link("sint", "s64sig");
    hal_set_sint(p->sint, 6000000000LL);
    hal_unlink("sint");
    printf("%lld\n", (long long)hal_get_sint(p->sint));
    hal_link("bool", "bsig");
    hal_unlink("bool");
    printf("%llu\n", (unsigned long long)hal_get_uint((hal_uint_t)p->boolean));
    hal_exit(id);
}

static int fill_42(hal_query_t *q, void *arg)
{
    (void)arg;
    q->pp.value.r = 42;
    return 0;
}
static int stop_at(hal_query_t *q, void *arg)
{
    printf("%s ", q->name);
    return --*(int *)arg == 0 ? 7 : 0;
}
static int delete_next(hal_query_t *q, void *arg)
{
    char other[8];
    (void)arg;
    printf("%s ", q->name);
    snprintf(other, sizeof other, "s%c", q->name[1] + 1);
    if (q->name[1] % 2 == 0) {
        hal_signal_delete(other);
    } else {
        hal_signal_delete(q->name);
    }
    return 0;
}
static int show_comp(hal_query_t *q, void *arg)
{
    (void)arg;
    printf("%s type %d ready %d own %d\n", q->name, q->comp.type, q->comp.ready, q->comp.pid != 0);
    return 0;
}

static void case_queries(void)
{
    hal_query_t q = {.name = "x"};
    SHOW(hal_get_p(&q, NULL, NULL));
    SHOW(hal_list_s(&q, stop_at, NULL));
    begin();
    hal_pin_float_new("in", HAL_IN, &p->f1, id);
    hal_pin_float_new("out", HAL_OUT, &p->f2, id);
    hal_pin_port_new("port", HAL_IN, &p->p1, id);
    hal_param_float_new("rw", HAL_RW, &p->fpar, id);
    hal_param_bit_new("ro", HAL_RO, &p->bpar, id);
    hal_param_float_new("in", HAL_RO, &p->fpar, id);
    SHOW(hal_get_p(NULL, NULL, NULL));
    SHOW(hal_getref_p(&(hal_query_t){0}));
    q = (hal_query_t){.name = "none"};
    SHOW(hal_get_p(&q, NULL, NULL));
    q = (hal_query_t){.name = "in"};
    SHOW(hal_get_p(&q, NULL, NULL));
    printf("qtype %d type %d dir %d comp %s %d\n", q.qtype, q.pp.type, q.pp.dir, q.pp.comp, q.pp.comp_id == id);
    q = (hal_query_t){.name = "in", .qtype = HAL_QTYPE_PARAM};
    SHOW(hal_get_p(&q, NULL, NULL));
    printf("qtype %d dir %d\n", q.qtype, q.pp.dir);
    q = (hal_query_t){.name = "in", .pp = {.type = HAL_S32}};
    SHOW(hal_get_p(&q, NULL, NULL));
    q = (hal_query_t){.name = "in"};
    SHOW(hal_set_p(&q, NULL, NULL));
    SHOW(hal_set_p(&q, fill_42, NULL));
    printf("in %g\n", *p->f1);
    q = (hal_query_t){.name = "in", .pp = {.type = HAL_FLOAT, .value = {.r = 43}}};
    SHOW(hal_set_p(&q, NULL, NULL));
    printf("in %g\n", *p->f1);
    q = (hal_query_t){.name = "out", .pp = {.type = HAL_FLOAT}};
    SHOW(hal_set_p(&q, NULL, NULL));
    q = (hal_query_t){.name = "out", .pp = {.type = HAL_BIT}};
    SHOW(hal_set_p(&q, NULL, NULL));
    q = (hal_query_t){.name = "ro", .pp = {.type = HAL_BIT}};
    SHOW(hal_set_p(&q, NULL, NULL));
    q = (hal_query_t){.name = "port", .pp = {.type = HAL_PORT}};
    SHOW(hal_set_p(&q, NULL, NULL));
    hal_set_lock(HAL_LOCK_ALL);
    q = (hal_query_t){.name = "rw", .pp = {.type = HAL_FLOAT, .value = {.r = 5}}};
    SHOW(hal_set_p(&q, NULL, NULL));
    SHOW(hal_get_lock());
    hal_set_lock(0);
    hal_signal_new("sig", HAL_FLOAT);
    hal_signal_new("psig", HAL_PORT);
    hal_link("in", "sig");
    q = (hal_query_t){.name = "in", .pp = {.type = HAL_FLOAT}};
    SHOW(hal_set_p(&q, NULL, NULL));
    q = (hal_query_t){.name = "sig", .sig = {.type = HAL_FLOAT, .value = {.r = 6}}};
    SHOW(hal_set_s(&q, NULL, NULL));
    q = (hal_query_t){.name = "sig", .sig = {.type = HAL_S64}};
    SHOW(hal_set_s(&q, NULL, NULL));
    hal_link("out", "sig");
    q = (hal_query_t){.name = "sig", .sig = {.type = HAL_FLOAT, .value = {.r = 7}}};
    SHOW(hal_set_s(&q, NULL, NULL));
    q = (hal_query_t){.name = "nosig", .sig = {.type = HAL_FLOAT}};
    SHOW(hal_set_s(&q, NULL, NULL));
    q = (hal_query_t){.name = "psig", .sig = {.type = HAL_PORT, .value = {.u = 0}}};
    SHOW(hal_set_s(&q, NULL, NULL));
    q.sig.value.u = 65537;
    SHOW(hal_set_s(&q, NULL, NULL));
    q.sig.value.u = 65536;
    SHOW(hal_set_s(&q, NULL, NULL));
    SHOW(hal_set_s(&q, NULL, NULL));
    hal_list_p_s(&(hal_query_t){.name = "sig"}, list_cb, NULL);
    printf("\n");
    SHOW(hal_list_p_s(&(hal_query_t){.name = "nosig"}, list_cb, NULL));
    int n = 3;
    SHOW(hal_list_p(&(hal_query_t){0}, stop_at, &n));
    SHOW(hal_list_p(&(hal_query_t){.qtype = HAL_QTYPE_COMP}, stop_at, &n));
    hal_signal_delete("sig");
    hal_signal_delete("psig");
    for (int i = 0; i < 8; i++) {
        char name[8];
        snprintf(name, sizeof name, "s%c", 'h' - i);
        hal_signal_new(name, HAL_BIT);
    }
    SHOW(hal_list_s(&(hal_query_t){0}, delete_next, NULL));
    SHOW(hal_list_s(&(hal_query_t){0}, list_cb, NULL));
    hal_ready(id);
    int other = hal_init("other");
    SHOW(hal_list_comp(&(hal_query_t){0}, show_comp, NULL));
    hal_type_t type;
    hal_data_u *data;
    bool flag;
    SHOW(hal_get_pin_value_by_name("in", &type, &data, &flag));
    printf("%d %g %d\n", type, data->f, flag);
    SHOW(hal_get_pin_value_by_name("none", &type, &data, &flag));
    SHOW(hal_get_param_value_by_name("rw", &type, &data));
    SHOW(hal_get_signal_value_by_name("sa", &type, &data, NULL));
    hal_statistics_t st;
    SHOW(hal_statistics(&st));
    printf("%d components, %d pins, %d parameters, %d functions; some memory %d\n", st.ncomps, st.npins, st.nparams,
           st.nfuncts, st.mem_free > 0 && st.mem_free < st.mem_total);
    hal_exit(id);
    hal_exit(other);
}

static void case_ports(void)
{
    char buf[64];
    begin();
    hal_pin_port_new("out", HAL_OUT, &p->p1, id);
    hal_pin_port_new("in", HAL_IN, &p->p2, id);
    hal_signal_new("s", HAL_PORT);
    hal_link("out", "s");
    hal_link("in", "s");
    hal_query_t q = {.name = "s", .sig = {.type = HAL_PORT, .value = {.u = 10}}};
    hal_set_s(&q, NULL, NULL);
    printf("size %u writable %u readable %u\n", hal_port_buffer_size(p->p1), hal_port_writable(p->p1),
           hal_port_readable(p->p2));
    SHOW(hal_port_write(p->p1, "123456789", 9)); /* fills it with the read position at 0 */
    SHOW((int)hal_port_readable(p->p2));
    SHOW(hal_port_write(p->p1, "x", 1));
    SHOW(hal_port_read(p->p2, buf, 10));
    SHOW(hal_port_read(p->p2, buf, 0));
    SHOW(hal_port_peek(p->p2, buf, 4));
    printf("%.4s\n", buf);
    SHOW(hal_port_peek_commit(p->p2, 4));
    SHOW(hal_port_peek_commit(p->p2, 6));
    SHOW(hal_port_write(p->p1, "abcd", 4));
    SHOW(hal_port_read(p->p2, buf, 9));
    printf("%.9s\n", buf);
    SHOW(hal_port_write(p->p1, "xyz", 3));
    hal_port_clear(p->p2);
    printf("readable %u writable %u\n", hal_port_readable(p->p2), hal_port_writable(p->p1));
    unsigned char in = 0, out = 0;
    int moved = 0;
    for (int i = 0; i < 100000; i++) {
        char block[9];
        unsigned n = 1 + (unsigned)(i * 7) % 9;
        for (unsigned k = 0; k < n; k++) {
            block[k] = (char)(out + k);
        }
        if (hal_port_write(p->p1, block, n)) {
            out = (unsigned char)(out + n);
        }
        n = 1 + (unsigned)(i * 5) % 9;
        if (hal_port_read(p->p2, block, n)) {
            for (unsigned k = 0; k < n; k++) {
                if ((unsigned char)block[k] != in++) {
                    printf("wrong byte\n");
                    return;
                }
            }
            moved += (int)n;
        }
    }
    printf("bytes keep their order: %d\n", moved > 100000);
    sig_atomic_t stop = 1;
    hal_port_wait_writable(&p->p1, 100, &stop);
    hal_port_wait_readable(&p->p2, 0, NULL);
    printf("waits end\n");
    hal_exit(id);
}

static void case_streams(void)
{
    hal_stream_t a = {0}, b = {0};
    hal_stream_data_u d[21] = {{0}};
    unsigned number;
    begin();
    SHOW(hal_stream_create(&a, id, 4711, 4, NULL));
    SHOW(hal_stream_create(&a, id, 4711, 4, ""));
    SHOW(hal_stream_create(&a, id, 4711, 4, "fx"));
    SHOW(hal_stream_create(&a, id, 4711, 4, "ffffffffffffffffffffff"));
    SHOW(hal_stream_create(&a, id, 4711, 4, "fBsulK"));
    SHOW(hal_stream_attach(&b, id, 4712, NULL) < 0);
    SHOW(hal_stream_attach(&b, id, 4711, "fs"));
    SHOW(hal_stream_attach(&b, id, 4711, "fbsulkf"));
    SHOW(hal_stream_attach(&b, id, 4711, "FB"));
    printf("%d elements, depth %d of %u\n", hal_stream_element_count(&b), hal_stream_depth(&b),
           hal_stream_maxdepth(&b));
    for (int i = -1; i < 7; i++) {
        printf("type %d: %d\n", i, hal_stream_element_type(&b, i));
    }
    SHOW(hal_stream_read(&b, d, &number));
    for (int i = 0; i < 4; i++) {
        d[0].f = 0.5 + i;
        d[1].b = i % 2;
        d[2].s = -i;
        d[3].u = 4000000000u;
        d[4].l = INT64_MIN;
        d[5].k = UINT64_MAX;
        show("write", hal_stream_write(&a, d));
    }
    printf("depth %d readable %d writable %d overruns %d underruns %d\n", hal_stream_depth(&a), hal_stream_readable(&a),
           hal_stream_writable(&a), hal_stream_num_overruns(&a), hal_stream_num_underruns(&a));
    memset(d, 0, sizeof d);
    SHOW(hal_stream_read(&b, d, &number));
    printf("%u: %g %d %d %u %lld %llu\n", number, d[0].f, d[1].b, d[2].s, d[3].u, (long long)d[4].l,
           (unsigned long long)d[5].k);
    SHOW(hal_stream_write(&a, d));
    while (hal_stream_read(&b, d, &number) == 0) {
        printf("%u ", number);
    }
    printf("\n");
    hal_stream_wait_writable(&a, NULL);
    sig_atomic_t stop = 1;
    hal_stream_wait_readable(&a, &stop);
    SHOW(hal_stream_detach(&b));
    SHOW(hal_stream_read(&b, d, NULL));
    SHOW(hal_stream_num_overruns(&b));
    SHOW(hal_stream_element_type(&b, 0));
    SHOW(hal_stream_depth(NULL));
    hal_stream_destroy(&a);
    SHOW(hal_stream_attach(&b, id, 4711, NULL) < 0);
    hal_exit(id);
}

static void case_threads(void)
{
    SHOW(hal_start_threads());
    begin();
    SHOW(hal_add_funct_to_thread("f", "t", 0));
    SHOW(hal_add_funct_to_thread(NULL, "t", 1));
    SHOW(hal_add_funct_to_thread("f", NULL, 1));
    SHOW(hal_add_funct_to_thread("f", "t", 1));
    SHOW(hal_init_funct_to_thread("f", "t", 1));
    SHOW(hal_del_funct_from_thread("f", "t"));
    hal_set_lock(HAL_LOCK_CONFIG | HAL_LOCK_RUN);
    SHOW(hal_add_funct_to_thread("f", "t", 1));
    SHOW(hal_init_funct_to_thread("f", "t", 1));
    SHOW(hal_del_funct_from_thread("f", "t"));
    SHOW(hal_start_threads());
    SHOW(hal_stop_threads());
    hal_set_lock(0);
    SHOW(hal_start_threads());
    SHOW(hal_stop_threads());
    SHOW(hal_enforce_exact_base_period());
    SHOW(hal_enforce_exact_base_period());
    hal_exit(id);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*run)(void);
    } cases[] = {
        {"life", case_life},       {"pins", case_pins},       {"params", case_params},   {"aliases", case_aliases},
        {"signals", case_signals}, {"widths", case_widths},   {"queries", case_queries}, {"ports", case_ports},
        {"streams", case_streams}, {"threads", case_threads},
    };
    setvbuf(stdout, NULL, _IOLBF, 0);
    rtapi_set_msg_handler(to_stdout);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (argc > 1 && strcmp(argv[1], cases[i].name) == 0) {
            cases[i].run();
            return 0;
        }
    }
    fprintf(stderr, "hal-api: no such case\n");
    return 1;
}
