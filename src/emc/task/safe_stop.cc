// SPDX-License-Identifier: GPL-2.0-or-later
//
// safe_stop.cc - `kerf-safe-stop -ini FILE [--watch]`: what task did at its end when it can not do it any more.
//
// With --watch it is the process that task starts beside itself, in a session of its own: standard input is a pipe that
// task holds open. A byte: task ended in order, and so does this. The end of the pipe: task is dead.
//
// In:     motion's command block
// Out:    motion aborted and disabled, spindles and digital outputs off, analog outputs 0. What task's
//         pins fed falls when HAL removes its component, at the latest now (hal_init)
// Thread: [task]; never beside a task that lives
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "emc_args.hh"
#include "hal.h"
#include "inifile.hh"
#include "usrmotintf.h"

namespace {

constexpr double ECHO_S = 0.2; // of a motion that runs; one that does not can not move anything

bool order(cmd_code_t what, int spindle = 0, int output = 0) {
    emcmot_command_t c;
    memset(&c, 0, sizeof c);
    c.command = what;
    c.spindle = spindle;
    c.out = static_cast<unsigned char>(output);
    c.now = 1;
    return usrmotWriteEmcmotCommand(&c) == EMCMOT_COMM_OK;
}

// Those of M62 to M65, M67 and M68: what task drove, like its pins.
bool outputs_off() {
    emcmot_status_t s;
    bool good = usrmotReadEmcmotStatus(&s) == 0;
    for (int i = 0; good && i < EMCMOT_MAX_DIO; i++)
        if (s.synch_do[i]) good = order(EMCMOT_SET_DOUT, 0, i);
    for (int i = 0; good && i < EMCMOT_MAX_AIO; i++)
        if (s.analog_output[i] != 0) good = order(EMCMOT_SET_AOUT, 0, i);
    return good;
}

} // namespace

// True when the other end of standard input was closed without a word.
static bool task_died() {
    char byte;
    ssize_t n;
    do n = read(STDIN_FILENO, &byte, 1);
    while (n < 0 && errno == EINTR);
    return n <= 0;
}

int main(int argc, char **argv) {
    EmcArgs args(argc, argv);
    if (strcmp(argv[argc - 1], "--watch") == 0 && !task_died()) return 0;
    linuxcnc::IniFile ini;
    int key = 100, spindles = 1;
    if (ini.open(args.ini_file)) {
        key = ini.findIntV("SHMEM_KEY", "EMCMOT", key);
        spindles = ini.findIntV("SPINDLES", "TRAJ", spindles);
    }
    const int comp = hal_init("safe-stop");
    if (comp < 0) return 1;
    hal_ready(comp);
    bool good = usrmotInit("safe-stop", key, ECHO_S) == 0;
    if (good) {
        usrmotSetQuiet(1);
        good = order(EMCMOT_ABORT);
        for (int s = 0; good && s < spindles; s++) good = order(EMCMOT_SPINDLE_OFF, s);
        good = order(EMCMOT_DISABLE) && good;
        good = outputs_off() && good;
        usrmotExit();
    }
    hal_exit(comp);
    return good ? 0 : 1;
}
