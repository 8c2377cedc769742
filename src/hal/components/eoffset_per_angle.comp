// SPDX-License-Identifier: GPL-2.0-or-later
component eoffset_per_angle "External offset as a function of an angle";
pin in bit active "Offsets are not zero; from motion.eoffset-active.";
pin in bit is_on "The machine is on.";
pin in bit enable_in "TRUE: computes offsets.";
pin in float radius_ref = 1 "Radius of the shape.";
pin in float angle "Angle in degrees.";
pin in float start_angle "Angle where the shape begins.";
pin in signed fnum "Shape: 0 polygon inside, 1 polygon outside, 2 sine, 3 square.";
pin in float rfraction = 0.1 "Depth of the shape as a share of the radius.";
pin in float fmult = 6 "Number of sides or waves.";
pin in unsigned k = 10000 "Counts per unit.";
pin out bit is_off "The machine is off.";
pin out bit enable_out "To motion's eoffset-enable.";
pin out bit clear "To motion's eoffset-clear.";
pin out signed kcounts "Offset in counts.";
pin out float kreciprocal "Units per count.";
pin out float eoffset_dbg "Offset in units.";
pin out unsigned state_dbg "State: 0 off, 1 ready, 2 running, 3 stopping, 4 finish.";
variable int state;
variable int failed;
variable int told;
function _ "Updates the offset.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include "components/real_to_int.h";
;;
enum { OFF, READY, RUNNING, STOPPING, FINISH };

/* Offset of shape f at an angle in degrees from the start; sets *bad if it has none. */
static double shape(int f, double radius, double share, double times, double at, int *bad) {
    const double degree = M_PI / 180;
    if(f == 2) return 0.5 * share * radius * (1 + sin((times * at - 90) * degree));
    if(f == 3) {
        int up = sin((times * at - 90) * degree) >= 0;
        return 0.5 * share * radius * (1 + (up ? 1 : -1));
    } else {
        double side = 360 / times, place;
        if(times <= 2) {
            *bad = 1;
            return 0;
        }
        place = fmod(at + side / 2, side);
        radius *= 1 + share;
        if(f == 1) radius *= cos(M_PI / times);
        return radius / cos((side / 2 - place) * degree);
    }
}

FUNCTION(_) {
    double counts_per_unit = k == 0 ? 10000 : k;
    state_dbg = (rtapi_u32)state;
    kreciprocal = 1 / counts_per_unit;
    is_off = !is_on;
    if(is_off) {
        failed = 0;
        enable_out = 0;
        kcounts = 0;
        eoffset_dbg = 0;
        told = 0;
        state = OFF;
        return;
    }
    switch(state) {
    case OFF:
        if(enable_in) {
            if(!told)
                rtapi_print_msg(RTAPI_MSG_ERR, "eoffset_per_angle: active enable-in not honored at start\n");
            told = 1;
            return;
        }
        failed = 0;
        kcounts = 0;
        state = READY;
        return;
    case READY:
        if(!enable_in) return;
        kcounts = 0;
        enable_out = 0;
        state = RUNNING;
        return;
    case RUNNING:
        if(enable_in) {
            int flat = fnum < 2 || fnum > 3, bad = 0;
            double offset = shape(fnum, radius_ref, rfraction, fmult, angle - start_angle, &bad);
            enable_out = 1;
            if(flat) offset -= radius_ref;
            if(bad || isnan(offset)) {
                failed = 1;
                kcounts = 0;
                eoffset_dbg = 0;
                state = STOPPING;
                rtapi_print_msg(RTAPI_MSG_ERR, "eoffset_per_angle stopping:func%d problem\n", (int)fnum);
                return;
            }
            kcounts = real_to_s32(counts_per_unit * offset);
            eoffset_dbg = kcounts * kreciprocal;
        } else {
            clear = 1;
            kcounts = 0;
            eoffset_dbg = 0;
            state = STOPPING;
        }
        return;
    case STOPPING:
        if(!active) state = FINISH;
        return;
    default:
        enable_out = 0;
        state = failed ? OFF : READY;
        clear = 0;
    }
}
