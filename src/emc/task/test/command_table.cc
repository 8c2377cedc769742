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

// How the machine stands when a command comes, and the column of the documented table that counts then.
struct Standing {
    const char *name;
    int column; // 0 off, 1 manual, 2 to 5 auto with the interpreter idle, reading, paused, waiting, 6 MDI
    int state, mode;
    bool teleop;
    const char *program; // runs
    const char *mdi;     // runs
    bool pause;
};

constexpr int ESTOP = EMC_TASK_STATE_ESTOP, OFF = EMC_TASK_STATE_ESTOP_RESET, ON = EMC_TASK_STATE_ON;
constexpr int MANUAL = EMC_TASK_MODE_MANUAL, AUTO = EMC_TASK_MODE_AUTO, MDI = EMC_TASK_MODE_MDI;
const char *const DWELL = "G4 P1000";

const Standing STANDINGS[] = {
    {"estop", 0, ESTOP, MANUAL, false, nullptr, nullptr, false},
    {"off in manual", 0, OFF, MANUAL, false, nullptr, nullptr, false},
    {"off in auto", 0, OFF, AUTO, false, nullptr, nullptr, false},
    {"off in MDI", 0, OFF, MDI, false, nullptr, nullptr, false},
    {"manual, joints", 1, ON, MANUAL, false, nullptr, nullptr, false},
    {"manual, axes", 1, ON, MANUAL, true, nullptr, nullptr, false},
    {"auto idle", 2, ON, AUTO, false, nullptr, nullptr, false},
    {"auto reading", 3, ON, AUTO, false, "reading.ngc", nullptr, false}, // a queue buster behind a long dwell
    {"auto paused", 4, ON, AUTO, false, "reading.ngc", nullptr, true},
    {"auto waiting", 5, ON, AUTO, false, "waiting.ngc", nullptr, false},
    {"MDI idle", 6, ON, MDI, false, nullptr, nullptr, false},
    {"MDI running", 6, ON, MDI, false, nullptr, DWELL, false},
    {"MDI paused", 6, ON, MDI, false, nullptr, DWELL, true},
};
const char *const INTERPRETER[] = {"", "", "idle", "reading", "paused", "waiting"};

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
        while ((t = errors.read()) > 0)
            all += std::string(t == EMC_OPERATOR_ERROR_TYPE ? errors.get<EMC_OPERATOR_ERROR>()->error : "?") + "\n";
        return all;
    }

    void run(const char *program) {
        EMC_TASK_PLAN_OPEN open;
        copy_text(open.file, program);
        give(open);
        plain<EMC_TASK_PLAN_RUN>();
    }

    // Teleop needs homed joints; unhomed the machine stays in joint mode.
    bool enter(const Standing &to, bool homed) {
        plain<EMC_TASK_ABORT>();
        until(
            [&] { return stat.task.interpState == EMC_TASK_INTERP_IDLE && stat.task.execState == EMC_TASK_EXEC_DONE; });
        state(EMC_TASK_STATE_ESTOP_RESET);
        state(EMC_TASK_STATE_ON);
        if (!until([&] { return stat.task.state == ON; })) return false;
        mode(MANUAL);
        if (!until([&] { return stat.task.mode == MANUAL; })) return false;
        if (to.mode != MANUAL) {
            mode(to.mode);
            if (!until([&] { return stat.task.mode == to.mode; })) return false;
        } else {
            EMC_TRAJ_SET_TELEOP_ENABLE teleop;
            teleop.enable = to.teleop && homed;
            give(teleop);
            const int want = teleop.enable ? EMC_TRAJ_MODE_TELEOP : EMC_TRAJ_MODE_FREE;
            if (!until([&] { return stat.motion.traj.mode == want; })) return false;
        }
        if (to.state != ON) {
            state(to.state == ESTOP ? EMC_TASK_STATE_ESTOP : EMC_TASK_STATE_OFF);
            if (!until([&] { return stat.task.state == to.state && stat.task.mode == to.mode; })) return false;
        }
        bool good = true;
        if (to.program || to.mdi) {
            if (to.program) {
                run(to.program);
            } else {
                EMC_TASK_PLAN_EXECUTE execute;
                copy_text(execute.command, to.mdi);
                give(execute);
            }
            const int want = to.column == 5 ? EMC_TASK_INTERP_WAITING : EMC_TASK_INTERP_READING;
            good = until([&] {
                return stat.task.interpState == want && stat.task.execState == EMC_TASK_EXEC_WAITING_FOR_DELAY;
            });
        }
        if (to.pause) {
            plain<EMC_TASK_PLAN_PAUSE>();
            good = good && until([&] { return stat.task.interpState == EMC_TASK_INTERP_PAUSED; });
        }
        messages();
        return good;
    }
};

