// SPDX-License-Identifier: GPL-2.0-or-later
component sim_axis_hardware "Simulated home and limit switches of up to eight axes";
pin in float Xcurrent-pos "Position of X.";
pin in float Xhomesw-pos = 1 "Middle of the home switch.";
pin in float Xmaxsw-upper "Upper end of the maximum switch.";
pin in float Xmaxsw-lower "Lower end of the maximum switch.";
pin in float Xminsw-upper "Upper end of the minimum switch.";
pin in float Xminsw-lower "Lower end of the minimum switch.";
pin in float Xhomesw-hyst = 0.025 "Width of the home switch.";
pin in bit Xhoming "The axis is homing.";
pin out bit Xhomesw-out "Home switch.";
pin out bit Xmaxsw-out "Maximum limit switch.";
pin out bit Xminsw-out "Minimum limit switch.";
pin out bit Xbothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Xmaxsw-homesw-out "Maximum and home switch in one.";
pin out bit Xminsw-homesw-out "Minimum and home switch in one.";
pin out bit Xbothsw-homesw-out "All switches of the axis in one.";
pin in float X2current-pos "Position of X2.";
pin in float X2homesw-pos = 1 "Middle of the home switch.";
pin in float X2maxsw-upper "Upper end of the maximum switch.";
pin in float X2maxsw-lower "Lower end of the maximum switch.";
pin in float X2minsw-upper "Upper end of the minimum switch.";
pin in float X2minsw-lower "Lower end of the minimum switch.";
pin in float X2homesw-hyst = 0.025 "Width of the home switch.";
pin in bit X2homing "The axis is homing.";
pin out bit X2homesw-out "Home switch.";
pin out bit X2maxsw-out "Maximum limit switch.";
pin out bit X2minsw-out "Minimum limit switch.";
pin out bit X2bothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit X2maxsw-homesw-out "Maximum and home switch in one.";
pin out bit X2minsw-homesw-out "Minimum and home switch in one.";
pin out bit X2bothsw-homesw-out "All switches of the axis in one.";
pin in float Ycurrent-pos "Position of Y.";
pin in float Yhomesw-pos = 1 "Middle of the home switch.";
pin in float Ymaxsw-upper "Upper end of the maximum switch.";
pin in float Ymaxsw-lower "Lower end of the maximum switch.";
pin in float Yminsw-upper "Upper end of the minimum switch.";
pin in float Yminsw-lower "Lower end of the minimum switch.";
pin in float Yhomesw-hyst = 0.025 "Width of the home switch.";
pin in bit Yhoming "The axis is homing.";
pin out bit Yhomesw-out "Home switch.";
pin out bit Ymaxsw-out "Maximum limit switch.";
pin out bit Yminsw-out "Minimum limit switch.";
pin out bit Ybothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Ymaxsw-homesw-out "Maximum and home switch in one.";
pin out bit Yminsw-homesw-out "Minimum and home switch in one.";
pin out bit Ybothsw-homesw-out "All switches of the axis in one.";
pin in float Y2current-pos "Position of Y2.";
pin in float Y2homesw-pos = 1 "Middle of the home switch.";
pin in float Y2maxsw-upper "Upper end of the maximum switch.";
pin in float Y2maxsw-lower "Lower end of the maximum switch.";
pin in float Y2minsw-upper "Upper end of the minimum switch.";
pin in float Y2minsw-lower "Lower end of the minimum switch.";
pin in float Y2homesw-hyst = 0.025 "Width of the home switch.";
pin in bit Y2homing "The axis is homing.";
pin out bit Y2homesw-out "Home switch.";
pin out bit Y2maxsw-out "Maximum limit switch.";
pin out bit Y2minsw-out "Minimum limit switch.";
pin out bit Y2bothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Y2maxsw-homesw-out "Maximum and home switch in one.";
pin out bit Y2minsw-homesw-out "Minimum and home switch in one.";
pin out bit Y2bothsw-homesw-out "All switches of the axis in one.";
pin in float Zcurrent-pos "Position of Z.";
pin in float Zhomesw-pos = 1 "Middle of the home switch.";
pin in float Zmaxsw-upper "Upper end of the maximum switch.";
pin in float Zmaxsw-lower "Lower end of the maximum switch.";
pin in float Zminsw-upper "Upper end of the minimum switch.";
pin in float Zminsw-lower "Lower end of the minimum switch.";
pin in float Zhomesw-hyst = 0.025 "Width of the home switch.";
pin in bit Zhoming "The axis is homing.";
pin out bit Zhomesw-out "Home switch.";
pin out bit Zmaxsw-out "Maximum limit switch.";
pin out bit Zminsw-out "Minimum limit switch.";
pin out bit Zbothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Zmaxsw-homesw-out "Maximum and home switch in one.";
pin out bit Zminsw-homesw-out "Minimum and home switch in one.";
pin out bit Zbothsw-homesw-out "All switches of the axis in one.";
pin in float Acurrent-pos "Position of A.";
pin in float Ahomesw-pos = 1 "Middle of the home switch.";
pin in float Amaxsw-upper "Upper end of the maximum switch.";
pin in float Amaxsw-lower "Lower end of the maximum switch.";
pin in float Aminsw-upper "Upper end of the minimum switch.";
pin in float Aminsw-lower "Lower end of the minimum switch.";
pin in float Ahomesw-hyst = 0.025 "Width of the home switch.";
pin in bit Ahoming "The axis is homing.";
pin out bit Ahomesw-out "Home switch.";
pin out bit Amaxsw-out "Maximum limit switch.";
pin out bit Aminsw-out "Minimum limit switch.";
pin out bit Abothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Amaxsw-homesw-out "Maximum and home switch in one.";
pin out bit Aminsw-homesw-out "Minimum and home switch in one.";
pin out bit Abothsw-homesw-out "All switches of the axis in one.";
pin in float Ucurrent-pos "Position of U.";
pin in float Uhomesw-pos = 1 "Middle of the home switch.";
pin in float Umaxsw-upper "Upper end of the maximum switch.";
pin in float Umaxsw-lower "Lower end of the maximum switch.";
pin in float Uminsw-upper "Upper end of the minimum switch.";
pin in float Uminsw-lower "Lower end of the minimum switch.";
pin in float Uhomesw-hyst = 0.025 "Width of the home switch.";
pin in bit Uhoming "The axis is homing.";
pin out bit Uhomesw-out "Home switch.";
pin out bit Umaxsw-out "Maximum limit switch.";
pin out bit Uminsw-out "Minimum limit switch.";
pin out bit Ubothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Umaxsw-homesw-out "Maximum and home switch in one.";
pin out bit Uminsw-homesw-out "Minimum and home switch in one.";
pin out bit Ubothsw-homesw-out "All switches of the axis in one.";
pin in float Vcurrent-pos "Position of V.";
pin in float Vhomesw-pos = 1 "Middle of the home switch.";
pin in float Vmaxsw-upper "Upper end of the maximum switch.";
pin in float Vmaxsw-lower "Lower end of the maximum switch.";
pin in float Vminsw-upper "Upper end of the minimum switch.";
pin in float Vminsw-lower "Lower end of the minimum switch.";
pin in float Vhomesw-hyst = 0.025 "Width of the home switch.";
pin in bit Vhoming "The axis is homing.";
pin out bit Vhomesw-out "Home switch.";
pin out bit Vmaxsw-out "Maximum limit switch.";
pin out bit Vminsw-out "Minimum limit switch.";
pin out bit Vbothsw-out "Both limit switches in one; not while an axis is homing.";
pin out bit Vmaxsw-homesw-out "Maximum and home switch in one.";
pin out bit Vminsw-homesw-out "Minimum and home switch in one.";
pin out bit Vbothsw-homesw-out "All switches of the axis in one.";
pin out bit homesw-all "Home switches of all axes in one, while an axis is homing.";
pin out bit limitsw-all "Limit switches of all axes in one.";
pin out bit limitsw-homesw-all "Every switch in one.";
pin in float limit-offset = 0.01 "A limit switch begins this much inside its range.";
function update "Updates the switches.";
option period no;
notes "The combinations of A with its home switch are never TRUE.";
see_also "sim_home_switch(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
/* An axis: its own outputs, and its share of the common ones. */
#define AXIS(a) do { \
        double at = a##current_pos; \
        a##homesw_out = fabs(at - a##homesw_pos) <= a##homesw_hyst / 2; \
        a##maxsw_out = at > a##maxsw_lower + limit_offset && at < a##maxsw_upper; \
        a##minsw_out = at > a##minsw_lower && at < a##minsw_upper - limit_offset; \
        a##bothsw_out = (a##maxsw_out || a##minsw_out) && !homing; \
        any_home |= a##homesw_out; \
        any_limit |= a##bothsw_out; \
    } while(0)
#define WITH_HOME(a) do { \
        a##maxsw_homesw_out = a##maxsw_out || a##homesw_out; \
        a##minsw_homesw_out = a##minsw_out || a##homesw_out; \
        a##bothsw_homesw_out = a##bothsw_out || a##homesw_out; \
    } while(0)

FUNCTION(update) {
    int any_home = 0, any_limit = 0;
    int homing = Xhoming || X2homing || Yhoming || Y2homing || Zhoming || Ahoming || Uhoming || Vhoming;
    AXIS(X);
    AXIS(X2);
    AXIS(Y);
    AXIS(Y2);
    AXIS(Z);
    AXIS(A);
    AXIS(U);
    AXIS(V);
    WITH_HOME(X);
    WITH_HOME(X2);
    WITH_HOME(Y);
    WITH_HOME(Y2);
    WITH_HOME(Z);
    WITH_HOME(U);
    WITH_HOME(V);
    homesw_all = any_home && homing;
    limitsw_all = any_limit;
    limitsw_homesw_all = homesw_all || limitsw_all;
}
