component kerf_test_one;
pin out bit hal_x_;
function some_name;
option singleton;
option period no;
option rtapi_app no;
license "GPL";
;;
int rtapi_app_main(void) {
    char prefix[] = "own-prefix";
    comp_id = hal_init("kerf_test_one");
    if(comp_id < 0 || export(prefix, 0)) return -EINVAL;
    return hal_ready(comp_id);
}
void rtapi_app_exit(void) {
    hal_exit(comp_id);
}
FUNCTION(some_name) {
    hal_x_ = 1;
}