std::string refusal(NMLTYPE type, int column) {
    std::string name = emc_symbol_lookup(type), number = std::to_string(type);
    switch (column) {
    case 0: return "command (" + name + ") cannot be executed until the machine is out of E-stop and turned on";
    case 1: return "can't do that (" + name + ":" + number + ") in manual mode";
    case 6: return "can't do that (" + name + ":" + number + ") in MDI mode";
    default: return "can't do that (" + name + ") in auto mode with the interpreter " + INTERPRETER[column];
    }
}

// y taken, n refused as documented, ? refused otherwise; ! refused but the status is not ERROR.
std::string answer(Tester &t, const nml::MessageType &type, const Standing &to, bool homed) {
    if (!t.enter(to, homed)) {
        printf("can't get into %s (%s): state %d mode %d interpreter %d\n", to.name, homed ? "homed" : "not homed",
               t.stat.task.state, t.stat.task.mode, t.stat.task.interpState);
        exit(1);
    }
    std::vector<unsigned char> raw(static_cast<size_t>(type.size));
    RCS_CMD_MSG &m = *reinterpret_cast<RCS_CMD_MSG *>(raw.data());
    m._type = type.type;
    m.size = type.size;
    if (type.type == EMC_TASK_SET_MODE_TYPE) static_cast<EMC_TASK_SET_MODE &>(m).mode = MANUAL;
    if (type.type == EMC_TASK_SET_STATE_TYPE) static_cast<EMC_TASK_SET_STATE &>(m).state = ON;
    if (type.type == EMC_TASK_PLAN_OPEN_TYPE) copy_text(static_cast<EMC_TASK_PLAN_OPEN &>(m).file, "waiting.ngc");
    t.give(m);
    t.until([&] { return t.stat.echo_serial_number >= t.client.serial(); });
    std::string said = t.messages(), text = refusal(type.type, to.column);
    bool refused = said.find(text + "\n") != std::string::npos;
    if (!refused &&
        (said.find("can't do that") != std::string::npos || said.find("cannot be executed") != std::string::npos))
        return "?";
    return refused && t.stat.status != RCS_ERROR ? "n!" : refused ? "n" : "y";
}

} // namespace

int main() {
    kerf_clock_join("command-table", KERF_CLOCK_PRIO_TEST);
    Tester t;
    printf("%-40s", "");
    for (const Standing &s : STANDINGS) printf(" %s;", s.name);
    printf(" not homed, then homed\n");
    // Commands that only the interpreter gives, and structures, have no row; EMC_JOG_HELD is answered nothing.
    std::vector<const nml::MessageType *> types;
    std::vector<std::string> lines;
    for (const nml::MessageType &type : emc_messages().all())
        if (type.kind == nml::Kind::command && type.type != EMC_JOG_HELD_TYPE) types.push_back(&type);
    lines.resize(types.size());
    for (bool homed : {false, true}) {
        for (int j = 0; homed && j < 3; j++) {
            t.enter(STANDINGS[4], false);
            EMC_JOINT_HOME home;
            home.joint = j;
            t.give(home);
            t.until([&] { return t.stat.motion.joint[j].homed != 0; });
        }
        for (size_t i = 0; i < types.size(); i++) {
            if (homed) lines[i] += ' ';
            for (const Standing &s : STANDINGS) lines[i] += answer(t, *types[i], s, homed);
        }
    }
    for (size_t i = 0; i < types.size(); i++) printf("%-40s %s\n", types[i]->name, lines[i].c_str());
    t.plain<EMC_TASK_ABORT>();
    kerf_clock_leave();
    return 0;
}
