// SPDX-License-Identifier: GPL-2.0-or-later
//
// subcommands.cc - linuxcncrsh: what can be got and set. Source: rsh sheet, B.5 and B.6.
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <unordered_map>

#include "kerf_clock.h"
#include "arguments.hh"
#include "session.hh"
#include "task_text.hh"

namespace rsh {
namespace {

// ---- replies ----

bool say(Session &s, const std::string &line) {
    s.reply(line);
    return true;
}

bool say_on_off(Session &s, const char *name, bool v) { return say(s, std::string(name) + (v ? " ON" : " OFF")); }

using Nine = double[9];

void to_nine(const EmcPose &p, Nine &v) {
    v[0] = p.tran.x;
    v[1] = p.tran.y;
    v[2] = p.tran.z;
    v[3] = p.a;
    v[4] = p.b;
    v[5] = p.c;
    v[6] = p.u;
    v[7] = p.v;
    v[8] = p.w;
}

bool say_nine(Session &s, Server &v, const char *name, const Nine &p, const Words &args) {
    if (args.empty()) {
        std::string out = name;
        for (double d : p) out += text(" %f", d);
        return say(s, out);
    }
    int a;
    if (!need_axis(s, args[0], &a)) return false;
    if (!(v.stat.motion.traj.axis_mask & (1 << a))) s.warning(text("Axis '%c', not configured", AXES[a]));
    return say(s, text("%s %c %f", name, AXES[a], p[a]));
}

EmcPose minus(const EmcPose &a, const EmcPose &b) {
    EmcPose r = a;
    r.tran.x -= b.tran.x;
    r.tran.y -= b.tran.y;
    r.tran.z -= b.tran.z;
    r.a -= b.a;
    r.b -= b.b;
    r.c -= b.c;
    r.u -= b.u;
    r.v -= b.v;
    r.w -= b.w;
    return r;
}

template <class F>
bool say_joints(Session &s, Server &v, const char *name, const char *single, const Words &args, F value) {
    int j = -1;
    if (!args.empty() && !need_joint(s, v, args[0], -1, &j)) return false;
    if (j >= 0) {
        return say(s, std::string(single) + " " + std::to_string(j) + " " + value(v.stat.motion.joint[j]));
    }
    std::string out = name;
    for (int n = 0; n < v.joints(); n++) out += " " + value(v.stat.motion.joint[n]);
    return say(s, out);
}

bool near(double a, double b) { return std::fabs(a - b) < 1e-3; }
std::string linear_name(double units) {
    return near(units, 1) ? "MM" : near(units, 1 / 25.4) ? "INCH" : near(units, 0.1) ? "CM" : "CUSTOM";
}
std::string angular_name(double units) {
    return near(units, 1)                                ? "DEG"
           : near(units, 0.9) || near(units, 100.0 / 90) ? "GRAD"
           : near(units, M_PI / 180)                     ? "RAD"
                                                         : "CUSTOM";
}
std::string program_units(const EMC_STAT &t) {
    switch (t.task.programUnits) {
    case 1: return "INCH";
    case 2: return "MM";
    case 3: return "CM";
    default: return "CUSTOM";
    }
}

// ---- sending ----

Result give(Server &v, RCS_CMD_MSG &m) { return v.client->send(m) ? Result::sent : Result::failed; }
template <class M> Result plain(Server &v) {
    M m;
    return give(v, m);
}

// Sends, waits until task has read it, then up to 25 heartbeats for what it brings about.
template <class M, class F> bool give_and_see(Server &v, M &m, F seen) {
    if (!v.client->send(m) || !v.client->wait_received(1.0, 0.001)) return false;
    for (int n = 0; n < 25; n++) {
        v.refresh();
        if (seen()) return true;
        v.sleep_heartbeats(1);
    }
    v.refresh();
    return seen();
}

bool busy(Server &v) {
    for (auto &s : v.sessions)
        if (s.second->holds_others_up()) return true;
    return false;
}

Result set_state(Session &s, Server &v, const Words &a, const char *name, int on_state, int off_state,
                 bool on_may_interrupt) {
    bool on;
    if (!need_on_off(s, a[0], &on)) return Result::failed;
    std::string what = std::string("SET ") + name + (on ? " ON" : " OFF");
    if (on != on_may_interrupt && busy(v)) {
        s.error("Cannot issue '" + what + "' while another command is being processed");
        return Result::failed;
    }
    EMC_TASK_SET_STATE m;
    m.state = on ? on_state : off_state;
    bool estop = strcmp(name, "ESTOP") == 0;
    bool good = give_and_see(v, m, [&] {
        bool now = estop ? v.stat.task.state == EMC_TASK_STATE_ESTOP : v.stat.task.state == EMC_TASK_STATE_ON;
        return now == on;
    });
    if (!good) {
        s.error("Waiting for '" + what + "' failed");
        return Result::failed;
    }
    return Result::done;
}

std::string find_file(Server &v, const std::string &name) {
    if (name[0] == '/') return access(name.c_str(), R_OK) == 0 ? name : "";
    for (const std::string &dir : linuxcnc::IniFile::split(":", v.options.path)) {
        std::string full = dir + "/" + name;
        if (access(full.c_str(), R_OK) == 0) return full;
    }
    return access(name.c_str(), R_OK) == 0 ? name : "";
}

// found: its name in the search path; full: the same for task, which works in another folder.
bool need_file(Session &s, Server &v, const std::string &name, std::string *found, std::string *full) {
    if (name.empty()) {
        s.error("Empty filename");
        return false;
    }
    *found = find_file(v, name);
    if (found->empty()) {
        s.error("File '" + name + "' not found");
        return false;
    }
    *full = std::filesystem::absolute(*found).lexically_normal();
    if (full->size() >= LINELEN) {
        s.error("Filename too long, 254 characters at most");
        return false;
    }
    return true;
}

// Joint number or axis letter of the jog commands; the mode must fit.
bool jog_target(Session &s, Server &v, const std::string &w, int *nr, int *jjogmode) {
    bool teleop = v.stat.motion.traj.mode == EMC_TRAJ_MODE_TELEOP;
    if (isdigit(static_cast<unsigned char>(w[0])) || w[0] == '-') {
        if (!need_whole(s, w, nr)) return false;
        if (*nr < 0 || *nr >= v.joints()) {
            s.error(text("Invalid joint '%d', valid range [0,%d]", *nr, v.joints() - 1));
            return false;
        }
        *jjogmode = 1;
        return !teleop;
    }
    if (!need_axis(s, w, nr)) return false;
    if (!(v.stat.motion.traj.axis_mask & (1 << *nr))) {
        s.error(text("Invalid axis '%c', not configured", AXES[*nr]));
        return false;
    }
    *jjogmode = 0;
    return teleop;
}

// A jog belongs to the connection that began it last; steps and stops belong to nobody.
void jog_is_of(Session *owner, Server &v, int nr, int jjogmode) {
    for (auto &s : v.sessions) s.second->jogs.erase({nr, jjogmode});
    if (owner) owner->jogs.emplace(nr, jjogmode);
}

template <class F> Result for_spindles(Session &s, Server &v, const Words &a, size_t at, F f) {
    int n = 0;
    if (a.size() > at && !need_spindle(s, v, a[at], &n)) return Result::failed;
    if (v.spindles() <= 0) {
        s.error("no spindles configured");
        return Result::failed;
    }
    Result r = Result::failed;
    for (int i = n < 0 ? 0 : n; i < (n < 0 ? v.spindles() : n + 1); i++) r = f(i);
    return r;
}

template <class F> bool say_spindles(Session &s, Server &v, const Words &a, int dflt, F line) {
    int n = dflt;
    if (!a.empty() && !need_spindle(s, v, a[0], &n)) return false;
    for (int i = n < 0 ? 0 : n; i < (n < 0 ? v.spindles() : n + 1); i++) s.reply(line(i));
    return true;
}

bool say_message(Session &s, Server &v, const char *name, std::deque<std::string> &queue) {
    v.read_messages();
    if (queue.empty()) s.reply(std::string(name) + " OK");
    else {
        s.reply(std::string(name) + " " + queue.front());
        queue.pop_front();
    }
    return true;
}

constexpr int HOMING_GAP = 25; // heartbeats

Result wait_homed(Session &s, Server &v, const Words &a) {
    int j;
    double timeout = 10;
    if (!need_joint(s, v, a[0], -1, &j)) return Result::failed;
    if (a.size() > 1 && !need_real(s, a[1], &timeout)) return Result::failed;
    if (timeout < 0 || timeout > 300) {
        s.error("Invalid timeout '" + a[1] + "', valid range [0.0,300.0]");
        return Result::failed;
    }
    if (timeout > 30)
        s.warning(
            "Timeout above 30 seconds. The remote shell and all other remote connections may stall for this period.");
    const int64_t until = kerf_clock_now_ns() + static_cast<int64_t>(timeout * 1e9);
    s.watch([&s, &v, j, timeout, until, idle = 0]() mutable {
        bool done = true, all = true;
        for (int n = j < 0 ? 0 : j; n < (j < 0 ? v.joints() : j + 1); n++) {
            const EMC_JOINT_STAT &joint = v.stat.motion.joint[n];
            if (joint.homed) continue;
            if (j >= 0 && !joint.homing) {
                s.error(text("Joint '%d' is not homed and not in the process of homing.", j));
                return Result::failed;
            }
            all = false;
            if (joint.homing) done = false;
        }
        idle = done ? idle + 1 : 0;
        if (all || idle > HOMING_GAP) return Result::done; // between two steps of a sequence nothing homes
        if (kerf_clock_now_ns() <= until) return Result::watches;
        s.error(j < 0 ? text("One or more joints are still not homed after %.1f seconds", timeout)
                      : text("Joint '%d' still not homed after %.1f seconds", j, timeout));
        return Result::failed;
    });
    return Result::watches;
}

Result home(Session &s, Server &v, const Words &a, const std::string &) {
    EMC_JOINT_HOME m;
    if (!need_joint(s, v, a[0], -1, &m.joint)) return Result::failed;
    if (m.joint < 0) return give(v, m);
    int j = m.joint;
    if (!give_and_see(v, m, [&] { return v.stat.motion.joint[j].homing || v.stat.motion.joint[j].homed; })) {
        s.error(text("Joint '%d' did not start homing", j));
        return Result::failed;
    }
    return Result::sent;
}

int shown_line(const Server &v) {
    const EMC_TASK_STAT &t = v.stat.task;
    if (v.start_line < 0 || t.readLine < v.start_line) return t.readLine;
    if (t.currentLine > 0) return t.motionLine > 0 && t.motionLine < t.currentLine ? t.motionLine : t.currentLine;
    return 0;
}

std::string codes(const EMC_STAT &st) {
    std::string out;
    for (int i = 1; i < EMC_ACTIVE_G_CODES; i++) {
        int c = st.task.activeGCodes[i];
        if (c == -1) continue;
        out += c % 10 ? text("G%.1f ", c / 10.0) : text("G%d ", c / 10);
    }
    return out + text("F%.0f S%.0f", st.task.activeSettings[1], st.task.activeSettings[2]);
}

template <class ON, class OFF> Result switch_on_off(Session &s, Server &v, const Words &a) {
    bool on;
    if (!need_on_off(s, a[0], &on)) return Result::failed;
    return on ? plain<ON>(v) : plain<OFF>(v);
}

using S = Session &;
using V = Server &;
using A = const Words &;
using R = const std::string &; // the rest of the line as it came

using Table = std::vector<Subcommand>;

// what concerns the connection
void link_subcommands(Table &table) {
    table.push_back({"ECHO", Level::none, false, 0, 1, "{on|off}",
                     [](S s, V, A) { return say_on_off(s, "ECHO", s.echo); },
                     [](S s, V, A a, R) { return need_on_off(s, a[0], &s.echo) ? Result::done : Result::failed; }});
    table.push_back({"TIMESTAMP", Level::none, false, 0, 1, "{on|off} [on|off]",
                     [](S s, V, A) {
                         return say(s, std::string("TIMESTAMP ") + (s.timestamp ? "ON " : "OFF ") +
                                           (s.timestamp_epoch ? "ON" : "OFF"));
                     },
                     [](S s, V, A a, R) {
                         bool on, epoch = false;
                         if (!need_on_off(s, a[0], &on) || (a.size() > 1 && !need_on_off(s, a[1], &epoch)))
                             return Result::failed;
                         s.timestamp = on;
                         s.timestamp_epoch = epoch;
                         return Result::done;
                     }});
    table.push_back({"CHALLENGE", Level::none, false, 0, 0, "",
                     [](S s, V, A) { return say(s, "CHALLENGE " + s.new_challenge()); }, nullptr});
    table.push_back({"CLIENTS", Level::hello, false, 0, 0, "",
                     [](S s, V v, A) {
                         for (auto &c : v.sessions)
                             s.reply(text("CLIENTS %d '%s'%s%s", c.first, c.second->client.c_str(),
                                          c.second->linked ? " LINKED" : "", c.second->enabled ? " ENABLED" : ""));
                         return true;
                     },
                     nullptr});
    table.push_back({"COMM_PROT", Level::hello, false, 0, 0, "",
                     [](S s, V, A) {
                         s.warning("GET COMM_PROT has been deprecated. It has no function.");
                         return say(s, "COMM_PROT " + s.version);
                     },
                     nullptr});
    table.push_back({"DISABLE", Level::hello, false, 0, 0, "[connection]", nullptr, [](S s, V v, A a, R) {
                         if (a.empty()) {
                             s.disable();
                             s.reply("DISABLE SELF");
                             return Result::done;
                         }
                         int fd;
                         if (!need_whole(s, a[0], &fd)) return Result::failed;
                         auto it = v.sessions.find(fd);
                         if (it == v.sessions.end()) {
                             s.error("Client '" + a[0] + "' not available");
                             return Result::failed;
                         }
                         if (!it->second->enabled) {
                             s.error("Client '" + a[0] + "' is not enabled");
                             return Result::failed;
                         }
                         it->second->disable();
                         s.reply("DISABLE " + a[0] + " " + it->second->client);
                         return Result::done;
                     }});
    table.push_back({"ENABLE", Level::hello, false, 0, 1, "{password|off}",
                     [](S s, V, A) { return say_on_off(s, "ENABLE", s.enabled); },
                     [](S s, V v, A a, R) {
                         if (upper(a[0]) == "OFF") {
                             if (!s.enabled) {
                                 s.error("Trying to set enable to off on a non-enabled link");
                                 return Result::failed;
                             }
                             s.disable();
                             return Result::done;
                         }
                         if (!s.password_is(a[0], v.options.enable_password)) return Result::failed;
                         s.enabled = true;
                         return Result::done;
                     }});
    table.push_back({"INI", Level::hello, false, 2, 0, "variable section",
                     [](S s, V v, A a) {
                         auto value = v.ini.findString(a[0], a[1]);
                         if (!value) {
                             s.error("INI file entry '[" + a[1] + "]" + a[0] + "' not found");
                             return false;
                         }
                         return say(s, "INI [" + a[1] + "]" + a[0] + "=" + *value);
                     },
                     [](S, V, A, R) { return Result::done; }});
    table.push_back({"INIFILE", Level::hello, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, "INIFILE " + v.options.ini_file); },
                     [](S, V, A, R) { return Result::done; }});
    table.push_back({"PLAT", Level::hello, false, 0, 0, "", [](S s, V, A) { return say(s, "PLAT Linux"); }, nullptr});
    table.push_back({"TIME", Level::hello, false, 0, 0, "",
                     [](S s, V, A) {
                         timeval tv;
                         gettimeofday(&tv, nullptr);
                         return say(
                             s, text("TIME %ld.%06ld", static_cast<long>(tv.tv_sec), static_cast<long>(tv.tv_usec)));
                     },
                     nullptr});
    table.push_back({"VERBOSE", Level::hello, false, 0, 1, "{on|off}",
                     [](S s, V, A) { return say_on_off(s, "VERBOSE", s.verbose); },
                     [](S s, V, A a, R) { return need_on_off(s, a[0], &s.verbose) ? Result::done : Result::failed; }});
}

