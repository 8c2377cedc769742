/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_comp.c - components: their life, and the library's own.
 *
 * Thread: [init]
 */
#include "hal_priv.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

int halp_lib_module_id = -1;

/* ---- The library in this process --------------------------------------------- */

#ifdef ULAPI
static pthread_mutex_t init_mutex = PTHREAD_MUTEX_INITIALIZER;
static int init_count;   /* hal_lib_init less hal_lib_exit, one for all components */
static int comp_count;   /* components made here and not yet removed */

int hal_lib_init(void)
{
    int result = 0;
    pthread_mutex_lock(&init_mutex);
    if (init_count == 0) {
        char name[RTAPI_NAME_LEN + 1];
        rtapi_snprintf(name, sizeof name, "HAL_LIB_%d", (int)getpid());
        result = rtapi_init(name);
        if (result >= 0) {
            halp_lib_module_id = result;
            result = halp_map(halp_lib_module_id);
            if (result < 0) {
                rtapi_exit(halp_lib_module_id);
                halp_lib_module_id = -1;
            } else {
                halp_lock();
                halp_reap(NULL);
                halp_unlock();
            }
        }
    }
    if (result >= 0) {
        init_count++;
        result = 0;
    }
    pthread_mutex_unlock(&init_mutex);
    return result;
}

static void say_dangling(void)
{
    halp_err("HAL: ERROR: hal_lib_exit() called while holding %d component references (pid=%d)\n", comp_count,
             (int)getpid());
    halp_lock();
    for (struct hal_comp *c = halp_first(HAL_KIND_COMP); c; c = halp_next(c)) {
        if (c->pid == getpid()) {
            const char *insmod = halp_ptr(c->insmod);
            halp_err("  dangling component: '%s' id=%d pid=%d ready=%d insmod='%s'\n", c->o.name, c->comp_id, c->pid,
                     (int)c->ready, insmod ? insmod : "");
        }
    }
    halp_unlock();
}

void hal_lib_exit(void)
{
    pthread_mutex_lock(&init_mutex);
    if (init_count <= 0) {
        halp_err("HAL: ERROR: hal_lib_exit() called too often (init_cnt=%d)\n", init_count);
    } else if (init_count == 1 && comp_count > 0) {
        say_dangling(); /* refused: the components keep the library */
    } else if (--init_count == 0) {
        int id = halp_lib_module_id;
        halp_lib_module_id = -1;
        halp_unmap(id);
        rtapi_exit(id);
    }
    pthread_mutex_unlock(&init_mutex);
}

/* One reference of the library for all components of the process. */
static int comp_ref(void)
{
    int result = 0;
    pthread_mutex_lock(&init_mutex);
    bool first = comp_count++ == 0;
    pthread_mutex_unlock(&init_mutex);
    if (first) {
        result = hal_lib_init();
        if (result < 0) {
            pthread_mutex_lock(&init_mutex);
            comp_count--;
            pthread_mutex_unlock(&init_mutex);
        }
    }
    return result;
}

static void comp_unref(void)
{
    pthread_mutex_lock(&init_mutex);
    bool last = comp_count > 0 && --comp_count == 0;
    pthread_mutex_unlock(&init_mutex);
    if (last) {
        hal_lib_exit();
    }
}
#else
static int comp_ref(void)
{
    return 0;
}
static void comp_unref(void)
{
}
#endif

/* ---- Making and removing --------------------------------------------------------- */

struct hal_comp *halp_comp_new(const char *name, int comp_id, hal_comp_type_t type)
{
    struct hal_comp *c = halp_obj_new(HAL_KIND_COMP);
    if (!c) {
        return NULL;
    }
    strcpy(c->o.name, name);
    c->comp_id = comp_id;
    c->type = type;
    c->base = (uintptr_t)hal_shmem_base;
    if (type == HAL_COMP_TYPE_USER) {
        struct hal_process self;
        halp_process_self(&self);
        c->pid = self.pid;
        c->pid_start = self.start;
        c->pid_ns = self.ns;
    }
    if (!halp_obj_insert(&c->o)) {
        halp_obj_free(&c->o);
        return NULL;
    }
    return c;
}

void halp_comp_remove(struct hal_comp *comp)
{
    HALP_COMMIT(comp->o.state, HAL_DYING);
    while (comp->functs) {
        halp_funct_remove(halp_ptr(comp->functs));
    }
    while (comp->pins) {
        halp_pin_remove(halp_ptr(comp->pins));
    }
    while (comp->params) {
        halp_param_remove(halp_ptr(comp->params));
    }
    halp_obj_remove(&comp->o);
    halp_obj_free(&comp->o);
}

