/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_pin.c - pins and parameters: creation with all its checks, aliases, the
 * legacy setters.
 *
 * Thread: [init]
 */
#include "hal_priv.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* ---- Values ------------------------------------------------------------------- */

void *halp_pin_cell(const struct hal_pin *pin)
{
    if (pin->signal) {
        return &((struct hal_sig *)halp_ptr(pin->signal))->value;
    }
    return (void *)(uintptr_t)&pin->own;
}

/* Stores where a cell is into the owner's pointer variable, as an address of the
 * owner's. One store: the owner may be using the pin. */
static void point(hal_off owner, hal_off var, hal_off cell)
{
    const struct hal_comp *c = halp_ptr(owner);
    if (var && c) {
        __atomic_store_n((hal_cell_u64_ *)halp_ptr(var), c->base + cell, __ATOMIC_RELEASE);
    }
}

void halp_pin_point(struct hal_pin *pin)
{
    point(pin->owner, pin->var, halp_off(halp_pin_cell(pin)));
}

/* Copies a value at its full 64 bits: narrow ones are extended, so that readers of
 * any width agree. Each side is accessed once and whole. */
void halp_copy_value(hal_data_u *to, const hal_data_u *from, int type)
{
    rtapi_u64 bits;
    switch (type) {
    case HAL_BIT:
        bits = __atomic_load_n((const hal_cell_u8_ *)from, __ATOMIC_RELAXED) != 0;
        break;
    case HAL_S32:
        bits = (rtapi_u64)(rtapi_s64)__atomic_load_n((const hal_cell_s32_ *)from, __ATOMIC_RELAXED);
        break;
    case HAL_U32:
    case HAL_PORT:
        bits = __atomic_load_n((const hal_cell_u32_ *)from, __ATOMIC_RELAXED);
        break;
    default:
        bits = __atomic_load_n((const hal_cell_u64_ *)from, __ATOMIC_RELAXED);
        break;
    }
    __atomic_store_n((hal_cell_u64_ *)to, bits, __ATOMIC_RELAXED);
}

/* ---- Making ------------------------------------------------------------------- */

static void own_pin(struct hal_comp *comp, struct hal_pin *pin)
{
    hal_off self = halp_off(pin);
    pin->owner_next = comp->pins;
    if (comp->pins) {
        ((struct hal_pin *)halp_ptr(comp->pins))->owner_prev = self;
    }
    comp->pins = self;
}

static void own_param(struct hal_comp *comp, struct hal_param *param)
{
    hal_off self = halp_off(param);
    param->owner_next = comp->params;
    if (comp->params) {
        ((struct hal_param *)halp_ptr(comp->params))->owner_prev = self;
    }
    comp->params = self;
}

int halp_pin_create(struct hal_comp *comp, const char *name, hal_type_t type, hal_pdir_t dir, void **var,
                    hal_data_u def)
{
    struct hal_pin *pin = halp_obj_new(HAL_KIND_PIN);
    if (!pin) {
        return -ENOMEM;
    }
    strcpy(pin->o.name, name);
    pin->owner = halp_off(comp);
    pin->var = halp_off(var);
    pin->type = (int8_t)type;
    pin->dir = (uint8_t)dir;
    pin->own = def;
    if (!halp_obj_insert(&pin->o)) {
        halp_obj_free(&pin->o);
        return -ENOMEM;
    }
    own_pin(comp, pin);
    halp_pin_point(pin);
    return 0;
}

int halp_param_create(struct hal_comp *comp, const char *name, hal_type_t type, hal_pdir_t dir, void *data,
                      hal_data_u def, void **ref)
{
    struct hal_param *param = halp_obj_new(HAL_KIND_PARAM);
    if (!param) {
        return -ENOMEM;
    }
    strcpy(param->o.name, name);
    param->owner = halp_off(comp);
    param->type = (int8_t)type;
    param->dir = (uint8_t)dir;
    param->own = def;
    param->data = data ? halp_off(data) : halp_off(&param->own);
    if (!halp_obj_insert(&param->o)) {
        halp_obj_free(&param->o);
        return -ENOMEM;
    }
    own_param(comp, param);
    if (ref) {
        *ref = &param->own;
    }
    return 0;
}

static void alias_drop(hal_off alias)
{
    if (alias) {
        struct hal_obj *a = halp_ptr(alias);
        halp_obj_remove(a);
        halp_obj_free(a);
    }
}

