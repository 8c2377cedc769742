// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc_tcl.cc - Tcl commands that drive the controller (part of package Linuxcnc): emc_init,
// emc_mode, emc_mdi and so on. Source: Tcl sheet, part C. [task]
//
// A command that sets waits until task has read it (emc_set_wait done: until it is done);
// one that asks refreshes the status first (emc_update none: it does not).
#include <tcl.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client.hh"
#include "emc_tcl.hh"
#include "emc_args.hh"
#include "inifile.hh"
#include "kerf_clock.h"
#include "rcs_print.hh"
#include "task_text.hh"

namespace {

constexpr char LONG_NAME[] = "File name limited to 254 characters";

struct Link {
    std::unique_ptr<EmcClient> client;
    std::unique_ptr<NML> errors;
    EMC_STAT stat;
    std::string ini_file = "emc.ini";
    bool wait_done = false, update_auto = true;
    double timeout_s = 0; // 0: for ever
    std::string linear = "auto", angular = "auto";
    std::deque<std::string> error, text, display;
    int start_line = 0;

    void refresh() { client->refresh(&stat); }
    void read_messages() {
        for (;;) {
            switch (errors->read()) {
            case 1: error.emplace_back(errors->get<::NML_ERROR>()->error); break; // NML_ERROR
            case NML_TEXT_TYPE: text.emplace_back(errors->get<NML_TEXT>()->text); break;
            case NML_DISPLAY_TYPE: display.emplace_back(errors->get<NML_DISPLAY>()->display); break;
            case EMC_OPERATOR_ERROR_TYPE: error.emplace_back(errors->get<EMC_OPERATOR_ERROR>()->error); break;
            case EMC_OPERATOR_TEXT_TYPE: text.emplace_back(errors->get<EMC_OPERATOR_TEXT>()->text); break;
            case EMC_OPERATOR_DISPLAY_TYPE: display.emplace_back(errors->get<EMC_OPERATOR_DISPLAY>()->display); break;
            default: return;
            }
        }
    }
};

// One call: arguments, results, mistakes.
struct Call {
    Tcl_Interp *interp;
    int argc;
    Tcl_Obj *const *argv;
    Link &link;

    std::string name() const { return Tcl_GetString(argv[0]); }
    std::string arg(int n) const { return n < argc ? Tcl_GetString(argv[n]) : ""; }
    int result(const std::string &s) const {
        Tcl_SetObjResult(interp, Tcl_NewStringObj(s.data(), static_cast<int>(s.size())));
        return TCL_OK;
    }
    int result(double v) const {
        Tcl_SetObjResult(interp, Tcl_NewDoubleObj(v));
        return TCL_OK;
    }
    int result(int v) const {
        Tcl_SetObjResult(interp, Tcl_NewIntObj(v));
        return TCL_OK;
    }
    int fail(const std::string &s) const {
        std::string t = name() + ": " + s;
        Tcl_SetObjResult(interp, Tcl_NewStringObj(t.data(), static_cast<int>(t.size())));
        return TCL_ERROR;
    }
    bool whole(int n, int *v) const { return Tcl_GetIntFromObj(nullptr, argv[n], v) == TCL_OK; }
    bool real(int n, double *v) const { return Tcl_GetDoubleFromObj(nullptr, argv[n], v) == TCL_OK; }
    int need(const std::string &what) const { return fail("need " + what); }

    // Sends and waits as set. What can't be sent, fails or is not done in time is a text, not an error.
    int give(RCS_CMD_MSG &m) const {
        static const std::map<std::string, const char *> words = {
            {"emc_mdi", "error executing command"},           {"emc_run", "can't execute program"},
            {"emc_abort", "can't execute program"},           {"emc_pause", "can't pause program"},
            {"emc_resume", "can't resume program"},           {"emc_step", "can't step program"},
            {"emc_task_plan_init", "can't init interpreter"}, {"emc_optional_stop", "can't send command"},
            {"emc_override_limit", "can't send command"},     {"emc_set_tool_offset", "can't set it"}};
        bool good = link.client->send(m);
        double t = link.timeout_s > 0 ? link.timeout_s : -1;
        if (good)
            good = link.wait_done ? link.client->wait_done(t, 0.001) == RCS_DONE : link.client->wait_received(t, 0.001);
        if (good) return TCL_OK;
        auto it = words.find(name());
        return result(name() + ": " + (it == words.end() ? "can't " + name().substr(4) : it->second));
    }
    template <class M> int plain() const {
        M m;
        return give(m);
    }

    // A file's name into a message; false when it does not fit.
    template <size_t N> bool file_name(int n, char (&to)[N]) const {
        copy_text(to, arg(n).c_str());
        return arg(n).size() < N;
    }

