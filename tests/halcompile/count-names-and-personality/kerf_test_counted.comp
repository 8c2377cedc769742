component kerf_test_counted;
pin out bit x;
function _;
option count_function;
license "GPL";
;;
int get_count(void) {
    return 2;
}
FUNCTION(_) {
    x = fperiod > 0;
}
