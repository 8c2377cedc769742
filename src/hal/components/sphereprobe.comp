// SPDX-License-Identifier: GPL-2.0-or-later
component sphereprobe "Probe on a pretended hemisphere";
pin in signed px "Position of the probe, in any unit.";
pin in signed py "Position of the probe.";
pin in signed pz "Position of the probe.";
pin in signed cx "Center of the sphere.";
pin in signed cy "Center of the sphere.";
pin in signed cz "Center of the sphere.";
pin in signed r "Radius of the sphere.";
pin out bit probe_out "TRUE while the probe is inside the sphere, or beside it and below its center.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
;;
static rtapi_s64 distance(rtapi_s32 a, rtapi_s32 b) {
    rtapi_s32 d = (rtapi_s32)((rtapi_u32)a - (rtapi_u32)b);
    return d < 0 ? (rtapi_s32)(0u - (rtapi_u32)d) : d;
}
FUNCTION(_) {
    rtapi_s64 dx = distance(px, cx), dy = distance(py, cy), dz = distance(pz, cz);
    rtapi_s64 flat2 = dx * dx + dy * dy, r2 = (rtapi_s64)r * r;
    probe_out = flat2 > r2 ? pz < cz : flat2 + dz * dz <= r2;
}