    // Index of a word in a list; -1 with an error.
    int word(int n, const std::vector<const char *> &words, int *index) const {
        for (size_t i = 0; i < words.size(); i++)
            if (strcasecmp(arg(n).c_str(), words[i]) == 0) {
                *index = static_cast<int>(i);
                return TCL_OK;
            }
        std::string list;
        for (size_t i = 0; i < words.size(); i++)
            list += (i ? i + 1 == words.size() ? ", or '" : ", '" : "'") + std::string(words[i]) + "'";
        return need(list);
    }
    bool axis(int n, int *a) const {
        std::string s = arg(n);
        const char *letters = "XYZABCUVW",
                   *p = s.size() == 1 ? strchr(letters, toupper(static_cast<unsigned char>(s[0]))) : nullptr;
        if (p && *p) {
            *a = static_cast<int>(p - letters);
            return true;
        }
        return whole(n, a) && *a >= 0 && *a < EMCMOT_MAX_AXIS;
    }
    bool joint(int n, int *j) const { return n < argc && whole(n, j) && *j >= 0 && *j < EMCMOT_MAX_JOINTS; }
};

double nth(const EmcPose &p, int a) {
    const double v[] = {p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w};
    return v[a];
}

double display_linear(const Link &l, double v) {
    double mm = v / (l.stat.motion.traj.linearUnits > 0 ? l.stat.motion.traj.linearUnits : 1);
    std::string u = l.linear;
    if (u == "auto") u = l.stat.task.programUnits == 1 ? "inch" : l.stat.task.programUnits == 3 ? "cm" : "mm";
    if (u == "inch") return mm / 25.4;
    if (u == "cm") return mm / 10;
    if (u == "custom") return v;
    return mm;
}

double display_angular(const Link &l, double v) {
    double deg = v / (l.stat.motion.traj.angularUnits > 0 ? l.stat.motion.traj.angularUnits : 1);
    if (l.angular == "rad") return deg * M_PI / 180;
    if (l.angular == "grad") return deg * 100 / 90;
    return deg;
}

double display(const Link &l, double v, int axis) {
    return axis >= 3 && axis <= 5 ? display_angular(l, v) : display_linear(l, v);
}

bool near(double a, double b) { return std::fabs(a - b) < 1e-3; }
std::string linear_name(double u) {
    return near(u, 1) ? "mm" : near(u, 1 / 25.4) ? "inch" : near(u, 0.1) ? "cm" : "custom";
}
std::string angular_name(double u) {
    return near(u, 1) ? "deg" : near(u, 0.9) || near(u, 100.0 / 90) ? "grad" : near(u, M_PI / 180) ? "rad" : "custom";
}
std::string program_name(int u) { return u == 1 ? "inch" : u == 2 ? "mm" : u == 3 ? "cm" : "custom"; }

template <class ON, class OFF> int on_off(const Call &c, bool now) {
    if (c.argc == 1) return c.result(std::string(now ? "on" : "off"));
    int i;
    if (c.argc != 2) return c.need("no arguments, or 'on' or 'off'");
    if (c.word(1, {"on", "off"}, &i) != TCL_OK) return TCL_ERROR;
    return i == 0 ? c.plain<ON>() : c.plain<OFF>();
}

int position(const Call &c, const EmcPose &p) {
    int a;
    if (c.argc != 2 || !c.axis(1, &a)) return c.need("axis");
    return c.result(display(c.link, nth(p, a), a));
}

EmcPose relative(const EmcPose &p, const EMC_TASK_STAT &t) {
    EmcPose r = p;
    for (const EmcPose *o : {&t.g5x_offset, &t.g92_offset, &t.toolOffset}) {
        r.tran.x -= o->tran.x;
        r.tran.y -= o->tran.y;
        r.tran.z -= o->tran.z;
        r.a -= o->a;
        r.b -= o->b;
        r.c -= o->c;
        r.u -= o->u;
        r.v -= o->v;
        r.w -= o->w;
    }
    return r;
}

int message(const Call &c, std::deque<std::string> &queue) {
    c.link.read_messages();
    if (queue.empty()) return c.result(std::string("ok"));
    std::string t = queue.front();
    queue.pop_front();
    return c.result(t);
}

int percent(const Call &c, double now, int (*set)(const Call &, double)) {
    if (c.argc == 1) return c.result(static_cast<int>(std::floor(now * 100 + 0.5)));
    double v;
    if (c.argc != 2 || !c.real(1, &v)) return c.need("no arguments, or a percentage");
    return set(c, v / 100);
}

int ask(const Call &c) { // refreshes for queries
    if (c.link.update_auto) c.link.refresh();
    return TCL_OK;
}

using Function = int (*)(const Call &);
struct Command {
    const char *name;
    Function run;
};

std::vector<Command> make_commands() {
    std::vector<Command> table;
    auto add = [&table](const char *name, int (*run)(const Call &)) { table.push_back({name, run}); };
    add("emc_plat",
        [](const Call &c) -> int { return c.argc == 1 ? c.result(std::string("Linux")) : c.need("no arguments"); });
    add("emc_time", [](const Call &c) -> int {
        timeval tv;
        gettimeofday(&tv, nullptr);
        return c.result(static_cast<double>(tv.tv_sec) + static_cast<double>(tv.tv_usec) * 1e-6);
    });
    add("emc_debug", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(c.link.stat.debug);
        int v;
        if (c.argc != 2 || !c.whole(1, &v)) return c.need("no arguments, or a debug mask");
        EMC_SET_DEBUG m;
        m.debug = static_cast<unsigned>(v);
        return c.give(m);
    });
    add("emc_set_wait", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(std::string(c.link.wait_done ? "done" : "received"));
        int i;
        if (c.argc != 2) return c.need("'received', 'done', or no arguments");
        if (c.word(1, {"received", "done"}, &i) != TCL_OK) return TCL_ERROR;
        c.link.wait_done = i == 1;
        return TCL_OK;
    });
    add("emc_wait", [](const Call &c) -> int {
        int i;
        if (c.argc != 2) return c.need("'received' or 'done'");
        if (c.word(1, {"received", "done"}, &i) != TCL_OK) return TCL_ERROR;
        double t = c.link.timeout_s > 0 ? c.link.timeout_s : -1;
        bool good = i == 0 ? c.link.client->wait_received(t, 0.001) : c.link.client->wait_done(t, 0.001) >= 0;
        return good ? TCL_OK : c.result(std::string("timeout"));
    });
    add("emc_set_timeout", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(c.link.timeout_s);
        double t;
        if (c.argc != 2 || !c.real(1, &t) || t < 0) return c.need("no arguments, or seconds");
        c.link.timeout_s = t;
        return TCL_OK;
    });
    add("emc_update", [](const Call &c) -> int {
        if (c.argc == 1) {
            c.link.refresh();
            return TCL_OK;
        }
        int i;
        if (c.word(1, {"none", "auto"}, &i) != TCL_OK) return TCL_ERROR;
        c.link.update_auto = i == 1;
        return TCL_OK;
    });
    add("emc_error", [](const Call &c) -> int { return message(c, c.link.error); });
    add("emc_operator_text", [](const Call &c) -> int { return message(c, c.link.text); });
    add("emc_operator_display", [](const Call &c) -> int { return message(c, c.link.display); });
    add("emc_estop", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(std::string(c.link.stat.task.state == EMC_TASK_STATE_ESTOP ? "on" : "off"));
        int i;
        if (c.argc != 2) return c.need("no arguments, or 'on' or 'off'");
        if (c.word(1, {"on", "off"}, &i) != TCL_OK) return TCL_ERROR;
        EMC_TASK_SET_STATE m;
        m.state = i == 0 ? EMC_TASK_STATE_ESTOP : EMC_TASK_STATE_ESTOP_RESET;
        return c.give(m);
    });
    add("emc_machine", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(std::string(c.link.stat.task.state == EMC_TASK_STATE_ON ? "on" : "off"));
        int i;
        if (c.argc != 2) return c.need("no arguments, or 'on' or 'off'");
        if (c.word(1, {"on", "off"}, &i) != TCL_OK) return TCL_ERROR;
        EMC_TASK_SET_STATE m;
        m.state = i == 0 ? EMC_TASK_STATE_ON : EMC_TASK_STATE_OFF;
        return c.give(m);
    });
    add("emc_mode", [](const Call &c) -> int {
        int v = c.link.stat.task.mode;
        if (c.argc == 1)
            return c.result(std::string(v == EMC_TASK_MODE_AUTO ? "auto" : v == EMC_TASK_MODE_MDI ? "mdi" : "manual"));
        int i;
        if (c.argc != 2) return c.need("no arguments, or 'manual', 'auto' or 'mdi'");
        if (c.word(1, {"manual", "auto", "mdi"}, &i) != TCL_OK) return TCL_ERROR;
        EMC_TASK_SET_MODE m;
        m.mode = i + 1;
        return c.give(m);
    });
    add("emc_mist", [](const Call &c) -> int {
        return on_off<EMC_COOLANT_MIST_ON, EMC_COOLANT_MIST_OFF>(c, c.link.stat.io.coolant.mist);
    });
    add("emc_flood", [](const Call &c) -> int {
        return on_off<EMC_COOLANT_FLOOD_ON, EMC_COOLANT_FLOOD_OFF>(c, c.link.stat.io.coolant.flood);
    });
    add("emc_spindle", [](const Call &c) -> int {
        int n = 0, at = 1, i;
        if (c.argc > 1 && c.whole(1, &n)) at = 2;
        if (n < 0 || n >= EMCMOT_MAX_SPINDLES) return c.fail("invalid spindle number");
        if (c.argc == at) {
            int d = c.link.stat.motion.spindle[n].direction;
            return c.result(std::string(d > 0 ? "forward" : d < 0 ? "reverse" : "off"));
        }
        if (c.argc != at + 1)
            return c.need("[spindle] and 'forward', 'reverse', 'increase', 'decrease', 'constant', or 'off'");
        if (c.word(at, {"forward", "reverse", "increase", "decrease", "constant", "off"}, &i) != TCL_OK)
            return TCL_ERROR;
        double speed = std::fabs(c.link.stat.task.activeSettings[2]);
        if (speed == 0) speed = 500;
        switch (i) {
        case 0:
        case 1: {
            EMC_SPINDLE_ON m;
            m.spindle = n;
            m.speed = i == 0 ? speed : -speed;
            return c.give(m);
        }
        case 2: {
            EMC_SPINDLE_INCREASE m;
            m.spindle = n;
            return c.give(m);
        }
        case 3: {
            EMC_SPINDLE_DECREASE m;
            m.spindle = n;
            return c.give(m);
        }
        case 4: {
            EMC_SPINDLE_CONSTANT m;
            m.spindle = n;
            return c.give(m);
        }
        default: {
            EMC_SPINDLE_OFF m;
            m.spindle = n;
            return c.give(m);
        }
        }
    });
    add("emc_brake", [](const Call &c) -> int {
        int n = 0, at = 1, i;
        if (c.argc > 1 && c.whole(1, &n)) at = 2;
        if (n < 0 || n >= EMCMOT_MAX_SPINDLES) return c.fail("invalid spindle number");
        if (c.argc == at) return c.result(std::string(c.link.stat.motion.spindle[n].brake ? "on" : "off"));
        if (c.argc != at + 1) return c.need("[spindle] and 'on' or 'off'");
        if (c.word(at, {"on", "off"}, &i) != TCL_OK) return TCL_ERROR;
        if (i == 0) {
            EMC_SPINDLE_BRAKE_ENGAGE m;
            m.spindle = n;
            return c.give(m);
        }
        EMC_SPINDLE_BRAKE_RELEASE m;
        m.spindle = n;
        return c.give(m);
    });
    add("emc_tool", [](const Call &c) -> int { return c.result(c.link.stat.io.tool.toolInSpindle); });
    add("emc_tool_offset", [](const Call &c) -> int {
        int a = 2;
        if (c.argc > 1 && !c.axis(1, &a)) return c.need("axis");
        return c.result(display(c.link, nth(c.link.stat.task.toolOffset, a), a));
    });
    add("emc_load_tool_table", [](const Call &c) -> int {
        if (c.argc != 2) return c.need("file");
        EMC_TOOL_LOAD_TOOL_TABLE m;
        if (!c.file_name(1, m.file)) return c.fail(LONG_NAME);
        return c.give(m);
    });
    add("emc_set_tool_offset", [](const Call &c) -> int {
        EMC_TOOL_SET_OFFSET m;
        if (c.argc != 4 || !c.whole(1, &m.toolno) || !c.real(2, &m.offset.tran.z) || !c.real(3, &m.diameter))
            return c.need("<tool> <length> <diameter>");
        return c.give(m);
    });
    add("emc_abs_cmd_pos", [](const Call &c) -> int { return position(c, c.link.stat.motion.traj.position); });
    add("emc_abs_act_pos", [](const Call &c) -> int { return position(c, c.link.stat.motion.traj.actualPosition); });
    add("emc_rel_cmd_pos",
        [](const Call &c) -> int { return position(c, relative(c.link.stat.motion.traj.position, c.link.stat.task)); });
    add("emc_rel_act_pos", [](const Call &c) -> int {
        return position(c, relative(c.link.stat.motion.traj.actualPosition, c.link.stat.task));
    });
    add("emc_pos_offset", [](const Call &c) -> int {
        int a;
        if (c.argc != 2 || !c.axis(1, &a)) return c.need("axis");
        return c.result(display(c.link, nth(c.link.stat.task.g5x_offset, a) + nth(c.link.stat.task.g92_offset, a), a));
    });
    add("emc_joint_pos", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        const EMC_JOINT_STAT &s = c.link.stat.motion.joint[j];
        return c.result(s.jointType == EMC_ANGULAR ? display_angular(c.link, s.input)
                                                   : display_linear(c.link, s.input));
    });
    add("emc_joint_limit", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        const EMC_JOINT_STAT &s = c.link.stat.motion.joint[j];
        return c.result(std::string(s.minHardLimit   ? "minhard"
                                    : s.minSoftLimit ? "minsoft"
                                    : s.maxSoftLimit ? "maxsoft"
                                    : s.maxHardLimit ? "maxhard"
                                                     : "ok"));
    });
    add("emc_joint_fault", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        return c.result(std::string(c.link.stat.motion.joint[j].fault ? "fault" : "ok"));
    });
    add("emc_joint_homed", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        return c.result(std::string(c.link.stat.motion.joint[j].homed ? "homed" : "not"));
    });
    add("emc_joint_backlash", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint and backlash");
        if (c.argc == 2) return c.result(c.link.stat.motion.joint[j].backlash);
        EMC_JOINT_SET_BACKLASH m;
        m.joint = j;
        if (!c.real(2, &m.backlash)) return c.need("joint and backlash");
        return c.give(m);
    });
    add("emc_joint_enable", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        if (c.argc == 2) return c.result(static_cast<int>(c.link.stat.motion.joint[j].enabled));
        return TCL_OK; // amplifiers follow the machine's state
    });
    add("emc_joint_load_comp", [](const Call &c) -> int {
        EMC_JOINT_LOAD_COMP m;
        if (c.argc != 4 || !c.joint(1, &m.joint) || !c.whole(3, &m.type)) return c.need("joint, file and type");
        if (!c.file_name(2, m.file)) return c.fail(LONG_NAME);
        return c.give(m);
    });
    add("emc_joint_type", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        int t = c.link.stat.motion.joint[j].jointType;
        return c.result(std::string(t == EMC_LINEAR ? "linear" : t == EMC_ANGULAR ? "angular" : "custom"));
    });
    add("emc_joint_units", [](const Call &c) -> int {
        int j;
        if (!c.joint(1, &j)) return c.need("joint");
        const EMC_JOINT_STAT &s = c.link.stat.motion.joint[j];
        return c.result(s.jointType == EMC_ANGULAR ? angular_name(s.units) : linear_name(s.units));
    });
    add("emc_override_limit", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(static_cast<int>(c.link.stat.motion.joint[0].overrideLimits));
        int v;
        if (c.argc != 2 || !c.whole(1, &v)) return c.need("0 or 1");
        EMC_JOINT_OVERRIDE_LIMITS m;
        m.joint = v ? 0 : -1;
        return c.give(m);
    });
    add("emc_optional_stop", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(static_cast<int>(c.link.stat.task.optional_stop_state));
        int v;
        if (c.argc != 2 || !c.whole(1, &v)) return c.need("0 or 1");
        EMC_TASK_PLAN_SET_OPTIONAL_STOP m;
        m.state = v != 0;
        return c.give(m);
    });
    add("emc_mdi", [](const Call &c) -> int {
        if (c.argc < 2) return c.need("command");
        std::string line;
        for (int i = 1; i < c.argc; i++) line += (i > 1 ? " " : "") + c.arg(i);
        EMC_TASK_PLAN_EXECUTE m;
        if (line.size() >= sizeof m.command) return c.fail("MDI commands limited to 254 characters");
        copy_text(m.command, line.c_str());
        return c.give(m);
    });
    add("emc_home", [](const Call &c) -> int {
        EMC_JOINT_HOME m;
        return c.argc == 2 && c.whole(1, &m.joint) ? c.give(m) : c.need("joint");
    });
    add("emc_unhome", [](const Call &c) -> int {
        EMC_JOINT_UNHOME m;
        return c.argc == 2 && c.whole(1, &m.joint) ? c.give(m) : c.need("joint");
    });
    add("emc_jog_stop", [](const Call &c) -> int {
        EMC_JOG_STOP m;
        if (c.argc != 3 || !c.whole(1, &m.joint_or_axis) || !c.whole(2, &m.jjogmode))
            return c.need("joint or axis, and mode");
        return c.give(m);
    });
    add("emc_jog", [](const Call &c) -> int {
        EMC_JOG_CONT m;
        if (c.argc != 4 || !c.whole(1, &m.joint_or_axis) || !c.whole(2, &m.jjogmode) || !c.real(3, &m.vel))
            return c.need("joint or axis, mode and speed");
        m.vel /= 60;
        return c.give(m);
    });
    add("emc_jog_incr", [](const Call &c) -> int {
        EMC_JOG_INCR m;
        if (c.argc != 5 || !c.whole(1, &m.joint_or_axis) || !c.whole(2, &m.jjogmode) || !c.real(3, &m.vel) ||
            !c.real(4, &m.incr))
            return c.need("joint or axis, mode, speed and increment");
        m.vel /= 60;
        return c.give(m);
    });
    add("emc_feed_override", [](const Call &c) -> int {
        return percent(c, c.link.stat.motion.traj.scale, [](const Call &k, double v) {
            EMC_TRAJ_SET_SCALE m;
            m.scale = v;
            return k.give(m);
        });
    });
    add("emc_rapid_override", [](const Call &c) -> int {
        return percent(c, c.link.stat.motion.traj.rapid_scale, [](const Call &k, double v) {
            EMC_TRAJ_SET_RAPID_SCALE m;
            m.scale = v;
            return k.give(m);
        });
    });
    add("emc_spindle_override", [](const Call &c) -> int {
        EMC_TRAJ_SET_SPINDLE_SCALE m;
        double v;
        if (c.argc == 1)
            return c.result(static_cast<int>(std::floor(c.link.stat.motion.spindle[0].spindle_scale * 100 + 0.5)));
        if (c.argc == 3 && (!c.whole(1, &m.spindle) || m.spindle < 0 || m.spindle >= EMCMOT_MAX_SPINDLES))
            return c.fail("invalid spindle number");
        if (c.argc > 3 || !c.real(c.argc - 1, &v)) return c.need("[spindle] and a percentage");
        m.scale = v / 100;
        return c.give(m);
    });
    add("emc_task_plan_init", [](const Call &c) -> int { return c.plain<EMC_TASK_PLAN_INIT>(); });
    add("emc_open", [](const Call &c) -> int {
        if (c.argc != 2) return c.need("file");
        EMC_TASK_PLAN_OPEN m;
        if (!c.file_name(1, m.file)) return c.fail(LONG_NAME);
        return c.give(m);
    });
    add("emc_run", [](const Call &c) -> int {
        EMC_TASK_PLAN_RUN m;
        if (c.argc > 2 || (c.argc == 2 && !c.whole(1, &m.line))) return c.need("integer start line");
        c.link.start_line = m.line;
        return c.give(m);
    });
    add("emc_pause", [](const Call &c) -> int { return c.plain<EMC_TASK_PLAN_PAUSE>(); });
    add("emc_resume", [](const Call &c) -> int { return c.plain<EMC_TASK_PLAN_RESUME>(); });
    add("emc_step", [](const Call &c) -> int { return c.plain<EMC_TASK_PLAN_STEP>(); });
    add("emc_abort", [](const Call &c) -> int { return c.plain<EMC_TASK_ABORT>(); });
    add("emc_program", [](const Call &c) -> int {
        return c.result(std::string(c.link.stat.task.file[0] ? c.link.stat.task.file : "none"));
    });
    add("emc_program_line", [](const Call &c) -> int {
        const EMC_TASK_STAT &t = c.link.stat.task;
        if (c.link.start_line < 0 || t.readLine < c.link.start_line) return c.result(t.readLine);
        if (t.currentLine > 0)
            return c.result(t.motionLine > 0 && t.motionLine < t.currentLine ? t.motionLine : t.currentLine);
        return c.result(0);
    });
    add("emc_program_status", [](const Call &c) -> int {
        int i = c.link.stat.task.interpState;
        return c.result(std::string(i == EMC_TASK_INTERP_READING || i == EMC_TASK_INTERP_WAITING ? "running"
                                    : i == EMC_TASK_INTERP_PAUSED                                ? "paused"
                                                                                                 : "idle"));
    });
    add("emc_program_codes", [](const Call &c) -> int {
        std::string out;
        char buf[64];
        for (int i = 1; i < EMC_ACTIVE_G_CODES; i++) {
            int code = c.link.stat.task.activeGCodes[i];
            if (code == -1) continue;
            snprintf(buf, sizeof buf, code % 10 ? "G%.1f " : "G%.0f ", code / 10.0);
            out += buf;
        }
        for (int i = 1; i < EMC_ACTIVE_M_CODES; i++)
            if (int code = c.link.stat.task.activeMCodes[i]; code != -1) out += "M" + std::to_string(code) + " ";
        snprintf(buf, sizeof buf, "F%.0f S%.0f", c.link.stat.task.activeSettings[1],
                 c.link.stat.task.activeSettings[2]);
        return c.result(out + buf);
    });
    add("emc_program_linear_units",
        [](const Call &c) -> int { return c.result(program_name(c.link.stat.task.programUnits)); });
    add("emc_program_angular_units", [](const Call &c) -> int { return c.result(std::string("deg")); });
    add("emc_user_linear_units",
        [](const Call &c) -> int { return c.result(linear_name(c.link.stat.motion.traj.linearUnits)); });
    add("emc_user_angular_units",
        [](const Call &c) -> int { return c.result(angular_name(c.link.stat.motion.traj.angularUnits)); });
    add("emc_display_linear_units", [](const Call &c) -> int {
        return c.result(c.link.linear == "auto" ? "(" + program_name(c.link.stat.task.programUnits) + ")"
                                                : c.link.linear);
    });
    add("emc_display_angular_units", [](const Call &c) -> int {
        return c.result(c.link.angular == "auto" ? std::string("(deg)") : c.link.angular);
    });
    add("emc_linear_unit_conversion", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(c.link.linear);
        int i;
        if (c.word(1, {"inch", "mm", "cm", "auto", "custom"}, &i) != TCL_OK) return TCL_ERROR;
        c.link.linear = c.arg(1);
        return TCL_OK;
    });
    add("emc_angular_unit_conversion", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(c.link.angular);
        int i;
        if (c.word(1, {"deg", "rad", "grad", "auto", "custom"}, &i) != TCL_OK) return TCL_ERROR;
        c.link.angular = c.arg(1);
        return TCL_OK;
    });
    add("emc_task_heartbeat",
        [](const Call &c) -> int { return c.result(static_cast<int>(c.link.stat.task.taskbeat)); });
    add("emc_task_command",
        [](const Call &c) -> int { return c.result(static_cast<int>(c.link.stat.task.command_type)); });
    add("emc_task_command_number", [](const Call &c) -> int { return c.result(c.link.stat.task.echo_serial_number); });
    add("emc_task_command_status", [](const Call &c) -> int { return c.result(c.link.stat.task.status); });
    add("emc_io_command", [](const Call &c) -> int { return c.result(static_cast<int>(c.link.stat.io.command_type)); });
    add("emc_io_command_number", [](const Call &c) -> int { return c.result(c.link.stat.io.echo_serial_number); });
    add("emc_io_command_status", [](const Call &c) -> int { return c.result(c.link.stat.io.status); });
    add("emc_motion_command",
        [](const Call &c) -> int { return c.result(static_cast<int>(c.link.stat.motion.command_type)); });
    add("emc_motion_command_number",
        [](const Call &c) -> int { return c.result(c.link.stat.motion.echo_serial_number); });
    add("emc_motion_command_status", [](const Call &c) -> int { return c.result(c.link.stat.motion.status); });
    add("emc_teleop_enable", [](const Call &c) -> int {
        if (c.argc == 1) return c.result(c.link.stat.motion.traj.mode == EMC_TRAJ_MODE_TELEOP ? 1 : 0);
        EMC_TRAJ_SET_TELEOP_ENABLE m;
        if (c.argc != 2 || !c.whole(1, &m.enable)) return c.need("0 or 1");
        return c.give(m);
    });
    add("emc_kinematics_type", [](const Call &c) -> int { return c.result(c.link.stat.motion.traj.kinematics_type); });
    add("emc_probe_clear", [](const Call &c) -> int { return c.plain<EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG>(); });
    add("emc_probe_value", [](const Call &c) -> int { return c.result(c.link.stat.motion.traj.probeval); });
    add("emc_probe_tripped",
        [](const Call &c) -> int { return c.result(static_cast<int>(c.link.stat.motion.traj.probe_tripped)); });
    add("emc_probe_move", [](const Call &c) -> int {
        double x, y, z;
        if (c.argc != 4 || !c.real(1, &x) || !c.real(2, &y) || !c.real(3, &z)) return c.need("x, y and z");
        EMC_TASK_PLAN_EXECUTE m;
        snprintf(m.command, sizeof m.command, "g38.2 x%f y%f z%f", x, y, z);
        return c.give(m);
    });
    add("emc_probed_pos", [](const Call &c) -> int { return position(c, c.link.stat.motion.traj.probedPosition); });
    return table;
}

