// SPDX-License-Identifier: GPL-2.0-or-later
component readbutton "Userspace: counts in a loop of its own";
pin out s32 ticks;
pin in bit quit;
pin out float arg;
option userspace yes;
option userinit yes;
option extra_link_args "-lm";
license "GPL";
author "C. User";
include <stdlib.h>;
include <unistd.h>;
;;
#include <math.h>
static double start = 0;

void userinit(int argc, char **argv) {
    if(argc > 1) start = atof(argv[1]);
}

void user_mainloop(void) {
    for(;;) {
        int open = 0;
        FOR_ALL_INSTS() {
            ticks++;
            arg = sqrt(start);
            if(!quit) open = 1;
        }
        if(!open) return;
        usleep(1000);
    }
}