// what needs an enabled connection
void state_subcommands(Table &table) {
    table.push_back({"DEBUG", Level::enable, true, 0, 1, "mask",
                     [](S s, V v, A) { return say(s, text("DEBUG 0x%08x", static_cast<unsigned>(v.stat.debug))); },
                     [](S s, V v, A a, R) {
                         int mask;
                         if (!need_whole(s, a[0], &mask)) return Result::failed;
                         EMC_SET_DEBUG m;
                         m.debug = static_cast<unsigned>(mask);
                         return give(v, m);
                     }});
    table.push_back({"ERROR", Level::enable, false, 0, 0, "",
                     [](S s, V v, A) { return say_message(s, v, "ERROR", v.error_text); }, nullptr});
    table.push_back({"OPERATOR_TEXT", Level::enable, false, 0, 0, "",
                     [](S s, V v, A) { return say_message(s, v, "OPERATOR_TEXT", v.operator_text); }, nullptr});
    table.push_back({"OPERATOR_DISPLAY", Level::enable, false, 0, 0, "",
                     [](S s, V v, A) { return say_message(s, v, "OPERATOR_DISPLAY", v.operator_display); }, nullptr});
    table.push_back({"ESTOP", Level::enable, false, 0, 1, "{on|off}",
                     [](S s, V v, A) { return say_on_off(s, "ESTOP", v.stat.task.state == EMC_TASK_STATE_ESTOP); },
                     [](S s, V v, A a, R) {
                         return set_state(s, v, a, "ESTOP", EMC_TASK_STATE_ESTOP, EMC_TASK_STATE_ESTOP_RESET, true);
                     }});
    table.push_back(
        {"MACHINE", Level::enable, false, 0, 1, "{on|off}",
         [](S s, V v, A) { return say_on_off(s, "MACHINE", v.stat.task.state == EMC_TASK_STATE_ON); },
         [](S s, V v, A a, R) { return set_state(s, v, a, "MACHINE", EMC_TASK_STATE_ON, EMC_TASK_STATE_OFF, false); }});
    table.push_back({"TIMEOUT", Level::enable, false, 0, 1, "seconds",
                     [](S s, V, A) { return say(s, text("TIMEOUT %f", s.timeout_s)); },
                     [](S s, V, A a, R) {
                         double t;
                         if (!need_real(s, a[0], &t) || t < 0) return Result::failed;
                         s.timeout_s = t;
                         return Result::done;
                     }});
    table.push_back({"UPDATE", Level::enable, false, 0, 1, "{none|auto}",
                     [](S s, V v, A) { return say(s, "UPDATE " + v.update_mode); },
                     [](S s, V v, A a, R) {
                         int i;
                         if (!need_word(s, a[0], {"none", "auto"}, &i)) return Result::failed;
                         v.update_mode = i ? "AUTO" : "NONE";
                         return Result::done;
                     }});
    table.push_back({"UPDATE_STATUS", Level::enable, false, 0, 0, "", nullptr, [](S, V v, A, R) {
                         v.refresh();
                         return Result::done;
                     }});
    table.push_back({"WAIT", Level::enable, false, 0, 1, "{received|done|none}", [](S, V, A) { return true; },
                     [](S s, V, A a, R) {
                         int i;
                         if (!need_word(s, a[0], {"received", "done", "none"}, &i)) return Result::failed;
                         if (i == 2) return Result::done;
                         s.wait_for(i == 1);
                         return Result::waits;
                     }});
    table.push_back(
        {"WAIT_MODE", Level::enable, false, 0, 1, "{received|done}",
         [](S s, V, A) { return say(s, std::string("WAIT_MODE ") + (s.wait_done ? "DONE" : "RECEIVED")); },
         [](S s, V, A a, R) {
             if (upper(a[0]) == "NONE") {
                 s.error("Setting 'SET WAIT_MODE' to 'NONE' has been removed as it may cause commands to be lost.");
                 return Result::failed;
             }
             int i;
             if (!need_word(s, a[0], {"received", "done"}, &i)) return Result::failed;
             s.wait_done = i == 1;
             return Result::done;
         }});
}

