component kerf_test_single "A program with one instance";
pin out si32 n;
option userspace;
option singleton;
option extra_cleanup;
license "GPL";
;;
#include <stdio.h>

EXTRA_CLEANUP() {
    puts("cleanup");
}

void user_mainloop(void) {
    FOR_ALL_INSTS() {
        n_set(n + 7);
        printf("single: %d\n", n);
    }
}
