/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * switchkins.c - frame of modules whose kinematics can be switched.
 *
 * In:     switchkinsSetup() of the module; loadrt coordinates= sparm=
 * Out:    the functions of kinematics.h; pins kinstype.is-N, skgui.*
 * Thread: load [init]; kinematicsSwitch, Forward, Inverse [servo]
 */
#include "emcmotcfg.h"
#include "emcpose.h"
#include "hal.h"
#include "rtapi.h"
#include "rtapi_app.h"
#include "switchkins.h"

MODULE_AUTHOR("Kerf");
MODULE_LICENSE("GPL");

static char *coordinates;
RTAPI_MP_STRING(coordinates, "Axis letters in the order of joints");
static char *sparm;
RTAPI_MP_STRING(sparm, "Option of the module");

static struct kins_type {
    KS setup;
    KF forward;
    KI inverse;
    EmcPose last; /* seed of an iterative forward */
    int last_known;
} types[SWITCHKINS_MAX_TYPES];
static int ntypes;
static int current; /* type in effect */
static kparms kp;
static int comp_id;

static struct switch_pins {
    hal_bool_t is_type[SWITCHKINS_MAX_TYPES];
    hal_real_t gui[6]; /* x y z a b c */
} *pins;

int switchkinsRegister(int ktype, KS setup, KF fwd, KI inv)
{
    if (ktype < 0 || ktype >= SWITCHKINS_MAX_TYPES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "switchkinsRegister: BAD switchkins_type <%d> (must be 0..%d)\n", ktype,
                        SWITCHKINS_MAX_TYPES - 1);
        return -1;
    }
    if (types[ktype].setup || types[ktype].forward || types[ktype].inverse) {
        rtapi_print_msg(RTAPI_MSG_ERR, "switchkinsRegister: switchkins-type %d already provided\n", ktype);
        return -1;
    }
    types[ktype].setup = setup;
    types[ktype].forward = fwd;
    types[ktype].inverse = inv;
    return 0;
}

static void show_type(void)
{
    for (int n = 0; n < ntypes; n++)
        hal_set_bool(pins->is_type[n], n == current);
}

static int iterates(int type) { return (kp.fwd_iterates_mask >> type) & 1; }

KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_BOTH; }
int kinematicsSwitchable(void) { return 1; }

int kinematicsSwitch(int new_type)
{
    if (new_type < 0 || new_type >= ntypes) {
        rtapi_print_msg(RTAPI_MSG_ERR, "kinematicsSwitch:BAD VALUE <%d>\n", new_type);
        return -1;
    }
    current = new_type;
    show_type();
    rtapi_print_msg(RTAPI_MSG_INFO, "kinematicsSwitch:TYPE%d\n", new_type);
    if (iterates(new_type))
        rtapi_print_msg(RTAPI_MSG_INFO, "switchkins-type %d: fwd_iterates\n", new_type);
    return 0;
}

static void show_gui_pose(const double *joint, const EmcPose *seed, const KINEMATICS_FORWARD_FLAGS *fflags)
{
    KINEMATICS_INVERSE_FLAGS iflags = 0;
    EmcPose p = types[kp.gui_kinstype].last_known ? types[kp.gui_kinstype].last : *seed;
    if (types[kp.gui_kinstype].forward(joint, &p, fflags, &iflags) < 0)
        return;
    for (int i = 0; i < 6; i++)
        hal_set_real(pins->gui[i], emcPoseGetAxis(&p, i));
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    struct kins_type *t = &types[current];
    if (current < 0 || current >= ntypes) {
        rtapi_print_msg(RTAPI_MSG_ERR, "switchkins: Forward BAD switchkins_type </%d>\n", current);
        return -1;
    }
    if (iterates(current) && t->last_known)
        *world = t->last;
    int r = t->forward(joint, world, fflags, iflags);
    if (r >= 0 && iterates(current)) {
        t->last = *world;
        t->last_known = 1;
    }
    if (kp.gui_kinstype >= 0)
        show_gui_pose(joint, world, fflags);
    return r;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    if (current < 0 || current >= ntypes) {
        rtapi_print_msg(RTAPI_MSG_ERR, "switchkins: Inverse BAD switchkins_type </%d>\n", current);
        return -1;
    }
    return types[current].inverse(world, joint, iflags, fflags);
}

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