// what needs the machine on
void machine_subcommands(Table &table) {
    table.push_back({"ABORT", Level::on, false, 0, 0, "", nullptr, [](S, V v, A, R) {
                         EMC_TASK_ABORT m;
                         return v.client->send(m) ? Result::done : Result::failed;
                     }});
    table.push_back({"ABS_ACT_POS", Level::on, false, 0, 0, "[axis]",
                     [](S s, V v, A a) {
                         Nine p;
                         to_nine(v.stat.motion.traj.actualPosition, p);
                         return say_nine(s, v, "ABS_ACT_POS", p, a);
                     },
                     nullptr});
    table.push_back({"ABS_CMD_POS", Level::on, false, 0, 0, "[axis]",
                     [](S s, V v, A a) {
                         Nine p;
                         to_nine(v.stat.motion.traj.position, p);
                         return say_nine(s, v, "ABS_CMD_POS", p, a);
                     },
                     nullptr});
    table.push_back({"ANGULAR_UNIT_CONVERSION", Level::on, false, 0, 1, "{deg|rad|grad|auto|custom}",
                     [](S s, V v, A) { return say(s, "ANGULAR_UNIT_CONVERSION " + v.angular_conversion); },
                     [](S s, V v, A a, R) {
                         int i;
                         if (!need_word(s, a[0], {"deg", "rad", "grad", "auto", "custom"}, &i)) return Result::failed;
                         v.angular_conversion = upper(a[0]);
                         return Result::done;
                     }});
    table.push_back({"AXIS_VELOCITY", Level::on, false, 0, 0, "[axis]",
                     [](S s, V v, A a) {
                         Nine p;
                         for (int i = 0; i < 9; i++) p[i] = v.stat.motion.axis[i].velocity;
                         return say_nine(s, v, "AXIS_VELOCITY", p, a);
                     },
                     nullptr});
    table.push_back({"BRAKE", Level::on, true, 0, 1, "{on|off} [spindle]",
                     [](S s, V v, A a) {
                         return say_spindles(s, v, a, 0, [&](int n) {
                             return text("BRAKE %d %s", n, v.stat.motion.spindle[n].brake ? "ON" : "OFF");
                         });
                     },
                     [](S s, V v, A a, R) {
                         bool on;
                         if (!need_on_off(s, a[0], &on)) return Result::failed;
                         return for_spindles(s, v, a, 1, [&](int n) {
                             if (on) {
                                 EMC_SPINDLE_BRAKE_ENGAGE m;
                                 m.spindle = n;
                                 return give(v, m);
                             }
                             EMC_SPINDLE_BRAKE_RELEASE m;
                             m.spindle = n;
                             return give(v, m);
                         });
                     }});
    table.push_back({"DISPLAY_ANGULAR_UNITS", Level::on, false, 0, 0, "",
                     [](S s, V v, A) {
                         return say(s, "DISPLAY_ANGULAR_UNITS " +
                                           (v.angular_conversion == "AUTO" ? "DEG" : v.angular_conversion));
                     },
                     nullptr});
    table.push_back({"DISPLAY_LINEAR_UNITS", Level::on, false, 0, 0, "",
                     [](S s, V v, A) {
                         return say(s, "DISPLAY_LINEAR_UNITS " + (v.linear_conversion == "AUTO" ? program_units(v.stat)
                                                                                                : v.linear_conversion));
                     },
                     nullptr});
    table.push_back({"FEED_OVERRIDE", Level::on, true, 0, 1, "percent",
                     [](S s, V v, A) { return say(s, text("FEED_OVERRIDE %f", v.stat.motion.traj.scale * 100)); },
                     [](S s, V v, A a, R) {
                         double p;
                         if (!need_real(s, a[0], &p)) return Result::failed;
                         EMC_TRAJ_SET_SCALE m;
                         m.scale = p / 100;
                         return give(v, m);
                     }});
    table.push_back(
        {"FLOOD", Level::on, true, 0, 1, "{on|off}",
         [](S s, V v, A) { return say_on_off(s, "FLOOD", v.stat.io.coolant.flood); },
         [](S s, V v, A a, R) { return switch_on_off<EMC_COOLANT_FLOOD_ON, EMC_COOLANT_FLOOD_OFF>(s, v, a); }});
    table.push_back(
        {"MIST", Level::on, true, 0, 1, "{on|off}",
         [](S s, V v, A) { return say_on_off(s, "MIST", v.stat.io.coolant.mist); },
         [](S s, V v, A a, R) { return switch_on_off<EMC_COOLANT_MIST_ON, EMC_COOLANT_MIST_OFF>(s, v, a); }});
    table.push_back({"HOME", Level::on, true, 0, 1, "joint", nullptr, home});
    table.push_back({"JOINT_HOME", Level::on, true, 0, 1, "joint", nullptr, home});
    table.push_back({"JOG", Level::on, true, 0, 2, "joint|axis speed", nullptr, [](S s, V v, A a, R) {
                         EMC_JOG_CONT m;
                         double speed;
                         if (!jog_target(s, v, a[0], &m.joint_or_axis, &m.jjogmode) || !real(a[1], &speed))
                             return Result::failed;
                         m.vel = speed / 60;
                         jog_is_of(&s, v, m.joint_or_axis, m.jjogmode);
                         return give(v, m);
                     }});
    table.push_back({"JOG_INCR", Level::on, true, 0, 3, "joint|axis speed increment", nullptr, [](S s, V v, A a, R) {
                         EMC_JOG_INCR m;
                         double speed;
                         if (!jog_target(s, v, a[0], &m.joint_or_axis, &m.jjogmode) || !real(a[1], &speed) ||
                             !real(a[2], &m.incr))
                             return Result::failed;
                         m.vel = speed / 60;
                         jog_is_of(nullptr, v, m.joint_or_axis, m.jjogmode);
                         return give(v, m);
                     }});
    table.push_back({"JOG_STOP", Level::on, true, 0, 1, "joint|axis", nullptr, [](S s, V v, A a, R) {
                         EMC_JOG_STOP m;
                         if (!jog_target(s, v, a[0], &m.joint_or_axis, &m.jjogmode)) return Result::failed;
                         jog_is_of(nullptr, v, m.joint_or_axis, m.jjogmode);
                         return give(v, m);
                     }});
    table.push_back({"JOINT_FAULT", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_FAULT", "JOINT_FAULT", a, [](const EMC_JOINT_STAT &j) {
                             return std::string(j.fault ? "FAULT" : "OK");
                         });
                     },
                     nullptr});
    table.push_back({"JOINT_HOMED", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_HOMED", "JOINT_HOMED", a,
                                           [](const EMC_JOINT_STAT &j) { return std::string(j.homed ? "YES" : "NO"); });
                     },
                     nullptr});
    table.push_back({"JOINT_LIMIT", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_LIMIT", "JOINT_LIMIT", a, [](const EMC_JOINT_STAT &j) {
                             return std::string(j.minHardLimit   ? "MINHARD"
                                                : j.minSoftLimit ? "MINSOFT"
                                                : j.maxSoftLimit ? "MAXSOFT"
                                                : j.maxHardLimit ? "MAXHARD"
                                                                 : "OK");
                         });
                     },
                     nullptr});
    table.push_back({"JOINT_POS", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_POS", "JOINT_POS", a,
                                           [](const EMC_JOINT_STAT &j) { return text("%f", j.input); });
                     },
                     nullptr});
    table.push_back({"JOINT_TYPE", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_TYPE", "JOINT_TYPE", a, [](const EMC_JOINT_STAT &j) {
                             return std::string(j.jointType == EMC_LINEAR    ? "LINEAR"
                                                : j.jointType == EMC_ANGULAR ? "ANGULAR"
                                                                             : "CUSTOM");
                         });
                     },
                     nullptr});
    table.push_back({"JOINT_UNHOME", Level::on, true, 0, 1, "joint", nullptr, [](S s, V v, A a, R) {
                         EMC_JOINT_UNHOME m;
                         if (!need_joint(s, v, a[0], -2, &m.joint)) return Result::failed;
                         return give(v, m);
                     }});
    table.push_back({"JOINT_UNITS", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_UNITS", "JOIN_UNITS", a, [](const EMC_JOINT_STAT &j) {
                             return j.jointType == EMC_ANGULAR ? angular_name(j.units) : linear_name(j.units);
                         });
                     },
                     nullptr});
    table.push_back({"JOINT_VELOCITY", Level::on, false, 0, 0, "[joint]",
                     [](S s, V v, A a) {
                         return say_joints(s, v, "JOINT_VELOCITY", "JOINT_VELOCITY", a,
                                           [](const EMC_JOINT_STAT &j) { return text("%f", j.velocity); });
                     },
                     nullptr});
    table.push_back({"JOINT_WAIT_HOMED", Level::on, false, 0, 1, "joint [timeout]", nullptr,
                     [](S s, V v, A a, R) { return wait_homed(s, v, a); }});
    table.push_back({"KINEMATICS_TYPE", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, text("KINEMATICS_TYPE %d", v.stat.motion.traj.kinematics_type)); },
                     nullptr});
    table.push_back({"LINEAR_UNIT_CONVERSION", Level::on, false, 0, 1, "{inch|mm|cm|auto|custom}",
                     [](S s, V v, A) { return say(s, "LINEAR_UNIT_CONVERSION " + v.linear_conversion); },
                     [](S s, V v, A a, R) {
                         int i;
                         if (!need_word(s, a[0], {"inch", "mm", "cm", "auto", "custom"}, &i)) return Result::failed;
                         v.linear_conversion = upper(a[0]);
                         return Result::done;
                     }});
    table.push_back({"LOAD_TOOL_TABLE", Level::on, true, 0, 1, "file", nullptr, [](S s, V v, A, R rest) {
                         std::string found, full;
                         if (!need_file(s, v, rest, &found, &full)) return Result::failed;
                         EMC_TOOL_LOAD_TOOL_TABLE m;
                         copy_text(m.file, full.c_str());
                         return give(v, m);
                     }});
    table.push_back({"MDI", Level::on, true, 0, 1, "text", nullptr, [](S s, V v, A, R rest) {
                         EMC_TASK_PLAN_EXECUTE m;
                         if (rest.size() >= sizeof m.command) {
                             s.error("MDI commands limited to 254 characters");
                             return Result::failed;
                         }
                         copy_text(m.command, rest.c_str());
                         return give(v, m);
                     }});
    table.push_back({"MODE", Level::on, true, 0, 1, "{manual|auto|mdi}",
                     [](S s, V v, A) {
                         int m = v.stat.task.mode;
                         s.reply(std::string("MODE ") + (m == EMC_TASK_MODE_AUTO  ? "AUTO"
                                                         : m == EMC_TASK_MODE_MDI ? "MDI"
                                                                                  : "MANUAL"));
                         return true;
                     },
                     [](S s, V v, A a, R) {
                         EMC_TASK_SET_MODE m;
                         int i;
                         if (!need_word(s, a[0], {"manual", "auto", "mdi"}, &i)) return Result::failed;
                         m.mode = i + 1;
                         return give(v, m);
                     }});
    table.push_back({"OPEN", Level::on, true, 0, 1, "file",
                     [](S s, V, A) { return say(s, "OPEN " + (s.opened.empty() ? std::string("NONE") : s.opened)); },
                     [](S s, V v, A, R rest) {
                         std::string found, full;
                         if (!need_file(s, v, rest, &found, &full)) return Result::failed;
                         EMC_TASK_PLAN_OPEN m;
                         copy_text(m.file, full.c_str());
                         s.opened = found;
                         return give(v, m);
                     }});
    table.push_back({"OPTIONAL_STOP", Level::on, true, 0, 1, "{on|off}",
                     [](S s, V v, A) { return say_on_off(s, "OPTIONAL_STOP", v.stat.task.optional_stop_state); },
                     [](S s, V v, A a, R) {
                         EMC_TASK_PLAN_SET_OPTIONAL_STOP m;
                         if (!need_on_off(s, a[0], &m.state)) return Result::failed;
                         return give(v, m);
                     }});
    table.push_back(
        {"OVERRIDE_LIMITS", Level::on, true, 0, 1, "{on|off}",
         [](S s, V v, A) { return say_on_off(s, "OVERRIDE_LIMITS", v.stat.motion.joint[0].overrideLimits); },
         [](S s, V v, A a, R) {
             bool on;
             if (!need_on_off(s, a[0], &on)) return Result::failed;
             EMC_JOINT_OVERRIDE_LIMITS m;
             m.joint = on ? 0 : -1;
             return give(v, m);
         }});
    table.push_back({"PAUSE", Level::on, true, 0, 0, "", nullptr, [](S s, V v, A, R) {
                         if (s.wait_done) {
                             s.error("Sending 'SET PAUSE' while not in 'WAIT_MODE RECEIVED' will stall forever");
                             return Result::failed;
                         }
                         return plain<EMC_TASK_PLAN_PAUSE>(v);
                     }});
    table.push_back({"POS_OFFSET", Level::on, false, 0, 0, "[axis]",
                     [](S s, V v, A a) {
                         Nine p, q;
                         to_nine(v.stat.task.g5x_offset, p);
                         to_nine(v.stat.task.g92_offset, q);
                         for (int i = 0; i < 9; i++) p[i] += q[i];
                         return say_nine(s, v, "POS_OFFSET", p, a);
                     },
                     nullptr});
    table.push_back({"PROBE", Level::on, true, 0, 3, "x y z", [](S, V, A) { return true; },
                     [](S s, V v, A a, R) {
                         double x, y, z;
                         if (!need_real(s, a[0], &x) || !need_real(s, a[1], &y) || !need_real(s, a[2], &z))
                             return Result::failed;
                         EMC_TASK_PLAN_EXECUTE m;
                         copy_text(m.command, text("g38.2 x%f y%f z%f", x, y, z).c_str());
                         return give(v, m);
                     }});
    table.push_back({"PROBE_CLEAR", Level::on, true, 0, 0, "", [](S, V, A) { return true; },
                     [](S, V v, A, R) { return plain<EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG>(v); }});
    table.push_back({"PROBE_TRIPPED", Level::on, false, 0, 0, "",
                     [](S s, V v, A) {
                         return say(s,
                                    std::string("PROBE_TRIPPED ") + (v.stat.motion.traj.probe_tripped ? "YES" : "NO"));
                     },
                     nullptr});
    table.push_back({"PROBE_VALUE", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, text("PROBE_VALUE %d", v.stat.motion.traj.probeval)); }, nullptr});
    table.push_back({"PROGRAM", Level::on, false, 0, 0, "",
                     [](S s, V v, A) {
                         return say(s, std::string("PROGRAM ") + (v.stat.task.file[0] ? v.stat.task.file : "NONE"));
                     },
                     nullptr});
    table.push_back({"PROGRAM_ANGULAR_UNITS", Level::on, false, 0, 0, "",
                     [](S s, V, A) { return say(s, "PROGRAM_ANGULAR_UNITS DEG"); }, nullptr});
    table.push_back({"PROGRAM_CODES", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, "PROGRAM_CODES " + codes(v.stat)); }, nullptr});
    table.push_back({"PROGRAM_LINE", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, text("PROGRAM_LINE %d", shown_line(v))); }, nullptr});
    table.push_back({"PROGRAM_LINEAR_UNITS", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, "PROGRAM_UNITS " + program_units(v.stat)); }, nullptr});
    table.push_back({"PROGRAM_UNITS", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, "PROGRAM_UNITS " + program_units(v.stat)); }, nullptr});
    table.push_back({"PROGRAM_STATUS", Level::on, false, 0, 0, "",
                     [](S s, V v, A) {
                         int i = v.stat.task.interpState;
                         s.reply(std::string("PROGRAM_STATUS ") +
                                 (i == EMC_TASK_INTERP_READING || i == EMC_TASK_INTERP_WAITING ? "RUNNING"
                                  : i == EMC_TASK_INTERP_PAUSED                                ? "PAUSED"
                                                                                               : "IDLE"));
                         return true;
                     },
                     nullptr});
    table.push_back(
        {"REL_ACT_POS", Level::on, false, 0, 0, "[axis]",
         [](S s, V v, A a) {
             Nine p;
             to_nine(minus(minus(v.stat.motion.traj.actualPosition, v.stat.task.g5x_offset), v.stat.task.g92_offset),
                     p);
             return say_nine(s, v, "REL_ACT_POS", p, a);
         },
         nullptr});
    table.push_back(
        {"REL_CMD_POS", Level::on, false, 0, 0, "[axis]",
         [](S s, V v, A a) {
             Nine p;
             to_nine(minus(minus(v.stat.motion.traj.position, v.stat.task.g5x_offset), v.stat.task.g92_offset), p);
             return say_nine(s, v, "REL_CMD_POS", p, a);
         },
         nullptr});
    table.push_back(
        {"RESUME", Level::on, true, 0, 0, "", nullptr, [](S s, V v, A, R) {
             if (!s.wait_done) {
                 s.warning("Sending 'SET RESUME' while not in 'WAIT_MODE DONE' may return before the system resumes");
                 return Result::failed;
             }
             return plain<EMC_TASK_PLAN_RESUME>(v);
         }});
    table.push_back({"RUN", Level::on, true, 0, 0, "[line]", nullptr, [](S s, V v, A a, R) {
                         EMC_TASK_PLAN_RUN m;
                         if (!a.empty() && !need_whole(s, a[0], &m.line)) return Result::failed;
                         v.start_line = m.line;
                         return give(v, m);
                     }});
    table.push_back(
        {"SPINDLE", Level::on, true, 0, 1, "{forward|reverse|increase|decrease|constant|off} [spindle]",
         [](S s, V v, A a) {
             return say_spindles(s, v, a, 0, [&](int n) {
                 int d = v.stat.motion.spindle[n].direction;
                 return text("SPINDLE %d %s", n, d > 0 ? "FORWARD" : d < 0 ? "REVERSE" : "OFF");
             });
         },
         [](S s, V v, A a, R) {
             int what;
             if (!need_word(s, a[0], {"forward", "reverse", "increase", "decrease", "constant", "off"}, &what))
                 return Result::failed;
             double speed = std::fabs(v.stat.task.activeSettings[2]);
             if (speed == 0) speed = 500;
             return for_spindles(s, v, a, 1, [&](int n) {
                 switch (what) {
                 case 0:
                 case 1: {
                     EMC_SPINDLE_ON m;
                     m.spindle = n;
                     m.speed = what == 0 ? speed : -speed;
                     return give(v, m);
                 }
                 case 2: {
                     EMC_SPINDLE_INCREASE m;
                     m.spindle = n;
                     return give(v, m);
                 }
                 case 3: {
                     EMC_SPINDLE_DECREASE m;
                     m.spindle = n;
                     return give(v, m);
                 }
                 case 4: {
                     EMC_SPINDLE_CONSTANT m;
                     m.spindle = n;
                     return give(v, m);
                 }
                 default: {
                     EMC_SPINDLE_OFF m;
                     m.spindle = n;
                     return give(v, m);
                 }
                 }
             });
         }});
    table.push_back({"SPINDLE_OVERRIDE", Level::on, true, 0, 2, "percent spindle",
                     [](S s, V v, A a) {
                         return say_spindles(s, v, a, -1, [&](int n) {
                             return text("SPINDLE_OVERRIDE %d %g", n,
                                         std::round(v.stat.motion.spindle[n].spindle_scale * 1e7) / 1e5);
                         });
                     },
                     [](S s, V v, A a, R) {
                         double p;
                         if (!need_real(s, a[0], &p)) return Result::failed;
                         if (p < 0 || p > 100) {
                             s.error("invalid: " + a[0] + " (valid: 0-100)");
                             return Result::failed;
                         }
                         return for_spindles(s, v, a, 1, [&](int n) {
                             EMC_TRAJ_SET_SPINDLE_SCALE m;
                             m.spindle = n;
                             m.scale = p / 100;
                             return give(v, m);
                         });
                     }});
    table.push_back(
        {"STEP", Level::on, true, 0, 0, "", nullptr, [](S, V v, A, R) { return plain<EMC_TASK_PLAN_STEP>(v); }});
    table.push_back({"TASK_PLAN_INIT", Level::on, true, 0, 0, "", nullptr,
                     [](S, V v, A, R) { return plain<EMC_TASK_PLAN_INIT>(v); }});
    table.push_back(
        {"TELEOP_ENABLE", Level::on, true, 0, 1, "{on|off}",
         [](S s, V v, A) { return say_on_off(s, "TELEOP_ENABLE", v.stat.motion.traj.mode == EMC_TRAJ_MODE_TELEOP); },
         [](S s, V v, A a, R) {
             bool on;
             if (!need_on_off(s, a[0], &on)) return Result::failed;
             EMC_TRAJ_SET_TELEOP_ENABLE m;
             m.enable = on;
             return give(v, m);
         }});
    table.push_back({"TOOL", Level::on, false, 0, 0, "",
                     [](S s, V v, A) { return say(s, text("TOOL %d", v.stat.io.tool.toolInSpindle)); }, nullptr});
    table.push_back({"TOOL_OFFSET", Level::on, true, 0, 3, "tool length diameter",
                     [](S s, V v, A) { return say(s, text("TOOL_OFFSET %f", v.stat.task.toolOffset.tran.z)); },
                     [](S s, V v, A a, R) {
                         EMC_TOOL_SET_OFFSET m;
                         if (!need_whole(s, a[0], &m.toolno) || !need_real(s, a[1], &m.offset.tran.z) ||
                             !need_real(s, a[2], &m.diameter))
                             return Result::failed;
                         return give(v, m);
                     }});
    table.push_back(
        {"USER_ANGULAR_UNITS", Level::on, false, 0, 0, "",
         [](S s, V v, A) { return say(s, "USER_ANGULAR_UNITS " + angular_name(v.stat.motion.traj.angularUnits)); },
         nullptr});
    table.push_back(
        {"USER_LINEAR_UNITS", Level::on, false, 0, 0, "",
         [](S s, V v, A) { return say(s, "USER_LINEAR_UNITS " + linear_name(v.stat.motion.traj.linearUnits)); },
         nullptr});
    table.push_back(
        {"WAIT_HEARTBEAT", Level::on, false, 0, 0, "[periods]", [](S, V, A) { return true; },
         [](S s, V v, A a, R) {
             int n = 1;
             if (!a.empty() && !need_whole(s, a[0], &n)) return Result::failed;
             if (n < 1) {
                 s.error("Invalid periods '" + a[0] + "', valid range [1,...)");
                 return Result::failed;
             }
             double t = n * v.servo_period_s();
             if (t > 1) {
                 s.error(text(
                     "Invalid periods '%d', waiting time of %.3f seconds would exceed timeout of 1.000 seconds", n, t));
                 return Result::failed;
             }
             const int64_t until = kerf_clock_now_ns() + static_cast<int64_t>(t * 1e9);
             s.watch([until] { return kerf_clock_now_ns() >= until ? Result::done : Result::watches; });
             return Result::watches;
         }});
}

} // namespace

const std::vector<Subcommand> &subcommands() {
    static const Table all = [] {
        Table table;
        link_subcommands(table);
        state_subcommands(table);
        machine_subcommands(table);
        return table;
    }();
    return all;
}

const Subcommand *find_subcommand(const std::string &name) {
    static const std::unordered_map<std::string, const Subcommand *> index = [] {
        std::unordered_map<std::string, const Subcommand *> m;
        for (const Subcommand &s : subcommands()) m[s.name] = &s;
        return m;
    }();
    auto it = index.find(name);
    return it == index.end() ? nullptr : it->second;
}

} // namespace rsh