int hal_init(const char *name)
{
    if (!name) {
        halp_err("HAL: ERROR: no component name\n");
        return -EINVAL;
    }
    if (strlen(name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: component name '%s' is too long\n", name);
        return -EINVAL;
    }
    halp_dbg("HAL: initializing component '%s'\n", name);
    int result = comp_ref();
    if (result < 0) {
        return result;
    }
#ifdef RTAPI
    if (!hal_data) {
        halp_err("HAL: ERROR: hal_init called before the HAL library is loaded\n");
        return -EINVAL;
    }
#endif
    char rtapi_name[RTAPI_NAME_LEN + 1];
    rtapi_snprintf(rtapi_name, sizeof rtapi_name, "HAL_%s", name);
    int id = rtapi_init(rtapi_name);
    if (id < 0) {
        halp_err("HAL: ERROR: rtapi init failed\n");
        comp_unref();
        return -EINVAL;
    }
    halp_lock();
    halp_change();
    struct hal_comp *c = (struct hal_comp *)halp_find(HAL_KIND_COMP, name);
    if (c) {
        halp_reap(c);
        c = (struct hal_comp *)halp_find(HAL_KIND_COMP, name);
    }
    if (c) {
        halp_err("HAL: ERROR: duplicate component name '%s'\n", name);
        result = -EEXIST;
    } else {
#ifdef RTAPI
        c = halp_comp_new(name, id, HAL_COMP_TYPE_REALTIME);
#else
        c = halp_comp_new(name, id, HAL_COMP_TYPE_USER);
#endif
        if (!c) {
            halp_err("HAL: ERROR: insufficient memory for component '%s'\n", name);
            result = -ENOMEM;
        }
    }
    halp_unlock();
    if (result < 0) {
        rtapi_exit(id);
        comp_unref();
        return result;
    }
    halp_dbg("HAL: component '%s' initialized, ID = %02d\n", name, id);
    return id;
}

int hal_exit(int comp_id)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: exit called before init\n");
        return -EFAULT;
    }
    halp_dbg("HAL: removing component %02d\n", comp_id);
    char name[HAL_NAME_LEN + 1];
    halp_lock();
    struct hal_comp *c = halp_find_comp_id(comp_id);
    if (!c) {
#ifdef RTAPI
        halp_cycles_over();
#endif
        halp_unlock();
        halp_err("HAL: ERROR: component %d not found\n", comp_id);
        return -ENOENT;
    }
    strcpy(name, c->o.name);
#ifdef RTAPI
    bool own = c->type == HAL_COMP_TYPE_REALTIME;
#else
    bool own = c->pid == getpid();
#endif
    halp_change();
    halp_comp_remove(c);
#ifdef RTAPI
    halp_cycles_over();
#endif
    halp_unlock();
    halp_dbg("HAL: component %02d removed, name = '%s'\n", comp_id, name);
    if (own) { /* the module id belongs to the process that made the component */
        rtapi_exit(comp_id);
        comp_unref();
    }
    return 0;
}

/* Runs with the lock held; NULL after a message when there is no such component. */
static struct hal_comp *known(int comp_id, const char *what)
{
    struct hal_comp *c = halp_find_comp_id(comp_id);
    if (!c) {
        halp_err("HAL: ERROR: %scomponent %d not found\n", what, comp_id);
    }
    return c;
}

int hal_ready(int comp_id)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: ready called before init\n");
        return -EFAULT;
    }
    int result = 0;
    halp_lock();
    struct hal_comp *c = known(comp_id, "");
    if (!c) {
        result = -EINVAL;
    } else if (c->ready) {
        halp_err("HAL: ERROR: Component '%s' already ready\n", c->o.name);
        result = -EINVAL;
    } else {
        c->ready = 1;
    }
    halp_unlock();
    return result;
}

int hal_set_unready(int comp_id)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: set_unready called before init\n");
        return -EFAULT;
    }
    int result = 0;
    halp_lock();
    struct hal_comp *c = known(comp_id, "hal_set_unready(): ");
    if (!c) {
        result = -EINVAL;
    } else {
        c->ready = 0;
    }
    halp_unlock();
    return result;
}