void halp_pin_remove(struct hal_pin *pin)
{
    HALP_COMMIT(pin->o.state, HAL_DYING);
    halp_pin_unlink(pin);
    /* Whoever still uses the variable does no harm. */
    point(pin->owner, pin->var, halp_off(&hal_data->scratch));
    struct hal_comp *comp = halp_ptr(pin->owner);
    if (pin->owner_prev) {
        ((struct hal_pin *)halp_ptr(pin->owner_prev))->owner_next = pin->owner_next;
    } else if (comp) {
        comp->pins = pin->owner_next;
    }
    if (pin->owner_next) {
        ((struct hal_pin *)halp_ptr(pin->owner_next))->owner_prev = pin->owner_prev;
    }
    alias_drop(pin->alias);
    halp_obj_remove(&pin->o);
    halp_obj_free(&pin->o);
}

void halp_param_remove(struct hal_param *param)
{
    HALP_COMMIT(param->o.state, HAL_DYING);
    struct hal_comp *comp = halp_ptr(param->owner);
    if (param->owner_prev) {
        ((struct hal_param *)halp_ptr(param->owner_prev))->owner_next = param->owner_next;
    } else if (comp) {
        comp->params = param->owner_next;
    }
    if (param->owner_next) {
        ((struct hal_param *)halp_ptr(param->owner_next))->owner_prev = param->owner_prev;
    }
    alias_drop(param->alias);
    halp_obj_remove(&param->o);
    halp_obj_free(&param->o);
}

/* ---- Pins: the checks, in the documented order ----------------------------------- */

static bool type_known(hal_type_t type)
{
    return (int)type >= HAL_BIT && (int)type < HAL_TYPE_MAX;
}

static int pin_new(const char *name, hal_type_t type, hal_pdir_t dir, void **var, int comp_id, hal_data_u def)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: pin_new called before init\n");
        return -EFAULT;
    }
    if (!name) {
        halp_err("HAL: ERROR: pin_new called without a name\n");
        return -EINVAL;
    }
    if (var && *var) {
        halp_err("HAL: ERROR: pin_new(%s) called with already-initialized memory\n", name);
    }
    if (!type_known(type)) {
        halp_err("HAL: ERROR: pin type not one of HAL_BIT, HAL_FLOAT, HAL_S32, HAL_U32, HAL_S64, HAL_U64 or "
                 "HAL_PORT\n");
        return -EINVAL;
    }
    if (dir != HAL_IN && dir != HAL_OUT && dir != HAL_IO) {
        halp_err("HAL: ERROR: pin direction not one of HAL_IN, HAL_OUT, or HAL_IO\n");
        return -EINVAL;
    }
    if (type == HAL_PORT && dir == HAL_IO) {
        halp_err("HAL: ERROR: pin direction must be one of HAL_IN or HAL_OUT for hal port\n");
        return -EINVAL;
    }
    if (strlen(name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: pin name '%s' is too long\n", name);
        return -EINVAL;
    }
    if (hal_data->lock_bits & HAL_LOCK_LOAD) {
        halp_err("HAL: ERROR: pin_new called while HAL locked\n");
        return -EPERM;
    }
    halp_dbg("HAL: creating pin '%s'\n", name);
    int result = -EINVAL;
    halp_lock();
    struct hal_comp *comp = halp_find_comp_id(comp_id);
    if (!comp) {
        halp_err("HAL: ERROR: component %d not found\n", comp_id);
        goto out;
    }
    if (halp_find_pin(name)) {
        halp_err("HAL: ERROR: duplicate pin '%s'\n", name);
        goto out;
    }
    if (halp_find_param(name)) {
        halp_err("HAL: ERROR: pin '%s' also is the name of a parameter\n", name);
    }
    if (!halp_inside(var, sizeof *var)) {
        halp_err("HAL: ERROR: data_ptr_addr not in shared memory\n");
        goto out;
    }
    if (comp->ready) {
        halp_err("HAL: ERROR: pin_new called after hal_ready\n");
        goto out;
    }
    halp_change();
    result = halp_pin_create(comp, name, type, dir, var, def);
    if (result < 0) {
        halp_err("HAL: ERROR: insufficient memory for pin '%s'\n", name);
    }
out:
    halp_unlock();
    return result;
}

/* The formatted name in buf[HAL_NAME_LEN + 1]; -ENOMEM after a message when it is
 * too long. */
static int format_name(char *buf, const char *who, const char *fmt, va_list ap)
{
    int len = rtapi_vsnprintf(buf, HAL_NAME_LEN + 1, fmt, ap);
    if (len < 0 || len > HAL_NAME_LEN) {
        halp_err("%s: length %d too long for name starting '%s'\n", who, len, buf);
        return -ENOMEM;
    }
    return 0;
}

