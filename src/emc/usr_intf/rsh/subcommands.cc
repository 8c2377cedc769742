// SPDX-License-Identifier: GPL-2.0-or-later
//
// subcommands.cc - linuxcncrsh: what can be got and set. Source: rsh sheet, B.5 and B.6.
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unordered_map>

#include "kerf_clock.h"
#include "session.hh"
#include "task_text.hh"

namespace rsh {
namespace {

const char AXES[] = "XYZABCUVW";

__attribute__((format(printf, 1, 2))) std::string text(const char *format, ...) {
    char buf[1024];
    va_list a;
    va_start(a, format);
    vsnprintf(buf, sizeof buf, format, a);
    va_end(a);
    return buf;
}

// ---- arguments ----

bool whole(const std::string &w, int *v) {
    char *end;
    long l = strtol(w.c_str(), &end, 10);
    if (w.empty() || *end) return false;
    *v = static_cast<int>(l);
    return true;
}

bool real(const std::string &w, double *v) {
    char *end;
    *v = strtod(w.c_str(), &end);
    return !w.empty() && !*end && std::isfinite(*v);
}

bool need_whole(Session &s, const std::string &w, int *v) {
    if (whole(w, v)) return true;
    s.error("Invalid argument '" + w + "', must be integer");
    return false;
}

bool need_real(Session &s, const std::string &w, double *v) {
    if (real(w, v)) return true;
    s.error("Invalid argument '" + w + "', must be floating point");
    return false;
}

bool need_on_off(Session &s, const std::string &w, bool *v) {
    if (on_off(w, v)) return true;
    s.error("Invalid argument '" + w + "', must be {on,off}");
    return false;
}

// One of the words of a comma separated list, as its index.
bool need_word(Session &s, const std::string &w, const std::vector<std::string> &words, int *index) {
    std::string u = upper(w), list;
    for (size_t i = 0; i < words.size(); i++) {
        if (upper(words[i]) == u) { *index = static_cast<int>(i); return true; }
        list += (i ? "," : "") + words[i];
    }
    s.error("Invalid argument '" + w + "', must be {" + list + "}");
    return false;
}

bool need_joint(Session &s, Server &v, const std::string &w, int low, int *j) {
    if (!need_whole(s, w, j)) return false;
    if (*j >= low && *j < v.joints()) return true;
    s.error(text("Invalid joint '%d', valid range [%d,%d]", *j, low, v.joints() - 1));
    return false;
}

bool need_spindle(Session &s, Server &v, const std::string &w, int *n) {
    if (!need_whole(s, w, n)) return false;
    if (*n >= -1 && *n < v.spindles()) return true;
    s.error(text("Invalid spindle '%d', valid range [-1,%d]", *n, v.spindles() - 1));
    return false;
}

// Letter or index 0 to 8.
bool need_axis(Session &s, const std::string &w, int *a) {
    int n;
    if (whole(w, &n) && n >= 0 && n < EMCMOT_MAX_AXIS) { *a = n; return true; }
    const char *p = w.size() == 1 ? strchr(AXES, toupper(static_cast<unsigned char>(w[0]))) : nullptr;
    if (p && *p) { *a = static_cast<int>(p - AXES); return true; }
    s.error("Invalid axis '" + w + "', must be one of XYZABCUVW");
    return false;
}

// ---- replies ----

void say_on_off(Session &s, const char *name, bool v) { s.reply(std::string(name) + (v ? " ON" : " OFF")); }

using Nine = double[9];

void to_nine(const EmcPose &p, Nine &v) {
    v[0] = p.tran.x; v[1] = p.tran.y; v[2] = p.tran.z; v[3] = p.a; v[4] = p.b; v[5] = p.c; v[6] = p.u; v[7] = p.v; v[8] = p.w;
}

bool say_nine(Session &s, Server &v, const char *name, const Nine &p, const Words &args) {
    if (args.empty()) {
        std::string out = name;
        for (double d : p) out += text(" %f", d);
        s.reply(out);
        return true;
    }
    int a;
    if (!need_axis(s, args[0], &a)) return false;
    if (!(v.stat.motion.traj.axis_mask & (1 << a))) s.warning(text("Axis '%c', not configured", AXES[a]));
    s.reply(text("%s %c %f", name, AXES[a], p[a]));
    return true;
}

EmcPose minus(const EmcPose &a, const EmcPose &b) {
    EmcPose r = a;
    r.tran.x -= b.tran.x; r.tran.y -= b.tran.y; r.tran.z -= b.tran.z;
    r.a -= b.a; r.b -= b.b; r.c -= b.c; r.u -= b.u; r.v -= b.v; r.w -= b.w;
    return r;
}

template <class F> bool say_joints(Session &s, Server &v, const char *name, const char *single, const Words &args, F value) {
    int j = -1;
    if (!args.empty() && !need_joint(s, v, args[0], -1, &j)) return false;
    if (j >= 0) {
        s.reply(std::string(single) + " " + std::to_string(j) + " " + value(v.stat.motion.joint[j]));
        return true;
    }
    std::string out = name;
    for (int n = 0; n < v.joints(); n++) out += " " + value(v.stat.motion.joint[n]);
    s.reply(out);
    return true;
}

bool near(double a, double b) { return std::fabs(a - b) < 1e-3; }
std::string linear_name(double units) { return near(units, 1) ? "MM" : near(units, 1 / 25.4) ? "INCH" : near(units, 0.1) ? "CM" : "CUSTOM"; }
std::string angular_name(double units) { return near(units, 1) ? "DEG" : near(units, 0.9) || near(units, 100.0 / 90) ? "GRAD" : near(units, M_PI / 180) ? "RAD" : "CUSTOM"; }
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
template <class M> Result plain(Server &v) { M m; return give(v, m); }

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

Result set_state(Session &s, Server &v, const Words &a, const char *name, int on_state, int off_state, bool on_may_interrupt) {
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

bool need_file(Session &s, Server &v, const std::string &name, std::string *full) {
    if (name.empty()) { s.error("Empty filename"); return false; }
    *full = find_file(v, name);
    if (full->empty()) { s.error("File '" + name + "' not found"); return false; }
    if (full->size() >= LINELEN) { s.error("Filename too long, 254 characters at most"); return false; }
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

template <class F> Result for_spindles(Session &s, Server &v, const Words &a, size_t at, F f) {
    int n = 0;
    if (a.size() > at && !need_spindle(s, v, a[at], &n)) return Result::failed;
    if (v.spindles() <= 0) { s.error("no spindles configured"); return Result::failed; }
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
    if (timeout > 30) s.warning("Timeout above 30 seconds. The remote shell and all other remote connections may stall for this period.");
    int64_t until = kerf_clock_now_ns() + static_cast<int64_t>(timeout * 1e9);
    for (int idle = 0;;) {
        v.refresh();
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
        if (all || idle > HOMING_GAP) break; // between two steps of a sequence nothing homes
        if (kerf_clock_now_ns() > until) {
            s.error(j < 0 ? text("One or more joints are still not homed after %.1f seconds", timeout) : text("Joint '%d' still not homed after %.1f seconds", j, timeout));
            return Result::failed;
        }
        v.sleep_heartbeats(1);
    }
    v.sleep_heartbeats(1);
    v.refresh();
    return Result::done;
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

#define GET [](Session & s, Server & v, const Words &a) -> bool
#define SET [](Session & s, Server & v, const Words &a, const std::string &rest) -> Result
#define UNUSED (void)s, (void)v, (void)a
#define UNUSED_SET (void)s, (void)v, (void)a, (void)rest

template <class ON, class OFF> Result switch_on_off(Session &s, Server &v, const Words &a) {
    bool on;
    if (!need_on_off(s, a[0], &on)) return Result::failed;
    return on ? plain<ON>(v) : plain<OFF>(v);
}

} // namespace

const std::vector<Subcommand> &subcommands() {
    static const std::vector<Subcommand> table = {
        {"ECHO", Level::none, false, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "ECHO", s.echo); return true; },
         SET { UNUSED_SET; return need_on_off(s, a[0], &s.echo) ? Result::done : Result::failed; }},
        {"TIMESTAMP", Level::none, false, 0, 1, "{on|off} [on|off]",
         GET { UNUSED; s.reply(std::string("TIMESTAMP ") + (s.timestamp ? "ON " : "OFF ") + (s.timestamp_epoch ? "ON" : "OFF")); return true; },
         SET {
             UNUSED_SET;
             bool on, epoch = false;
             if (!need_on_off(s, a[0], &on) || (a.size() > 1 && !need_on_off(s, a[1], &epoch))) return Result::failed;
             s.timestamp = on;
             s.timestamp_epoch = epoch;
             return Result::done;
         }},
        {"CHALLENGE", Level::none, false, 0, 0, "", GET { UNUSED; s.reply("CHALLENGE " + s.new_challenge()); return true; }, nullptr},
        {"CLIENTS", Level::hello, false, 0, 0, "", GET {
             UNUSED;
             for (auto &c : v.sessions)
                 s.reply(text("CLIENTS %d '%s'%s%s", c.first, c.second->client.c_str(), c.second->linked ? " LINKED" : "", c.second->enabled ? " ENABLED" : ""));
             return true;
         }, nullptr},
        {"COMM_PROT", Level::hello, false, 0, 0, "", GET {
             UNUSED;
             s.warning("GET COMM_PROT has been deprecated. It has no function.");
             s.reply("COMM_PROT " + s.version);
             return true;
         }, nullptr},
        {"DISABLE", Level::hello, false, 0, 0, "[connection]", nullptr, SET {
             UNUSED_SET;
             if (a.empty()) {
                 s.enabled = false;
                 s.reply("DISABLE SELF");
                 return Result::done;
             }
             int fd;
             if (!need_whole(s, a[0], &fd)) return Result::failed;
             auto it = v.sessions.find(fd);
             if (it == v.sessions.end()) { s.error("Client '" + a[0] + "' not available"); return Result::failed; }
             if (!it->second->enabled) { s.error("Client '" + a[0] + "' is not enabled"); return Result::failed; }
             it->second->enabled = false;
             s.reply("DISABLE " + a[0] + " " + it->second->client);
             return Result::done;
         }},
        {"ENABLE", Level::hello, false, 0, 1, "{password|off}", GET { UNUSED; say_on_off(s, "ENABLE", s.enabled); return true; }, SET {
             UNUSED_SET;
             if (upper(a[0]) == "OFF") {
                 if (!s.enabled) { s.error("Trying to set enable to off on a non-enabled link"); return Result::failed; }
                 s.enabled = false;
                 return Result::done;
             }
             if (!s.password_is(a[0], v.options.enable_password)) return Result::failed;
             s.enabled = true;
             return Result::done;
         }},
        {"INI", Level::hello, false, 2, 0, "variable section", GET {
             UNUSED;
             auto value = v.ini.findString(a[0], a[1]);
             if (!value) { s.error("INI file entry '[" + a[1] + "]" + a[0] + "' not found"); return false; }
             s.reply("INI [" + a[1] + "]" + a[0] + "=" + *value);
             return true;
         }, SET { UNUSED_SET; return Result::done; }},
        {"INIFILE", Level::hello, false, 0, 0, "", GET { UNUSED; s.reply("INIFILE " + v.options.ini_file); return true; }, SET { UNUSED_SET; return Result::done; }},
        {"PLAT", Level::hello, false, 0, 0, "", GET { UNUSED; s.reply("PLAT Linux"); return true; }, nullptr},
        {"TIME", Level::hello, false, 0, 0, "", GET {
             UNUSED;
             timeval tv;
             gettimeofday(&tv, nullptr);
             s.reply(text("TIME %ld.%06ld", static_cast<long>(tv.tv_sec), static_cast<long>(tv.tv_usec)));
             return true;
         }, nullptr},
        {"VERBOSE", Level::hello, false, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "VERBOSE", s.verbose); return true; },
         SET { UNUSED_SET; return need_on_off(s, a[0], &s.verbose) ? Result::done : Result::failed; }},

