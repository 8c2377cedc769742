component kerf_test_program "A program";
pin out s32 n;
pin in float x = 2.5;
option userspace;
option userinit;
option extra_compile_args "-DSTEP=3";
option extra_link_args "-lm";
license "GPL";
;;
#include <math.h>
#include <stdio.h>

void userinit(int argc, char **argv) {
    int i;
    printf("userinit:");
    for(i = 1; i < argc; i++) printf(" %s", argv[i]);
    printf("\n");
}

void user_mainloop(void) {
    FOR_ALL_INSTS() {
        n += STEP;
        printf("instance: %d %g %d arguments\n", (int)n, sqrt(x * 10), argc - 1);
    }
}