static int pin_newfv(hal_type_t type, hal_pdir_t dir, void **var, int comp_id, hal_data_u def, const char *fmt,
                     va_list ap)
{
    char name[HAL_NAME_LEN + 1];
    int result = format_name(name, "hal_pin_newfv", fmt, ap);
    return result < 0 ? result : pin_new(name, type, dir, var, comp_id, def);
}

int hal_pin_new(const char *name, hal_type_t type, hal_pin_dir_t dir, void **data_ptr_addr, int comp_id)
{
    return pin_new(name, type, dir, data_ptr_addr, comp_id, (hal_data_u){.lu = 0});
}

#define LEGACY_PIN(T, TYPE)                                                                               \
    int hal_pin_##T##_new(const char *name, hal_pin_dir_t dir, hal_##T##_t **data_ptr_addr, int comp_id)  \
    {                                                                                                     \
        return hal_pin_new(name, TYPE, dir, (void **)(uintptr_t)data_ptr_addr, comp_id);                  \
    }                                                                                                     \
    int hal_pin_##T##_newf(hal_pin_dir_t dir, hal_##T##_t **data_ptr_addr, int comp_id, const char *fmt, ...) \
    {                                                                                                     \
        va_list ap;                                                                                       \
        va_start(ap, fmt);                                                                                \
        int result = pin_newfv(TYPE, dir, (void **)(uintptr_t)data_ptr_addr, comp_id, (hal_data_u){.lu = 0}, fmt, ap); \
        va_end(ap);                                                                                       \
        return result;                                                                                    \
    }
LEGACY_PIN(bit, HAL_BIT)
LEGACY_PIN(float, HAL_FLOAT)
LEGACY_PIN(u32, HAL_U32)
LEGACY_PIN(s32, HAL_S32)
LEGACY_PIN(u64, HAL_U64)
LEGACY_PIN(s64, HAL_S64)
LEGACY_PIN(port, HAL_PORT)

#define TYPED_PIN(T, TYPE, REF, VALUE, FIELD, CAST)                                                \
    int hal_pin_new_##T(int comp_id, hal_pdir_t dir, REF *ref, VALUE def, const char *fmt, ...)    \
    {                                                                                              \
        va_list ap;                                                                                \
        va_start(ap, fmt);                                                                         \
        int result = pin_newfv(TYPE, dir, (void **)(uintptr_t)ref, comp_id,                        \
                               (hal_data_u){.FIELD = (CAST)def}, fmt, ap);                         \
        va_end(ap);                                                                                \
        return result;                                                                             \
    }
TYPED_PIN(bool, HAL_BIT, hal_bool_t, rtapi_bool, lu, bool)
TYPED_PIN(si32, HAL_S32, hal_sint_t, rtapi_s32, ls, rtapi_s64)
TYPED_PIN(ui32, HAL_U32, hal_uint_t, rtapi_u32, lu, rtapi_u64)
TYPED_PIN(sint, HAL_S64, hal_sint_t, rtapi_sint, ls, rtapi_s64)
TYPED_PIN(uint, HAL_U64, hal_uint_t, rtapi_uint, lu, rtapi_u64)
TYPED_PIN(real, HAL_FLOAT, hal_real_t, rtapi_real, f, double)

int hal_pin_new_port(int comp_id, hal_pdir_t dir, hal_sint_t *ref, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    int result = pin_newfv(HAL_PORT, dir, (void **)(uintptr_t)ref, comp_id, (hal_data_u){.lu = 0}, fmt, ap);
    va_end(ap);
    return result;
}

/* ---- Parameters ---------------------------------------------------------------------- */

/* data: the caller's variable (legacy) or NULL; ref: where to store the reference of
 * a cell of HAL's own (typed) or NULL. */
