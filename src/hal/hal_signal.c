/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_signal.c - signals and the links of pins to them.
 *
 * Thread: [init]; realtime code sees a link as one store of a pointer
 */
#include "hal_priv.h"

#include <errno.h>
#include <string.h>

static void count(struct hal_sig *sig, int dir, int by)
{
    if (dir & HAL_IN) {
        sig->readers += by; /* I/O pins read as well */
    }
    if (dir == HAL_OUT) {
        sig->writers += by;
    }
    if (dir == HAL_IO) {
        sig->bidirs += by;
    }
}

void halp_member_add(struct hal_sig *sig, struct hal_pin *pin)
{
    hal_off self = halp_off(pin);
    pin->member_prev = 0;
    pin->member_next = sig->members;
    if (sig->members) {
        ((struct hal_pin *)halp_ptr(sig->members))->member_prev = self;
    }
    sig->members = self;
    count(sig, pin->dir, 1);
}

void halp_pin_unlink(struct hal_pin *pin)
{
    struct hal_sig *sig = halp_ptr(pin->signal);
    if (!sig) {
        return;
    }
    if (pin->type == HAL_PORT) {
        pin->own.lu = 0;
    } else {
        halp_copy_value(&pin->own, &sig->value, pin->type);
    }
    HALP_COMMIT(pin->signal, 0);
    halp_pin_point(pin);
    if (pin->member_prev) {
        ((struct hal_pin *)halp_ptr(pin->member_prev))->member_next = pin->member_next;
    } else {
        sig->members = pin->member_next;
    }
    if (pin->member_next) {
        ((struct hal_pin *)halp_ptr(pin->member_next))->member_prev = pin->member_prev;
    }
    count(sig, pin->dir, -1);
}

int hal_signal_new(const char *name, hal_type_t type)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: signal_new called before init\n");
        return -EFAULT;
    }
    if (!name) {
        halp_err("HAL: ERROR: signal name not given\n");
        return -EINVAL;
    }
    if (strlen(name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: signal name '%s' is too long\n", name);
        return -EINVAL;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: signal_new called while HAL is locked\n");
        return -EPERM;
    }
    halp_dbg("HAL: creating signal '%s'\n", name);
    int result = -EINVAL;
    halp_lock();
    if (halp_find_sig(name)) {
        halp_err("HAL: ERROR: duplicate signal '%s'\n", name);
    } else if ((int)type < HAL_BIT || (int)type >= HAL_TYPE_MAX) {
        halp_err("HAL: ERROR: illegal signal type %d'\n", (int)type);
    } else {
        halp_change();
        struct hal_sig *sig = halp_obj_new(HAL_KIND_SIG);
        if (sig) {
            strcpy(sig->o.name, name);
            sig->type = type;
        }
        result = 0;
        if (!sig || !halp_obj_insert(&sig->o)) {
            if (sig) {
                halp_obj_free(&sig->o);
            }
            halp_err("HAL: ERROR: insufficient memory for signal '%s'\n", name);
            result = -ENOMEM;
        }
    }
    halp_unlock();
    return result;
}

int hal_signal_delete(const char *name)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: signal_delete called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: signal_delete called while HAL locked\n");
        return -EPERM;
    }
    if (!name) {
        halp_err("HAL: ERROR: signal name not given\n");
        return -EINVAL;
    }
    halp_dbg("HAL: deleting signal '%s'\n", name);
    int result = 0;
    halp_lock();
    struct hal_sig *sig = halp_find_sig(name);
    if (!sig) {
        halp_err("HAL: ERROR: signal '%s' not found\n", name);
        result = -EINVAL;
    } else {
        halp_change();
        HALP_COMMIT(sig->o.state, HAL_DYING);
        while (sig->members) {
            halp_pin_unlink(halp_ptr(sig->members));
        }
        halp_obj_remove(&sig->o);
        halp_obj_free(&sig->o);
    }
    halp_unlock();
    return result;
}

/* The rules of sharing; 0, or -EINVAL after a message that uses the caller's name of the pin. */
static int may_link(const struct hal_pin *pin, const struct hal_sig *sig, const char *pin_name)
{
    if (pin->type != sig->type) {
        halp_err("HAL: ERROR: type mismatch '%s' <- '%s'\n", pin_name, sig->o.name);
    } else if (pin->dir == HAL_OUT && (sig->writers > 0 || sig->bidirs > 0)) {
        halp_err("HAL: ERROR: signal '%s' already has output or I/O pin(s)\n", sig->o.name);
    } else if (pin->dir == HAL_IO && pin->type == HAL_PORT) {
        halp_err("HAL: ERROR: signal '%s' is a port and cannot have I/O pin(s)\n", sig->o.name);
    } else if (pin->dir == HAL_IO && sig->writers > 0) {
        halp_err("HAL: ERROR: signal '%s' already has output pin\n", sig->o.name);
    } else if (pin->dir == HAL_IN && pin->type == HAL_PORT && sig->readers > 0) {
        halp_err("HAL: ERROR: signal '%s' can only have one input pin\n", sig->o.name);
    } else {
        return 0;
    }
    return -EINVAL;
}

int hal_link(const char *pin_name, const char *sig_name)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: link called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: link called while HAL locked\n");
        return -EPERM;
    }
    if (!pin_name) {
        halp_err("HAL: ERROR: pin name not given\n");
        return -EINVAL;
    }
    if (!sig_name) {
        halp_err("HAL: ERROR: signal name not given\n");
        return -EINVAL;
    }
    halp_dbg("HAL: linking pin '%s' to '%s'\n", pin_name, sig_name);
    int result = -EINVAL;
    halp_lock();
    struct hal_pin *pin = halp_find_pin(pin_name);
    struct hal_sig *sig = halp_find_sig(sig_name);
    if (!pin) {
        halp_err("HAL: ERROR: pin '%s' not found\n", pin_name);
    } else if (!sig) {
        halp_err("HAL: ERROR: signal '%s' not found\n", sig_name);
    } else if (pin->signal == halp_off(sig)) {
        rtapi_print_msg(RTAPI_MSG_WARN, "HAL: Warning: pin '%s' already linked to '%s'\n", pin_name, sig_name);
        result = 0;
    } else if (pin->signal) {
        const struct hal_sig *other = halp_ptr(pin->signal);
        halp_err("HAL: ERROR: pin '%s' is linked to '%s', cannot link to '%s'\n", pin_name, other->o.name, sig_name);
    } else if (may_link(pin, sig, pin_name) == 0) {
        halp_change();
        if (pin->type != HAL_PORT && sig->writers == 0 && sig->bidirs == 0 &&
            (pin->dir != HAL_IN || sig->readers == 0)) {
            halp_copy_value(&sig->value, &pin->own, pin->type);
        }
        HALP_COMMIT(pin->signal, halp_off(sig));
        halp_pin_point(pin);
        halp_member_add(sig, pin);
        result = 0;
    }
    halp_unlock();
    return result;
}

int hal_unlink(const char *pin_name)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: unlink called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: unlink called while HAL locked\n");
        return -EPERM;
    }
    if (!pin_name) {
        halp_err("HAL: ERROR: pin name not given\n");
        return -EINVAL;
    }
    halp_dbg("HAL: unlinking pin '%s'\n", pin_name);
    int result = 0;
    halp_lock();
    struct hal_pin *pin = halp_find_pin(pin_name);
    if (!pin) {
        halp_err("HAL: ERROR: pin '%s' not found\n", pin_name);
        result = -EINVAL;
    } else if (pin->signal) {
        halp_change();
        halp_pin_unlink(pin);
    }
    halp_unlock();
    return result;
}