const std::vector<Command> &commands() {
    static const std::vector<Command> all = make_commands();
    return all;
}

int run_command(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[]) {
    Link &link = *static_cast<Link *>(data);
    if (!link.client) {
        Tcl_SetObjResult(interp, Tcl_NewStringObj("emc not connected", -1));
        return TCL_ERROR;
    }
    const char *name = Tcl_GetString(argv[0]);
    const char *tail = strrchr(name, ':');
    Call c{interp, argc, argv, link};
    ask(c);
    for (const Command &k : commands())
        if (strcmp(k.name, tail ? tail + 1 : name) == 0) return k.run(c);
    return TCL_ERROR;
}

int emc_init(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[]) {
    Link &link = *static_cast<Link *>(data);
    bool quick = false;
    for (int i = 1; i < argc; i++) {
        std::string a = Tcl_GetString(argv[i]);
        if (a == "-ini" && i + 1 < argc) link.ini_file = Tcl_GetString(argv[++i]);
        if (a == "-quick") quick = true;
    }
    linuxcnc::IniFile ini;
    std::string nml;
    if (ini.open(link.ini_file)) {
        nml = ini.findStringV("NML_FILE", "EMC", "");
        set_rcs_print(ini);
        link.linear = unit_setting(ini, "LINEAR_UNITS");
        link.angular = unit_setting(ini, "ANGULAR_UNITS");
    }
    Tcl_Obj *load[] = {Tcl_NewStringObj("emc_ini_load", -1),
                       Tcl_NewStringObj(link.ini_file.c_str(), -1)}; // emc_ini reads it too; sets EMC_INIFILE
    for (Tcl_Obj *o : load) Tcl_IncrRefCount(o);
    Tcl_EvalObjv(interp, 2, load, TCL_EVAL_GLOBAL);
    for (Tcl_Obj *o : load) Tcl_DecrRefCount(o);
    Tcl_ResetResult(interp);
    verbose_nml_error_messages = 0;
    std::unique_ptr<EmcClient> client;
    std::unique_ptr<NML> errors;
    for (int waited = 0;; waited++) {
        client = std::make_unique<EmcClient>(nml);
        errors = std::make_unique<NML>(emc_messages(), "emcError", "xemc", nml.empty() ? nullptr : nml.c_str());
        if (client->valid() && errors->valid()) break;
        if (quick || waited >= 10) {
            Tcl_SetObjResult(interp, Tcl_NewStringObj("no emc connection", -1));
            return TCL_ERROR;
        }
        kerf_clock_sleep_ns(1'000'000'000);
    }
    link.client = std::move(client);
    link.errors = std::move(errors);
    link.refresh();
    return TCL_OK;
}

// int V: without its fraction; round V: nearest whole number.
int truncate(ClientData, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[]) {
    double v;
    if (argc != 2 || Tcl_GetDoubleFromObj(interp, argv[1], &v) != TCL_OK) {
        Tcl_SetObjResult(interp, Tcl_NewStringObj("int: need value", -1));
        return TCL_ERROR;
    }
    Tcl_SetObjResult(interp, Tcl_NewIntObj(static_cast<int>(v)));
    return TCL_OK;
}

int nearest(ClientData, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[]) {
    double v;
    if (argc != 2 || Tcl_GetDoubleFromObj(interp, argv[1], &v) != TCL_OK) {
        Tcl_SetObjResult(interp, Tcl_NewStringObj("round: need value", -1));
        return TCL_ERROR;
    }
    Tcl_SetObjResult(interp, Tcl_NewIntObj(static_cast<int>(v < 0 ? v - 0.5 : v + 0.5)));
    return TCL_OK;
}

// emc_pendant PORT: one packet of a mouse: left and right button, way in x and y, status byte.
int pendant(ClientData, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[]) {
    std::string port = argc == 2 ? Tcl_GetString(argv[1]) : "";
    bool serial = port == "/dev/ttyS0" || port == "/dev/ttyS1";
    if (!serial && port != "/dev/psaux") {
        Tcl_SetObjResult(interp, Tcl_NewStringObj("Need /dev/psaux, /dev/ttyS0 or /dev/ttyS1 as Arg", -1));
        return TCL_ERROR;
    }
    int fd = open(port.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), status = 0, x = 0, y = 0, left = 0,
        right = 0;
    unsigned char packet[3];
    size_t n = 0;
    while (fd >= 0 && n < sizeof packet) {
        pollfd f{fd, POLLIN, 0};
        unsigned char b;
        if (poll(&f, 1, 100) <= 0 || read(fd, &b, 1) != 1) break;
        if (serial && (b & 0x40)) n = 0; // the first byte of a Microsoft mouse's packet
        packet[n++] = b;
    }
    if (fd >= 0) close(fd);
    if (n == sizeof packet) {
        status = packet[0];
        left = status >> (serial ? 5 : 0) & 1;
        right = status >> (serial ? 4 : 1) & 1;
        x = static_cast<signed char>(serial ? (status & 3) << 6 | (packet[1] & 63) : packet[1]);
        y = static_cast<signed char>(serial ? (status & 12) << 4 | (packet[2] & 63) : packet[2]);
    }
    Tcl_SetObjResult(interp, Tcl_ObjPrintf("%d %d %d %d %d", left, right, x, y, status));
    return TCL_OK;
}

// multihead: {x y width height} of the screen Tk draws on; nothing without Tk.
int multihead(ClientData, Tcl_Interp *interp, int, Tcl_Obj *const[]) {
    if (!Tcl_PkgPresent(interp, "Tk", nullptr, 0)) {
        Tcl_ResetResult(interp);
        return TCL_OK;
    }
    return Tcl_Eval(interp,
                    "list [list [winfo vrootx .] [winfo vrooty .] [winfo screenwidth .] [winfo screenheight .]]");
}

void destroy(ClientData data, Tcl_Interp *) { delete static_cast<Link *>(data); }

} // namespace

int emc_tcl_init(Tcl_Interp *interp) {
    Link *link = new Link;
    for (const Command &c : commands()) Tcl_CreateObjCommand(interp, c.name, run_command, link, nullptr);
    Tcl_CreateObjCommand(interp, "emc_init", emc_init, link, nullptr);
    Tcl_CreateObjCommand(interp, "emc_pendant", pendant, nullptr, nullptr);
    Tcl_CreateObjCommand(interp, "multihead", multihead, nullptr, nullptr);
    Tcl_CreateObjCommand(interp, "int", truncate, nullptr, nullptr);
    Tcl_CreateObjCommand(interp, "round", nearest, nullptr, nullptr);
    Tcl_CallWhenDeleted(interp, destroy, link);
    return TCL_OK;
}