static int param_new(const char *name, hal_type_t type, hal_pdir_t dir, void *data, void **ref, int comp_id,
                     hal_data_u def)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: param_new called before init\n");
        return -EFAULT;
    }
    if (!name) {
        halp_err("HAL: ERROR: param_new called without a name\n");
        return -EINVAL;
    }
    if (!type_known(type) || type == HAL_PORT) {
        halp_err("HAL: ERROR: pin type not one of HAL_BIT, HAL_FLOAT, HAL_S32, HAL_U32, Hal_S64 or HAL_U64\n");
        return -EINVAL;
    }
    if (dir != HAL_RO && dir != HAL_RW) {
        halp_err("HAL: ERROR: param direction not one of HAL_RO, or HAL_RW\n");
        return -EINVAL;
    }
    if (strlen(name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: parameter name '%s' is too long\n", name);
        return -EINVAL;
    }
    if (hal_data->lock_bits & HAL_LOCK_LOAD) {
        halp_err("HAL: ERROR: param_new called while HAL locked\n");
        return -EPERM;
    }
    halp_dbg("HAL: creating parameter '%s'\n", name);
    int result = -EINVAL;
    halp_lock();
    struct hal_comp *comp = halp_find_comp_id(comp_id);
    if (!comp) {
        halp_err("HAL: ERROR: component %d not found\n", comp_id);
        goto out;
    }
    if (halp_find_param(name)) {
        halp_err("HAL: ERROR: duplicate parameter '%s'\n", name);
        goto out;
    }
    if (halp_find_pin(name)) {
        halp_err("HAL: ERROR: parameter '%s' also is the name of a pin\n", name);
    }
    if (ref ? !halp_inside(ref, sizeof *ref) : !halp_inside(data, 1)) {
        halp_err("HAL: ERROR: data_addr not in shared memory\n");
        goto out;
    }
    if (comp->ready) {
        halp_err("HAL: ERROR: param_new called after hal_ready\n");
        goto out;
    }
    halp_change();
    result = halp_param_create(comp, name, type, dir, data, def, ref);
    if (result < 0) {
        halp_err("HAL: ERROR: insufficient memory for parameter '%s'\n", name);
    }
out:
    halp_unlock();
    return result;
}

int hal_param_new(const char *name, hal_type_t type, hal_param_dir_t dir, void *data_addr, int comp_id)
{
    return param_new(name, type, dir, data_addr, NULL, comp_id, (hal_data_u){.lu = 0});
}

#define LEGACY_PARAM(T, TYPE, SETTER)                                                                      \
    int hal_param_##T##_new(const char *name, hal_param_dir_t dir, hal_##T##_t *data_addr, int comp_id)    \
    {                                                                                                      \
        return hal_param_new(name, TYPE, dir, (void *)(uintptr_t)data_addr, comp_id);                      \
    }                                                                                                      \
    int hal_param_##T##_newf(hal_param_dir_t dir, hal_##T##_t *data_addr, int comp_id, const char *fmt, ...) \
    {                                                                                                      \
        char name[HAL_NAME_LEN + 1];                                                                       \
        va_list ap;                                                                                        \
        va_start(ap, fmt);                                                                                 \
        int result = format_name(name, "hal_param_newfv", fmt, ap);                                        \
        va_end(ap);                                                                                        \
        return result < 0 ? result : hal_param_##T##_new(name, dir, data_addr, comp_id);                   \
    }                                                                                                      \
    int hal_param_##T##_set(const char *name, SETTER value)                                                \
    {                                                                                                      \
        return hal_param_set(name, TYPE, &value);                                                          \
    }
LEGACY_PARAM(bit, HAL_BIT, int)
LEGACY_PARAM(float, HAL_FLOAT, double)
LEGACY_PARAM(u32, HAL_U32, unsigned long)
LEGACY_PARAM(s32, HAL_S32, signed long)
LEGACY_PARAM(u64, HAL_U64, unsigned long)
LEGACY_PARAM(s64, HAL_S64, signed long)

#define TYPED_PARAM(T, TYPE, REF, VALUE, FIELD, CAST)                                                      \
    int hal_param_new_##T(int comp_id, hal_pdir_t dir, REF *ref, VALUE def, const char *fmt, ...)          \
    {                                                                                                      \
        char name[HAL_NAME_LEN + 1];                                                                       \
        va_list ap;                                                                                        \
        va_start(ap, fmt);                                                                                 \
        int result = format_name(name, "hal_param_new_newapi", fmt, ap);                                   \
        va_end(ap);                                                                                        \
        return result < 0 ? result : param_new(name, TYPE, dir, NULL, (void **)(uintptr_t)ref, comp_id,    \
                                               (hal_data_u){.FIELD = (CAST)def});                          \
    }
TYPED_PARAM(bool, HAL_BIT, hal_bool_t, rtapi_bool, lu, bool)
TYPED_PARAM(si32, HAL_S32, hal_sint_t, rtapi_s32, ls, rtapi_s64)
TYPED_PARAM(ui32, HAL_U32, hal_uint_t, rtapi_u32, lu, rtapi_u64)
TYPED_PARAM(sint, HAL_S64, hal_sint_t, rtapi_sint, ls, rtapi_s64)
TYPED_PARAM(uint, HAL_U64, hal_uint_t, rtapi_uint, lu, rtapi_u64)
TYPED_PARAM(real, HAL_FLOAT, hal_real_t, rtapi_real, f, double)

