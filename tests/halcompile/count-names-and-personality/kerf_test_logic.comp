component kerf_test_logic;
pin in bit in-##[4 : personality & 0xff];
pin out bit both if personality & 0x100;
param r s32 number;
function _;
option default_count 2;
option default_personality 1;
option post_export;
license "GPL";
;;
POST_EXPORT() {
    number = (rtapi_s32)extra_arg;
    return 0;
}
FUNCTION(_) {
    if(personality & 0x100) both = in(0);
}