static int refuse(const char *reason)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "\nSwitchkins FAIL %s:<%s>\n", kp.kinsname ? kp.kinsname : "?", reason);
    if (comp_id > 0)
        hal_exit(comp_id);
    return -1;
}

/* Types must be complete and without gaps. Returns their number, or -1. */
static int count_types(void)
{
    int n = 0;
    for (int i = 0; i < SWITCHKINS_MAX_TYPES; i++) {
        const struct kins_type *t = &types[i];
        if (!t->setup && !t->forward && !t->inverse)
            continue;
        if (i != n)
            return -1;
        const char *lacks = !t->setup ? "no setup" : !t->forward ? "no forward" : !t->inverse ? "no inverse" : NULL;
        if (lacks) {
            rtapi_print_msg(RTAPI_MSG_ERR, "switchkins: switchkins-type %d incomplete: %s\n", i, lacks);
            return -1;
        }
        n++;
    }
    return n;
}

static int make_pins(void)
{
    static const char letters[] = "xyzabc";
    int r = 0;
    pins = hal_malloc(sizeof(*pins));
    if (!pins)
        return -1;
    for (int n = 0; n < ntypes; n++)
        r |= hal_pin_new_bool(comp_id, HAL_OUT, &pins->is_type[n], 0, "kinstype.is-%d", n);
    if (kp.gui_kinstype >= 0)
        for (int i = 0; i < 6; i++)
            r |= hal_pin_new_real(comp_id, HAL_IN, &pins->gui[i], 0, "skgui.%c", letters[i]);
    return r < 0 ? -1 : 0;
}

static int load_types(void)
{
    KS ks[3] = {0};
    KF kf[3] = {0};
    KI ki[3] = {0};
    if (switchkinsSetup(&kp, &ks[0], &ks[1], &ks[2], &kf[0], &kf[1], &kf[2], &ki[0], &ki[1], &ki[2]) != 0)
        return refuse("switchkinsSetp FAIL");
    for (int i = 0; i < 3; i++)
        if ((ks[i] || kf[i] || ki[i]) && switchkinsRegister(i, ks[i], kf[i], ki[i]) != 0)
            return refuse("switchkinsRegister FAIL");
    if (!kp.kinsname)
        return refuse("Missing kinsname");
    if (kp.max_joints <= 0 || kp.max_joints > EMCMOT_MAX_JOINTS)
        return refuse("bogus max_joints");
    ntypes = count_types();
    if (ntypes < 0)
        return refuse("incomplete switchkins-type");
    if (ntypes == 0)
        return refuse("no switchkins-types provided");
    if (kp.gui_kinstype >= ntypes) {
        rtapi_print_msg(RTAPI_MSG_ERR, "gui_forward_kins BAD gui_kinstype <%d>\n", kp.gui_kinstype);
        return refuse("bogus gui_kinstype");
    }
    if (!kp.halprefix) {
        kp.halprefix = kp.kinsname;
        rtapi_print_msg(RTAPI_MSG_INFO, "Missing halprefix, using \"%s\"\n", kp.halprefix);
    }
    return 0;
}

int rtapi_app_main(void)
{
    kp.sparm = sparm;
    kp.gui_kinstype = -1;
    if (load_types() != 0)
        return -1;
    if (!coordinates)
        coordinates = kp.required_coordinates;
    comp_id = hal_init(kp.kinsname);
    if (comp_id < 0)
        return refuse("other");
    if (make_pins() != 0)
        return refuse("hal pin create fail");
    kinematicsSwitch(0);
    for (int n = 0; n < ntypes; n++)
        if (types[n].setup(comp_id, coordinates, &kp) != 0)
            return refuse("other");
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
