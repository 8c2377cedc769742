// SPDX-License-Identifier: GPL-2.0-or-later
//
// command_table.cc - drives every command in every situation of task and prints what was
// answered: y taken, n refused with the documented text. Display program of tests/task.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "client.hh"
#include "kerf_clock.h"
#include "task_text.hh"

namespace {

const char *const SITUATIONS[] = {"off", "manual", "auto idle", "auto reading", "auto paused", "auto waiting", "mdi"};

struct Tester {
    EmcClient client;
    NML errors{emc_messages(), "emcError", "xemc", nullptr};
    EMC_STAT stat;

    void look() {
        client.refresh(&stat);
    }
    template <class F> bool until(F f, double seconds = 5) {
        int64_t end = kerf_clock_now_ns() + static_cast<int64_t>(seconds * 1e9);
        for (look(); !f(); look()) {
            if (kerf_clock_now_ns() > end) return false;
            kerf_clock_sleep_ns(1'000'000);
        }
        return true;
    }
    void give(RCS_CMD_MSG &m) {
        if (!client.send(m) || !client.wait_received(5, 0.001)) {
            printf("no answer to %s\n", emc_symbol_lookup(m._type));
            exit(1);
        }
    }
    template <class M> void plain() { M m; give(m); }
    void state(int s) { EMC_TASK_SET_STATE m; m.state = s; give(m); }
    void mode(int v) { EMC_TASK_SET_MODE m; m.mode = v; give(m); }
    std::string messages() {
        std::string all;
        NMLTYPE t;
        while ((t = errors.read()) > 0) all += std::string(t == EMC_OPERATOR_ERROR_TYPE ? errors.get<EMC_OPERATOR_ERROR>()->error : "?") + "\n";
        return all;
    }

    void run(const char *program) {
        EMC_TASK_PLAN_OPEN open;
        copy_text(open.file, program);
        give(open);
        plain<EMC_TASK_PLAN_RUN>();
    }

    bool enter(int situation) {
        plain<EMC_TASK_ABORT>();
        until([&] { return stat.task.interpState == EMC_TASK_INTERP_IDLE && stat.task.execState == EMC_TASK_EXEC_DONE; });
        state(EMC_TASK_STATE_ESTOP_RESET);
        if (situation == 0) {
            state(EMC_TASK_STATE_OFF);
            bool good = until([&] { return stat.task.state == EMC_TASK_STATE_ESTOP_RESET; });
            messages();
            return good;
        }
        state(EMC_TASK_STATE_ON);
        if (!until([&] { return stat.task.state == EMC_TASK_STATE_ON; })) return false;
        mode(EMC_TASK_MODE_MANUAL);
        if (!until([&] { return stat.task.mode == EMC_TASK_MODE_MANUAL; })) return false;
        if (situation >= 2) {
            int m = situation == 6 ? EMC_TASK_MODE_MDI : EMC_TASK_MODE_AUTO;
            mode(m);
            if (!until([&] { return stat.task.mode == m; })) return false;
        }
        bool good = true;
        if (situation == 3) { // a queue buster behind a long dwell keeps it reading
            run("reading.ngc");
            good = until([&] { return stat.task.interpState == EMC_TASK_INTERP_READING && stat.task.execState == EMC_TASK_EXEC_WAITING_FOR_DELAY; });
        } else if (situation == 4) {
            run("reading.ngc");
            until([&] { return stat.task.execState == EMC_TASK_EXEC_WAITING_FOR_DELAY; });
            plain<EMC_TASK_PLAN_PAUSE>();
            good = until([&] { return stat.task.interpState == EMC_TASK_INTERP_PAUSED; });
        } else if (situation == 5) {
            run("waiting.ngc");
            good = until([&] { return stat.task.interpState == EMC_TASK_INTERP_WAITING && stat.task.execState == EMC_TASK_EXEC_WAITING_FOR_DELAY; });
        }
        messages();
        return good;
    }
};

std::string refusal(NMLTYPE type, int situation) {
    std::string name = emc_symbol_lookup(type), number = std::to_string(type);
    switch (situation) {
    case 0: return "command (" + name + ") cannot be executed until the machine is out of E-stop and turned on";
    case 1: return "can't do that (" + name + ":" + number + ") in manual mode";
    case 6: return "can't do that (" + name + ":" + number + ") in MDI mode";
    default: return "can't do that (" + name + ") in auto mode with the interpreter " + (SITUATIONS[situation] + 5);
    }
}

} // namespace

int main() {
    kerf_clock_join("command-table", KERF_CLOCK_PRIO_TEST);
    Tester t;
    // Commands that only the interpreter gives, and structures, have no row.
    for (const nml::MessageType &type : emc_messages().all()) {
        if (type.kind != nml::Kind::command) continue;
        std::string line;
        for (int s = 0; s < 7; s++) {
            if (!t.enter(s)) {
                printf("can't get into %s\n", SITUATIONS[s]);
                return 1;
            }
            std::vector<unsigned char> raw(static_cast<size_t>(type.size));
            RCS_CMD_MSG &m = *reinterpret_cast<RCS_CMD_MSG *>(raw.data());
            m._type = type.type;
            m.size = type.size;
            if (type.type == EMC_TASK_SET_MODE_TYPE) static_cast<EMC_TASK_SET_MODE &>(m).mode = EMC_TASK_MODE_MANUAL;
            if (type.type == EMC_TASK_SET_STATE_TYPE) static_cast<EMC_TASK_SET_STATE &>(m).state = EMC_TASK_STATE_ON;
            if (type.type == EMC_TASK_PLAN_OPEN_TYPE) copy_text(static_cast<EMC_TASK_PLAN_OPEN &>(m).file, "waiting.ngc");
            t.give(m);
            t.until([&] { return t.stat.echo_serial_number >= t.client.serial(); });
            std::string said = t.messages(), text = refusal(type.type, s);
            bool refused = said.find(text + "\n") != std::string::npos;
            if (!refused && said.find("can't do that") != std::string::npos) line += '?';
            else line += refused ? 'n' : 'y';
            if (refused && t.stat.status != RCS_ERROR) line += '!';
        }
        printf("%-40s %s\n", type.name, line.c_str());
        fflush(stdout);
    }
    t.plain<EMC_TASK_ABORT>();
    kerf_clock_leave();
    return 0;
}