        {"DEBUG", Level::enable, true, 0, 1, "mask", GET { UNUSED; s.reply(text("DEBUG 0x%08x", static_cast<unsigned>(v.stat.debug))); return true; }, SET {
             UNUSED_SET;
             int mask;
             if (!need_whole(s, a[0], &mask)) return Result::failed;
             EMC_SET_DEBUG m;
             m.debug = static_cast<unsigned>(mask);
             return give(v, m);
         }},
        {"ERROR", Level::enable, false, 0, 0, "", GET { UNUSED; return say_message(s, v, "ERROR", v.error_text); }, nullptr},
        {"OPERATOR_TEXT", Level::enable, false, 0, 0, "", GET { UNUSED; return say_message(s, v, "OPERATOR_TEXT", v.operator_text); }, nullptr},
        {"OPERATOR_DISPLAY", Level::enable, false, 0, 0, "", GET { UNUSED; return say_message(s, v, "OPERATOR_DISPLAY", v.operator_display); }, nullptr},
        {"ESTOP", Level::enable, false, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "ESTOP", v.stat.task.state == EMC_TASK_STATE_ESTOP); return true; },
         SET { UNUSED_SET; return set_state(s, v, a, "ESTOP", EMC_TASK_STATE_ESTOP, EMC_TASK_STATE_ESTOP_RESET, true); }},
        {"MACHINE", Level::enable, false, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "MACHINE", v.stat.task.state == EMC_TASK_STATE_ON); return true; },
         SET { UNUSED_SET; return set_state(s, v, a, "MACHINE", EMC_TASK_STATE_ON, EMC_TASK_STATE_OFF, false); }},
        {"TIMEOUT", Level::enable, false, 0, 1, "seconds", GET { UNUSED; s.reply(text("TIMEOUT %f", s.timeout_s)); return true; }, SET {
             UNUSED_SET;
             double t;
             if (!need_real(s, a[0], &t) || t < 0) return Result::failed;
             s.timeout_s = t;
             return Result::done;
         }},
        {"UPDATE", Level::enable, false, 0, 1, "{none|auto}", GET { UNUSED; s.reply("UPDATE " + v.update_mode); return true; }, SET {
             UNUSED_SET;
             int i;
             if (!need_word(s, a[0], {"none", "auto"}, &i)) return Result::failed;
             v.update_mode = i ? "AUTO" : "NONE";
             return Result::done;
         }},
        {"UPDATE_STATUS", Level::enable, false, 0, 0, "", nullptr, SET { UNUSED_SET; v.refresh(); return Result::done; }},
        {"WAIT", Level::enable, false, 0, 1, "{received|done|none}", GET { UNUSED; return true; }, SET {
             UNUSED_SET;
             int i;
             if (!need_word(s, a[0], {"received", "done", "none"}, &i)) return Result::failed;
             if (i == 2) return Result::done;
             s.wait_for(i == 1);
             return Result::waits;
         }},
        {"WAIT_MODE", Level::enable, false, 0, 1, "{received|done}", GET { UNUSED; s.reply(std::string("WAIT_MODE ") + (s.wait_done ? "DONE" : "RECEIVED")); return true; }, SET {
             UNUSED_SET;
             if (upper(a[0]) == "NONE") {
                 s.error("Setting 'SET WAIT_MODE' to 'NONE' has been removed as it may cause commands to be lost.");
                 return Result::failed;
             }
             int i;
             if (!need_word(s, a[0], {"received", "done"}, &i)) return Result::failed;
             s.wait_done = i == 1;
             return Result::done;
         }},

        {"ABORT", Level::on, false, 0, 0, "", nullptr, SET { UNUSED_SET; EMC_TASK_ABORT m; return v.client->send(m) ? Result::done : Result::failed; }},
        {"ABS_ACT_POS", Level::on, false, 0, 0, "[axis]", GET { Nine p; to_nine(v.stat.motion.traj.actualPosition, p); return say_nine(s, v, "ABS_ACT_POS", p, a); }, nullptr},
        {"ABS_CMD_POS", Level::on, false, 0, 0, "[axis]", GET { Nine p; to_nine(v.stat.motion.traj.position, p); return say_nine(s, v, "ABS_CMD_POS", p, a); }, nullptr},
        {"ANGULAR_UNIT_CONVERSION", Level::on, false, 0, 1, "{deg|rad|grad|auto|custom}",
         GET { UNUSED; s.reply("ANGULAR_UNIT_CONVERSION " + v.angular_conversion); return true; }, SET {
             UNUSED_SET;
             int i;
             if (!need_word(s, a[0], {"deg", "rad", "grad", "auto", "custom"}, &i)) return Result::failed;
             v.angular_conversion = upper(a[0]);
             return Result::done;
         }},
        {"AXIS_VELOCITY", Level::on, false, 0, 0, "[axis]", GET {
             Nine p;
             for (int i = 0; i < 9; i++) p[i] = v.stat.motion.axis[i].velocity;
             return say_nine(s, v, "AXIS_VELOCITY", p, a);
         }, nullptr},
        {"BRAKE", Level::on, true, 0, 1, "{on|off} [spindle]", GET {
             return say_spindles(s, v, a, 0, [&](int n) { return text("BRAKE %d %s", n, v.stat.motion.spindle[n].brake ? "ON" : "OFF"); });
         }, SET {
             UNUSED_SET;
             bool on;
             if (!need_on_off(s, a[0], &on)) return Result::failed;
             return for_spindles(s, v, a, 1, [&](int n) {
                 if (on) { EMC_SPINDLE_BRAKE_ENGAGE m; m.spindle = n; return give(v, m); }
                 EMC_SPINDLE_BRAKE_RELEASE m;
                 m.spindle = n;
                 return give(v, m);
             });
         }},
        {"DISPLAY_ANGULAR_UNITS", Level::on, false, 0, 0, "", GET {
             UNUSED;
             s.reply("DISPLAY_ANGULAR_UNITS " + (v.angular_conversion == "AUTO" ? "DEG" : v.angular_conversion));
             return true;
         }, nullptr},
        {"DISPLAY_LINEAR_UNITS", Level::on, false, 0, 0, "", GET {
             UNUSED;
             s.reply("DISPLAY_LINEAR_UNITS " + (v.linear_conversion == "AUTO" ? program_units(v.stat) : v.linear_conversion));
             return true;
         }, nullptr},
        {"FEED_OVERRIDE", Level::on, true, 0, 1, "percent", GET { UNUSED; s.reply(text("FEED_OVERRIDE %f", v.stat.motion.traj.scale * 100)); return true; }, SET {
             UNUSED_SET;
             double p;
             if (!need_real(s, a[0], &p)) return Result::failed;
             EMC_TRAJ_SET_SCALE m;
             m.scale = p / 100;
             return give(v, m);
         }},
        {"FLOOD", Level::on, true, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "FLOOD", v.stat.io.coolant.flood); return true; },
         SET { UNUSED_SET; return switch_on_off<EMC_COOLANT_FLOOD_ON, EMC_COOLANT_FLOOD_OFF>(s, v, a); }},
        {"MIST", Level::on, true, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "MIST", v.stat.io.coolant.mist); return true; },
         SET { UNUSED_SET; return switch_on_off<EMC_COOLANT_MIST_ON, EMC_COOLANT_MIST_OFF>(s, v, a); }},
        {"HOME", Level::on, true, 0, 1, "joint", nullptr, home},
        {"JOINT_HOME", Level::on, true, 0, 1, "joint", nullptr, home},
        {"JOG", Level::on, true, 0, 2, "joint|axis speed", nullptr, SET {
             UNUSED_SET;
             EMC_JOG_CONT m;
             double speed;
             if (!jog_target(s, v, a[0], &m.joint_or_axis, &m.jjogmode) || !real(a[1], &speed)) return Result::failed;
             m.vel = speed / 60;
             s.jogs.emplace_back(m.joint_or_axis, m.jjogmode);
             return give(v, m);
         }},
        {"JOG_INCR", Level::on, true, 0, 3, "joint|axis speed increment", nullptr, SET {
             UNUSED_SET;
             EMC_JOG_INCR m;
             double speed;
             if (!jog_target(s, v, a[0], &m.joint_or_axis, &m.jjogmode) || !real(a[1], &speed) || !real(a[2], &m.incr)) return Result::failed;
             m.vel = speed / 60;
             return give(v, m);
         }},
        {"JOG_STOP", Level::on, true, 0, 1, "joint|axis", nullptr, SET {
             UNUSED_SET;
             EMC_JOG_STOP m;
             if (!jog_target(s, v, a[0], &m.joint_or_axis, &m.jjogmode)) return Result::failed;
             s.jogs.erase(std::remove(s.jogs.begin(), s.jogs.end(), std::make_pair(m.joint_or_axis, m.jjogmode)), s.jogs.end());
             return give(v, m);
         }},
        {"JOINT_FAULT", Level::on, false, 0, 0, "[joint]",
         GET { return say_joints(s, v, "JOINT_FAULT", "JOINT_FAULT", a, [](const EMC_JOINT_STAT &j) { return std::string(j.fault ? "FAULT" : "OK"); }); }, nullptr},
        {"JOINT_HOMED", Level::on, false, 0, 0, "[joint]",
         GET { return say_joints(s, v, "JOINT_HOMED", "JOINT_HOMED", a, [](const EMC_JOINT_STAT &j) { return std::string(j.homed ? "YES" : "NO"); }); }, nullptr},
        {"JOINT_LIMIT", Level::on, false, 0, 0, "[joint]", GET {
             return say_joints(s, v, "JOINT_LIMIT", "JOINT_LIMIT", a, [](const EMC_JOINT_STAT &j) {
                 return std::string(j.minHardLimit ? "MINHARD" : j.minSoftLimit ? "MINSOFT" : j.maxSoftLimit ? "MAXSOFT" : j.maxHardLimit ? "MAXHARD" : "OK");
             });
         }, nullptr},
        {"JOINT_POS", Level::on, false, 0, 0, "[joint]",
         GET { return say_joints(s, v, "JOINT_POS", "JOINT_POS", a, [](const EMC_JOINT_STAT &j) { return text("%f", j.input); }); }, nullptr},
        {"JOINT_TYPE", Level::on, false, 0, 0, "[joint]", GET {
             return say_joints(s, v, "JOINT_TYPE", "JOINT_TYPE", a,
                               [](const EMC_JOINT_STAT &j) { return std::string(j.jointType == EMC_LINEAR ? "LINEAR" : j.jointType == EMC_ANGULAR ? "ANGULAR" : "CUSTOM"); });
         }, nullptr},
        {"JOINT_UNHOME", Level::on, true, 0, 1, "joint", nullptr, SET {
             UNUSED_SET;
             EMC_JOINT_UNHOME m;
             if (!need_joint(s, v, a[0], -2, &m.joint)) return Result::failed;
             return give(v, m);
         }},
        {"JOINT_UNITS", Level::on, false, 0, 0, "[joint]", GET {
             return say_joints(s, v, "JOINT_UNITS", "JOIN_UNITS", a,
                               [](const EMC_JOINT_STAT &j) { return j.jointType == EMC_ANGULAR ? angular_name(j.units) : linear_name(j.units); });
         }, nullptr},
        {"JOINT_VELOCITY", Level::on, false, 0, 0, "[joint]",
         GET { return say_joints(s, v, "JOINT_VELOCITY", "JOINT_VELOCITY", a, [](const EMC_JOINT_STAT &j) { return text("%f", j.velocity); }); }, nullptr},
        {"JOINT_WAIT_HOMED", Level::on, false, 0, 1, "joint [timeout]", nullptr, SET { UNUSED_SET; return wait_homed(s, v, a); }},
        {"KINEMATICS_TYPE", Level::on, false, 0, 0, "", GET { UNUSED; s.reply(text("KINEMATICS_TYPE %d", v.stat.motion.traj.kinematics_type)); return true; }, nullptr},
        {"LINEAR_UNIT_CONVERSION", Level::on, false, 0, 1, "{inch|mm|cm|auto|custom}",
         GET { UNUSED; s.reply("LINEAR_UNIT_CONVERSION " + v.linear_conversion); return true; }, SET {
             UNUSED_SET;
             int i;
             if (!need_word(s, a[0], {"inch", "mm", "cm", "auto", "custom"}, &i)) return Result::failed;
             v.linear_conversion = upper(a[0]);
             return Result::done;
         }},
        {"LOAD_TOOL_TABLE", Level::on, true, 0, 1, "file", nullptr, SET {
             UNUSED_SET;
             std::string full;
             if (!need_file(s, v, rest, &full)) return Result::failed;
             EMC_TOOL_LOAD_TOOL_TABLE m;
             copy_text(m.file, full.c_str());
             return give(v, m);
         }},
        {"MDI", Level::on, true, 0, 1, "text", nullptr, SET {
             UNUSED_SET;
             EMC_TASK_PLAN_EXECUTE m;
             if (rest.size() >= sizeof m.command) { s.error("MDI commands limited to 254 characters"); return Result::failed; }
             copy_text(m.command, rest.c_str());
             return give(v, m);
         }},
        {"MODE", Level::on, true, 0, 1, "{manual|auto|mdi}", GET {
             UNUSED;
             int m = v.stat.task.mode;
             s.reply(std::string("MODE ") + (m == EMC_TASK_MODE_AUTO ? "AUTO" : m == EMC_TASK_MODE_MDI ? "MDI" : "MANUAL"));
             return true;
         }, SET {
             UNUSED_SET;
             EMC_TASK_SET_MODE m;
             int i;
             if (!need_word(s, a[0], {"manual", "auto", "mdi"}, &i)) return Result::failed;
             m.mode = i + 1;
             return give(v, m);
         }},
        {"OPEN", Level::on, true, 0, 1, "file", GET { UNUSED; s.reply("OPEN " + (s.opened.empty() ? std::string("NONE") : s.opened)); return true; }, SET {
             UNUSED_SET;
             std::string full;
             if (!need_file(s, v, rest, &full)) return Result::failed;
             EMC_TASK_PLAN_OPEN m;
             copy_text(m.file, full.c_str());
             s.opened = full;
             return give(v, m);
         }},
        {"OPTIONAL_STOP", Level::on, true, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "OPTIONAL_STOP", v.stat.task.optional_stop_state); return true; }, SET {
             UNUSED_SET;
             EMC_TASK_PLAN_SET_OPTIONAL_STOP m;
             if (!need_on_off(s, a[0], &m.state)) return Result::failed;
             return give(v, m);
         }},
        {"OVERRIDE_LIMITS", Level::on, true, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "OVERRIDE_LIMITS", v.stat.motion.joint[0].overrideLimits); return true; }, SET {
             UNUSED_SET;
             bool on;
             if (!need_on_off(s, a[0], &on)) return Result::failed;
             EMC_JOINT_OVERRIDE_LIMITS m;
             m.joint = on ? 0 : -1;
             return give(v, m);
         }},
        {"PAUSE", Level::on, true, 0, 0, "", nullptr, SET {
             UNUSED_SET;
             if (s.wait_done) { s.error("Sending 'SET PAUSE' while not in 'WAIT_MODE RECEIVED' will stall forever"); return Result::failed; }
             return plain<EMC_TASK_PLAN_PAUSE>(v);
         }},
        {"POS_OFFSET", Level::on, false, 0, 0, "[axis]", GET {
             Nine p, q;
             to_nine(v.stat.task.g5x_offset, p);
             to_nine(v.stat.task.g92_offset, q);
             for (int i = 0; i < 9; i++) p[i] += q[i];
             return say_nine(s, v, "POS_OFFSET", p, a);
         }, nullptr},
        {"PROBE", Level::on, true, 0, 3, "x y z", GET { UNUSED; return true; }, SET {
             UNUSED_SET;
             double x, y, z;
             if (!need_real(s, a[0], &x) || !need_real(s, a[1], &y) || !need_real(s, a[2], &z)) return Result::failed;
             EMC_TASK_PLAN_EXECUTE m;
             copy_text(m.command, text("g38.2 x%f y%f z%f", x, y, z).c_str());
             return give(v, m);
         }},
        {"PROBE_CLEAR", Level::on, true, 0, 0, "", GET { UNUSED; return true; }, SET { UNUSED_SET; return plain<EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG>(v); }},
        {"PROBE_TRIPPED", Level::on, false, 0, 0, "", GET { UNUSED; s.reply(std::string("PROBE_TRIPPED ") + (v.stat.motion.traj.probe_tripped ? "YES" : "NO")); return true; }, nullptr},
        {"PROBE_VALUE", Level::on, false, 0, 0, "", GET { UNUSED; s.reply(text("PROBE_VALUE %d", v.stat.motion.traj.probeval)); return true; }, nullptr},
        {"PROGRAM", Level::on, false, 0, 0, "", GET { UNUSED; s.reply(std::string("PROGRAM ") + (v.stat.task.file[0] ? v.stat.task.file : "NONE")); return true; }, nullptr},
        {"PROGRAM_ANGULAR_UNITS", Level::on, false, 0, 0, "", GET { UNUSED; s.reply("PROGRAM_ANGULAR_UNITS DEG"); return true; }, nullptr},
        {"PROGRAM_CODES", Level::on, false, 0, 0, "", GET { UNUSED; s.reply("PROGRAM_CODES " + codes(v.stat)); return true; }, nullptr},
        {"PROGRAM_LINE", Level::on, false, 0, 0, "", GET { UNUSED; s.reply(text("PROGRAM_LINE %d", shown_line(v))); return true; }, nullptr},
        {"PROGRAM_LINEAR_UNITS", Level::on, false, 0, 0, "", GET { UNUSED; s.reply("PROGRAM_UNITS " + program_units(v.stat)); return true; }, nullptr},
        {"PROGRAM_UNITS", Level::on, false, 0, 0, "", GET { UNUSED; s.reply("PROGRAM_UNITS " + program_units(v.stat)); return true; }, nullptr},
        {"PROGRAM_STATUS", Level::on, false, 0, 0, "", GET {
             UNUSED;
             int i = v.stat.task.interpState;
             s.reply(std::string("PROGRAM_STATUS ") + (i == EMC_TASK_INTERP_READING || i == EMC_TASK_INTERP_WAITING ? "RUNNING" : i == EMC_TASK_INTERP_PAUSED ? "PAUSED" : "IDLE"));
             return true;
         }, nullptr},
        {"REL_ACT_POS", Level::on, false, 0, 0, "[axis]", GET {
             Nine p;
             to_nine(minus(minus(v.stat.motion.traj.actualPosition, v.stat.task.g5x_offset), v.stat.task.g92_offset), p);
             return say_nine(s, v, "REL_ACT_POS", p, a);
         }, nullptr},
        {"REL_CMD_POS", Level::on, false, 0, 0, "[axis]", GET {
             Nine p;
             to_nine(minus(minus(v.stat.motion.traj.position, v.stat.task.g5x_offset), v.stat.task.g92_offset), p);
             return say_nine(s, v, "REL_CMD_POS", p, a);
         }, nullptr},
        {"RESUME", Level::on, true, 0, 0, "", nullptr, SET {
             UNUSED_SET;
             if (!s.wait_done) { s.warning("Sending 'SET RESUME' while not in 'WAIT_MODE DONE' may return before the system resumes"); return Result::failed; }
             return plain<EMC_TASK_PLAN_RESUME>(v);
         }},
        {"RUN", Level::on, true, 0, 0, "[line]", nullptr, SET {
             UNUSED_SET;
             EMC_TASK_PLAN_RUN m;
             if (!a.empty() && !need_whole(s, a[0], &m.line)) return Result::failed;
             v.start_line = m.line;
             return give(v, m);
         }},
        {"SPINDLE", Level::on, true, 0, 1, "{forward|reverse|increase|decrease|constant|off} [spindle]", GET {
             return say_spindles(s, v, a, 0, [&](int n) {
                 int d = v.stat.motion.spindle[n].direction;
                 return text("SPINDLE %d %s", n, d > 0 ? "FORWARD" : d < 0 ? "REVERSE" : "OFF");
             });
         }, SET {
             UNUSED_SET;
             int what;
             if (!need_word(s, a[0], {"forward", "reverse", "increase", "decrease", "constant", "off"}, &what)) return Result::failed;
             double speed = std::fabs(v.stat.task.activeSettings[2]);
             if (speed == 0) speed = 500;
             return for_spindles(s, v, a, 1, [&](int n) {
                 switch (what) {
                 case 0: case 1: { EMC_SPINDLE_ON m; m.spindle = n; m.speed = what == 0 ? speed : -speed; return give(v, m); }
                 case 2: { EMC_SPINDLE_INCREASE m; m.spindle = n; return give(v, m); }
                 case 3: { EMC_SPINDLE_DECREASE m; m.spindle = n; return give(v, m); }
                 case 4: { EMC_SPINDLE_CONSTANT m; m.spindle = n; return give(v, m); }
                 default: { EMC_SPINDLE_OFF m; m.spindle = n; return give(v, m); }
                 }
             });
         }},
        {"SPINDLE_OVERRIDE", Level::on, true, 0, 2, "percent spindle", GET {
             return say_spindles(s, v, a, -1, [&](int n) { return text("SPINDLE_OVERRIDE %d %g", n, std::round(v.stat.motion.spindle[n].spindle_scale * 1e7) / 1e5); });
         }, SET {
             UNUSED_SET;
             double p;
             if (!need_real(s, a[0], &p)) return Result::failed;
             if (p < 0 || p > 100) { s.error("invalid: " + a[0] + " (valid: 0-100)"); return Result::failed; }
             return for_spindles(s, v, a, 1, [&](int n) {
                 EMC_TRAJ_SET_SPINDLE_SCALE m;
                 m.spindle = n;
                 m.scale = p / 100;
                 return give(v, m);
             });
         }},
        {"STEP", Level::on, true, 0, 0, "", nullptr, SET { UNUSED_SET; return plain<EMC_TASK_PLAN_STEP>(v); }},
        {"TASK_PLAN_INIT", Level::on, true, 0, 0, "", nullptr, SET { UNUSED_SET; return plain<EMC_TASK_PLAN_INIT>(v); }},
        {"TELEOP_ENABLE", Level::on, true, 0, 1, "{on|off}", GET { UNUSED; say_on_off(s, "TELEOP_ENABLE", v.stat.motion.traj.mode == EMC_TRAJ_MODE_TELEOP); return true; }, SET {
             UNUSED_SET;
             bool on;
             if (!need_on_off(s, a[0], &on)) return Result::failed;
             EMC_TRAJ_SET_TELEOP_ENABLE m;
             m.enable = on;
             return give(v, m);
         }},
        {"TOOL", Level::on, false, 0, 0, "", GET { UNUSED; s.reply(text("TOOL %d", v.stat.io.tool.toolInSpindle)); return true; }, nullptr},
        {"TOOL_OFFSET", Level::on, true, 0, 3, "tool length diameter", GET { UNUSED; s.reply(text("TOOL_OFFSET %f", v.stat.task.toolOffset.tran.z)); return true; }, SET {
             UNUSED_SET;
             EMC_TOOL_SET_OFFSET m;
             if (!need_whole(s, a[0], &m.toolno) || !need_real(s, a[1], &m.offset.tran.z) || !need_real(s, a[2], &m.diameter)) return Result::failed;
             return give(v, m);
         }},
        {"USER_ANGULAR_UNITS", Level::on, false, 0, 0, "", GET { UNUSED; s.reply("USER_ANGULAR_UNITS " + angular_name(v.stat.motion.traj.angularUnits)); return true; }, nullptr},
        {"USER_LINEAR_UNITS", Level::on, false, 0, 0, "", GET { UNUSED; s.reply("USER_LINEAR_UNITS " + linear_name(v.stat.motion.traj.linearUnits)); return true; }, nullptr},
        {"WAIT_HEARTBEAT", Level::on, false, 0, 0, "[periods]", GET { UNUSED; return true; }, SET {
             UNUSED_SET;
             int n = 1;
             if (!a.empty() && !need_whole(s, a[0], &n)) return Result::failed;
             if (n < 1) { s.error("Invalid periods '" + a[0] + "', valid range [1,...)"); return Result::failed; }
             double t = n * v.servo_period_s();
             if (t > 1) { s.error(text("Invalid periods '%d', waiting time of %.3f seconds would exceed timeout of 1.000 seconds", n, t)); return Result::failed; }
             v.sleep_heartbeats(n);
             return Result::done;
         }},
    };
    return table;
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
