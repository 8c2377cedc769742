// SPDX-License-Identifier: GPL-2.0-or-later
component ownmain "Its own rtapi_app_main";
pin out unsigned calls;
pin in bit enable = true;
function _ nofp;
option rtapi_app no;
option singleton no;
license "GPL";
;;
static int howmany = 2;
RTAPI_MP_INT(howmany, "instances");

FUNCTION(_) { if(enable) calls++; }

int rtapi_app_main(void) {
    int i, r;
    char buf[HAL_NAME_LEN + 1];
    comp_id = hal_init("ownmain");
    if(comp_id < 0) return comp_id;
    for(i = 0; i < howmany; i++) {
        rtapi_snprintf(buf, sizeof(buf), "own.%d", i);
        r = export(buf, i);
        if(r != 0) { hal_exit(comp_id); return r; }
    }
    hal_ready(comp_id);
    return 0;
}

void rtapi_app_exit(void) {
    hal_exit(comp_id);
}
