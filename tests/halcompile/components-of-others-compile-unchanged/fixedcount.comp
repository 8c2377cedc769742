// SPDX-License-Identifier: GPL-2.0-or-later
component fixedcount "How many is said by a function; made ready at the end of each";
pin out s32 number;
pin in float x;
pin out float y-#[2];
option count_function;
option post_export yes;
variable int made = 5;
function _;
license "GPL";
;;
int get_count(void) { return 3; }
POST_EXPORT() {
    (void)prefix;
    number = (hal_s32_t)extra_arg + made;
    return 0;
}
FUNCTION(_) { y(0) = x; y(1) = -x; }
