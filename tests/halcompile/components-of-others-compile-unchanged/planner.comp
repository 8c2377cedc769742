// SPDX-License-Identifier: GPL-2.0-or-later
component planner "A singleton with parameters of the module and functions of its own, for 2.9";
pin in float goal;
pin out float at;
pin out bit is_module = 1;
modparam int slots = 4 "Places in the table";
modparam dummy table "Numbers, by comma";
option singleton yes;
option period yes;
function step_once;
license "GPL";
;;
#include "rtapi.h"
#include "rtapi_math.h"
#define MAX_SLOTS 8
static char *table[MAX_SLOTS];
RTAPI_MP_ARRAY_STRING(table, MAX_SLOTS, "Numbers");
static double toward(double from, double to, double most)
{
    return fabs(to - from) <= most ? to : from + (to > from ? most : -most);
}
EXPORT_SYMBOL(planner_slots);
int planner_slots(void) { return slots; }

FUNCTION(step_once) {
    double most = (table[0] && table[0][0] == '2') ? 2 : 1;
    at = toward(at, goal, most * planner_slots() * fperiod * 250);
}
