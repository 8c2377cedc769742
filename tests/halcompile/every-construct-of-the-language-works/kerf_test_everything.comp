/* A component that uses every declaration of the language, in the old style and
 * in the new one. */
component kerf_test_everything "Uses everything";
description "A text.";
pin in float in-##[8 : personality & 0xf] = 3.5 if personality < 100 "Inputs";
pin in bit maybe if (personality >> 4) & 1 ? 1 : 0;     // not there with personality 3
pin out s32 out.#.val[4] = -2;
pin io bit io_pin_ = true;
pin in unsigned plain;
pin out s64 big;
pin out u64 ubig;
pin in port queue;
pin in bool nb = true;
pin out real nr = 1.5;
pin out sint ns = -7;
pin out uint nu = 8;
pin out si32 n3 = -3;
pin out ui32 n4 = 4 "new style, 32 bits";
pin out real nra-#[3] = 0.25;
param r float rf = 1e3;
param rw u32 ru = 0x10;
param rw real rr = 2.5;
param rw si32 rsi;
param rw real rra-#[2];
variable int calls = 0x10;
variable double arr[4] = 2.5;
variable double *pointer;
variable int flag = TRUE;
function _ "main";
function second_function "second";
option extra_setup;
option extra_cleanup yes;
option post_export;
option default_personality 3;
option data instance_data;
option some_unknown_option "is ignored";
modparam int factor = 7 "A load parameter";
modparam dummy other "Only in the manual";
include <rtapi_math.h>;
examples "none";
notes """two
lines""";
see_also r"""and2\(9)""";
author "me";
license "GPL";
;;
typedef struct {
    int extra;
    double b[3];
} instance_data;

static int other = 3;
RTAPI_MP_INT(other, "declared in C");

EXTRA_SETUP() {
    if(personality > 8) personality = 8;
    data.extra = (int)extra_arg;
    return 0;
}
EXTRA_CLEANUP() {
}
POST_EXPORT() {
    calls += other;
    return 0;
}
static double helper(struct __comp_state *__comp_inst) {
    return sqrt(in(0));
}
FUNCTION(_) {
    int i;
    calls++;
    out_val(0) = calls;
    out_val(1) = flag;
    out_val(2) = (int)arr[3];
    out_val(3) = factor + data.extra;
    for(i = 0; i < 3; i++) nra_set(i, nra(i) + fperiod);
    io_pin_ = !io_pin_;
    big = -5000000000;
    ubig++;
    nr_set(rr * 2 + nb);
    ns_set(ns + 1);
    nu_set(nu + 1);
    n3_set(n3 + 1);
    n4_set(n4 + 1);
    rsi_set(5);
    rra_set(1, 2.0);
    rf = helper(__comp_inst);
    pointer = &arr[0];
    *pointer += 1;
    data.b[0] = *pointer + plain;
}
FUNCTION(second_function) {
    ru++;
    if(TRUE && !FALSE) ru++;
}