char *hal_comp_name(int comp_id)
{
    if (!hal_data) {
        return NULL;
    }
    halp_lock();
    struct hal_comp *c = halp_find_comp_id(comp_id);
    halp_unlock();
    return c ? c->o.name : NULL;
}

hal_realtime_type_t hal_get_realtime_type(void)
{
    if (!hal_data) {
        return (hal_realtime_type_t)-EFAULT;
    }
#ifdef ULAPI
    struct hal_process host = hal_data->host;
    if (halp_process_gone(&host)) {
        return REALTIME_TYPE_UNINITIALIZED;
    }
#endif
    return (hal_realtime_type_t)hal_data->realtime_type;
}

const char *hal_strerror(int err)
{
    switch (err) {
    case -EINVAL: return "invalid argument";
    case -ENOENT: return "not found";
    case -EACCES: return "not writable";
    case -EIO: return "missing target storage";
    case -EBADF: return "invalid type";
    case -ERANGE: return "value out of range";
    case -ENOMEM: return "out of memory";
    case -EISCONN: return "queue already allocated";
    case -EEXIST: return "name exists";
    case -EFAULT: return "shared memory not mapped";
    case -EMFILE: return "too many modules";
    case -EPROTO: return "hal data version mismatch";
    case -EPERM: return "hal is locked";
    case -ENOEXEC: return "missing constructor";
    default: return "unknown error";
    }
}

#ifdef ULAPI
int hal_unready(int comp_id)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: unready called before init\n");
        return -EFAULT;
    }
    int result = 0;
    halp_lock();
    struct hal_comp *c = known(comp_id, "");
    if (!c) {
        result = -EINVAL;
    } else if (!c->ready) {
        halp_err("HAL: ERROR: Component '%s' already unready\n", c->o.name);
        result = -EINVAL;
    } else {
        c->ready = 0;
    }
    halp_unlock();
    return result;
}

int hal_mutex_force_release(void)
{
    bool mapped = hal_data != NULL;
    int id = -1;
    if (!mapped) {
        id = rtapi_init("hal_unlocker");
        if (id < 0) {
            return id;
        }
        int result = halp_map(id);
        if (result < 0) {
            rtapi_exit(id);
            return result;
        }
    }
    int result = halp_force_release();
    if (!mapped) {
        halp_unmap(id);
        rtapi_exit(id);
    }
    return result;
}

int hal_enforce_exact_base_period(void)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: enforce_exact_base_period called before init\n");
        return -EFAULT;
    }
    halp_lock();
    int result = hal_data->exact_base_period ? -EACCES : 0;
    hal_data->exact_base_period = 1;
    halp_unlock();
    return result;
}

int hal_comp_insmod_args(const char *comp_name, const char *args)
{
    if (!hal_data) {
        return -EFAULT;
    }
    if (!comp_name || !args || !halp_inside(args, 1)) {
        return -EINVAL;
    }
    halp_lock();
    struct hal_comp *c = (struct hal_comp *)halp_find(HAL_KIND_COMP, comp_name);
    if (c) {
        c->insmod = halp_off(args);
    }
    halp_unlock();
    return c ? 0 : -ENOENT;
}

int hal_set_lock(unsigned char lock_type)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: set_lock called before init\n");
        return -EFAULT;
    }
    hal_data->lock_bits = lock_type;
    return 0;
}

unsigned char hal_get_lock(void)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: get_lock called before init\n");
        return HAL_LOCK_ALL;
    }
    return (unsigned char)hal_data->lock_bits;
}
#endif

#ifdef RTAPI
int hal_set_constructor(int comp_id, constructor make)
{
    if (!hal_data) {
        return -EFAULT;
    }
    int result = 0;
    halp_lock();
    struct hal_comp *c = known(comp_id, "");
    if (!c) {
        result = -EINVAL;
    } else {
        c->make = (uintptr_t)make;
    }
    halp_unlock();
    return result;
}

int hal_comp_invoke_make(const char *comp_name, const char *newname, const char *arg)
{
    if (!hal_data) {
        return -EFAULT;
    }
    if (!comp_name || !newname) {
        return -EINVAL;
    }
    halp_lock();
    struct hal_comp *c = (struct hal_comp *)halp_find(HAL_KIND_COMP, comp_name);
    constructor make = c ? (constructor)(uintptr_t)c->make : NULL;
    halp_unlock();
    if (!c) {
        return -ENOENT;
    }
    return make ? make(newname, arg) : -ENOEXEC;
}
#endif