int hal_param_new_fake(int comp_id, hal_refs_u *ref)
{
    (void)comp_id;
    if (!ref) {
        return -EINVAL;
    }
    ref->u = hal_malloc(8);
    return ref->u ? 0 : -ENOMEM;
}

int hal_param_set(const char *name, hal_type_t type, void *value_addr)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: param_set called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_PARAMS) {
        halp_err("HAL: ERROR: param_set called while HAL locked\n");
        return -EPERM;
    }
    if (!name || !value_addr) {
        return -EINVAL;
    }
    halp_dbg("HAL: setting parameter '%s'\n", name);
    int result = -EINVAL;
    halp_lock();
    struct hal_param *param = halp_find_param(name);
    if (!param) {
        halp_err("HAL: ERROR: parameter '%s' not found\n", name);
    } else if (param->type != (int)type) {
        halp_err("HAL: ERROR: type mismatch setting param '%s'\n", name);
    } else if (param->dir == HAL_RO) {
        halp_err("HAL: ERROR: param '%s' is not writable\n", name);
    } else {
        hal_data_u *d = halp_ptr(param->data);
        result = 0;
        switch (type) {
        case HAL_BIT: d->b = *(int *)value_addr != 0; break;
        case HAL_FLOAT: d->f = *(double *)value_addr; break;
        case HAL_S32: d->s = (rtapi_s32)*(signed long *)value_addr; break;
        case HAL_U32: d->u = (rtapi_u32)*(unsigned long *)value_addr; break;
        case HAL_S64: d->ls = *(signed long *)value_addr; break;
        case HAL_U64: d->lu = *(unsigned long *)value_addr; break;
        default: result = -EINVAL; break;
        }
    }
    halp_unlock();
    return result;
}

/* ---- Aliases --------------------------------------------------------------------------- */

/* Gives obj another current name: out of the order and in again. */
static void rename_to(struct hal_obj *obj, const char *name)
{
    halp_obj_remove(obj);
    strcpy(obj->name, name);
    halp_obj_insert(obj);
}

/* link: the alias field of the pin or parameter obj. */
static int alias_set(struct hal_obj *obj, hal_off *link, const char *alias)
{
    struct hal_alias *old = halp_ptr(*link);
    halp_change();
    if (!alias) {
        if (old) {
            HALP_COMMIT(old->ending, 1);
            char name[HAL_NAME_LEN + 1];
            strcpy(name, old->o.name);
            halp_obj_remove(&old->o);
            rename_to(obj, name);
            HALP_COMMIT(*link, 0);
            halp_obj_free(&old->o);
        }
        return 0;
    }
    struct hal_alias *a = halp_obj_new(HAL_KIND_ALIAS);
    if (!a) {
        return -ENOMEM;
    }
    strcpy(a->o.name, old ? old->o.name : obj->name);
    strcpy(a->alias, alias);
    a->target = halp_off(obj);
    a->target_kind = obj->kind;
    if (!halp_obj_insert(&a->o)) {
        halp_obj_free(&a->o);
        return -ENOMEM;
    }
    HALP_COMMIT(*link, halp_off(a));
    rename_to(obj, alias);
    alias_drop(halp_off(old));
    return 0;
}

static int alias_checked(enum hal_kind kind, const char *word, const char *name, const char *alias)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: %s_alias called before init\n", word);
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: %s_alias called while HAL locked\n", word);
        return -EPERM;
    }
    if (!name) {
        halp_err("HAL: ERROR: %s name not given\n", word);
        return -EINVAL;
    }
    if (alias && strlen(alias) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: alias name '%s' is too long\n", alias);
        return -EINVAL;
    }
    int result = -EINVAL;
    halp_lock();
    struct hal_obj *obj;
    if (alias && halp_find(kind, alias)) {
        halp_err("HAL: ERROR: duplicate pin/alias name '%s'\n", alias);
    } else if (!(obj = halp_find(kind, name))) {
        halp_err("HAL: ERROR: %s '%s' not found\n", word, name);
    } else {
        hal_off *link = kind == HAL_KIND_PIN ? &((struct hal_pin *)obj)->alias : &((struct hal_param *)obj)->alias;
        result = alias_set(obj, link, alias);
        if (result < 0) {
            halp_err("HAL: ERROR: insufficient memory for alias '%s'\n", alias);
        }
    }
    halp_unlock();
    return result;
}

int hal_pin_alias(const char *pin_name, const char *alias)
{
    return alias_checked(HAL_KIND_PIN, "pin", pin_name, alias);
}

int hal_param_alias(const char *param_name, const char *alias)
{
    return alias_checked(HAL_KIND_PARAM, "param", param_name, alias);
}
