// SPDX-License-Identifier: GPL-2.0-or-later
//
// halui.cc - buttons and lamps: HAL pins that give task commands and show its status.
//
// Loop of 20 ms: rising edges of input pins become commands, the status becomes output
// pins. [task] Source: halui sheet, part A.
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "client.hh"
#include "emc_args.hh"
#include "hal.h"
#include "inifile.hh"
#include "kerf_clock.h"
#include "rcs_print.hh"
#include "task_text.hh"
#include "tooldata.h"

namespace {

constexpr int64_t PERIOD_NS = 20'000'000;
constexpr double RECEIVE_TIMEOUT_S = 10.0, POLL_S = 0.005;
constexpr double CONNECT_PATIENCE_S = 10.0;
constexpr int64_t WRITERS_NS = 100'000'000; // between two looks at who drives the pins of jogs
constexpr size_t MAX_MDI = 64;
const char AXES[] = "xyzabcuvw";

volatile int stop = 0;
void on_signal(int) { stop = 1; }

// ---- pins that remember what they were ----

// An input pin. What its signal says when it is linked (a button held at power-up, the count of a wheel) is how things
// are, not something that happens.
template <class T> struct Input {
    using Value = T;
    volatile T **pin = nullptr; // in HAL memory
    volatile T *signal = nullptr;
    T old = 0;
    void made(volatile T **p) {
        pin = p;
        signal = *p;
        old = **p;
    }
    T now() const { return **pin; }
    // True when it was linked or unlinked since the last time; old is then what it is now.
    bool relinked() {
        if (*pin == signal) return false;
        made(pin);
        return true;
    }
};

struct Bit : Input<bool> {
    // -1 fell, 1 rose, 0 neither
    int edge() {
        relinked();
        const bool v = now();
        int e = v == old ? 0 : v ? 1 : -1;
        old = v;
        return e;
    }
    bool rose() { return edge() > 0; }
    // Also TRUE when the pin is linked to a signal that is: of an emergency stop, however it comes.
    bool rose_or_came() {
        const bool linked = relinked();
        return rose() || (linked && now());
    }
};

struct Real : Input<double> {
    bool changed() {
        const double v = now();
        if (v == old || (std::isnan(v) && std::isnan(old))) return false;
        old = v;
        return true;
    }
};

struct Count : Input<rtapi_s32> {
    int delta() {
        relinked();
        const auto before = static_cast<uint32_t>(old);
        old = now();
        return static_cast<int>(static_cast<uint32_t>(old) - before);
    }
};

struct RealOut {
    hal_float_t **pin = nullptr; // null: the axis is not configured
    void set(double v) const { **pin = v; }
};

// Whether a pin is linked to a signal that something drives.
bool has_writer(const std::string &pin) {
    auto signal = [](hal_query_t *p, void *) {
        hal_query_t s{};
        s.name = p->pp.signal;
        s.qtype = HAL_QTYPE_SIGNAL;
        return s.name && hal_get_s(&s, nullptr, nullptr) == 0 && s.sig.writers + s.sig.bidirs > 0 ? 1 : 0;
    };
    hal_query_t p{};
    p.name = pin.c_str();
    p.qtype = HAL_QTYPE_PIN;
    return hal_get_p(&p, signal, nullptr) == 1;
}

class Pins {
public:
    explicit Pins(int comp) : comp_(comp) {}
    bool good() const { return result_ == 0; }
    __attribute__((format(printf, 2, 3))) Bit in_bit(const char *format, ...) {
        va_list a;
        va_start(a, format);
        std::string name = text(format, a);
        va_end(a);
        return in<Bit>(name, hal_pin_bit_newf, false);
    }
    Real in_real(const std::string &name, double value = 0) {
        return in<Real>(name, hal_pin_float_newf, value);
    }
    Count in_count(const std::string &name) { return in<Count>(name, hal_pin_s32_newf, 0); }
    hal_float_t **out_real(const std::string &name) {
        hal_float_t **p = memory<hal_float_t *>();
        if (p) result_ |= hal_pin_float_newf(HAL_OUT, p, comp_, "%s", name.c_str());
        return p;
    }
    hal_u32_t **out_u32(const std::string &name) {
        hal_u32_t **p = memory<hal_u32_t *>();
        if (p) result_ |= hal_pin_u32_newf(HAL_OUT, p, comp_, "%s", name.c_str());
        return p;
    }
    hal_bit_t **out(const std::string &name) {
        hal_bit_t **p = memory<hal_bit_t *>();
        if (p) result_ |= hal_pin_bit_newf(HAL_OUT, p, comp_, "%s", name.c_str());
        return p;
    }
    void preset(Bit &b, bool value) { if (good()) **b.pin = b.old = value; }
private:
    template <class P, class F> P in(const std::string &name, F make, typename P::Value value) {
        P p;
        auto place = memory<volatile typename P::Value *>();
        if (place && (result_ |= make(HAL_IN, place, comp_, "%s", name.c_str())) == 0) {
            **place = value;
            p.made(place);
        }
        return p;
    }
    template <class T> T *memory() {
        T *p = static_cast<T *>(hal_malloc(sizeof(T)));
        if (!p) result_ = -1;
        return p;
    }
    static std::string text(const char *format, va_list a) {
        char buf[HAL_NAME_LEN + 1];
        vsnprintf(buf, sizeof buf, format, a);
        return buf;
    }
    int comp_, result_ = 0;
};

// A value that counts, buttons and a reset change: overrides and the maximum velocity.
struct Override {
    Count counts;
    Bit count_enable, direct_value, increase, decrease, reset;
    Real scale;
    hal_float_t **value = nullptr;
    bool has_reset = false;

    void create(Pins &p, const std::string &name, double scale_value, bool with_reset) {
        counts = p.in_count(name + ".counts");
        count_enable = p.in_bit("%s.count-enable", name.c_str());
        p.preset(count_enable, true);
        direct_value = p.in_bit("%s.direct-value", name.c_str());
        scale = p.in_real(name + ".scale", scale_value);
        increase = p.in_bit("%s.increase", name.c_str());
        decrease = p.in_bit("%s.decrease", name.c_str());
        has_reset = with_reset;
        if (with_reset) reset = p.in_bit("%s.reset", name.c_str());
        value = p.out_real(name + ".value");
    }
    // The new value; false when nothing asked for one.
    bool wanted(double present, double low, double high, double *out) {
        bool ask = false;
        double v = present;
        if (int d = counts.delta(); d != 0 && count_enable.now()) {
            v = direct_value.now() ? counts.old * scale.now() : v + d * scale.now();
            ask = true;
        }
        if (increase.rose()) { v += scale.now(); ask = true; }
        if (decrease.rose()) { v -= scale.now(); ask = true; }
        if (has_reset && reset.rose()) { v = 1.0; ask = true; }
        *out = std::clamp(v, low, high);
        return ask;
    }
};

// Jogging of one joint or axis, or of the selected one.
struct Jog {
    Bit plus, minus, increment_plus, increment_minus;
    Real analog, increment;
    bool has_analog = false;
    double way = 0;        // of the continuous jog that these pins hold: its speed is way * jog-speed; 0 none
    uint64_t began = 0;    // servo cycle of its last command
    bool centred = false;  // analog was in the dead band since it last could not jog
    std::string name, holder; // holder: the pin that holds the jog
    bool driven = false;      // its signal had a writer
    void create(Pins &p, const std::string &prefix, bool with_analog) {
        name = prefix;
        plus = p.in_bit("%s.plus", name.c_str());
        minus = p.in_bit("%s.minus", name.c_str());
        has_analog = with_analog;
        if (with_analog) analog = p.in_real(name + ".analog");
        increment = p.in_real(name + ".increment");
        increment_plus = p.in_bit("%s.increment-plus", name.c_str());
        increment_minus = p.in_bit("%s.increment-minus", name.c_str());
    }
};

struct JointLamps {
    hal_bit_t **homed, **soft_min, **soft_max, **hard_min, **hard_max, **override_limits, **fault;
    void create(Pins &p, const std::string &name) {
        homed = p.out(name + ".is-homed");
        soft_min = p.out(name + ".on-soft-min-limit");
        soft_max = p.out(name + ".on-soft-max-limit");
        hard_min = p.out(name + ".on-hard-min-limit");
        hard_max = p.out(name + ".on-hard-max-limit");
        override_limits = p.out(name + ".override-limits");
        fault = p.out(name + ".has-fault");
    }
    void show(const EMC_JOINT_STAT &j) const {
        **homed = j.homed;
        **soft_min = j.minSoftLimit;
        **soft_max = j.maxSoftLimit;
        **hard_min = j.minHardLimit;
        **hard_max = j.maxHardLimit;
        **override_limits = j.overrideLimits;
        **fault = j.fault;
    }
};

class Halui {
public:
    bool read_ini(const std::string &file);
    bool connect();
    bool create();
    void run();
    ~Halui() { if (comp_ >= 0) hal_exit(comp_); }

private:
    void commands();
    void show();
    bool jogs_possible() const {
        return stat_.task.state == EMC_TASK_STATE_ON && stat_.task.mode == EMC_TASK_MODE_MANUAL;
    }
    void jogs();
    void hold(Jog &j, int n, const char *pin, double way, double speed, bool joints);
    void let_go(Jog &j, int n, bool joints);
    void let_go_undriven();
    bool ended(const Jog &j) const;
    void jog_group(std::vector<Jog> &all, Jog &selected, hal_u32_t **number, Real &speed, Real &deadband, bool joints,
                   std::vector<Bit> &select, std::vector<hal_bit_t **> &lamps, const std::vector<int> &present);
    void mdi();
    void release();
    bool refresh() {
        client_->refresh(&stat_);
        return client_->status_channel().valid();
    }
    template <class M> void give(M &m) {
        if (!client_->send(m)) return;
        client_->wait_received(RECEIVE_TIMEOUT_S, POLL_S);
    }
    template <class M> void plain() { M m; give(m); }
    void set_state(int state) { EMC_TASK_SET_STATE m; m.state = state; give(m); }
    void set_mode(int mode) {
        if (stat_.task.mode == mode) return;
        EMC_TASK_SET_MODE m;
        m.mode = mode;
        give(m);
    }
    void teleop(int on) {
        EMC_TRAJ_SET_TELEOP_ENABLE m;
        m.enable = on;
        give(m);
    }
    void home(int joint) { EMC_JOINT_HOME m; m.joint = joint; give(m); }
    void unhome(int joint) { EMC_JOINT_UNHOME m; m.joint = joint; give(m); }
    void jog_stop(int nr, bool joint) { EMC_JOG_STOP m; m.joint_or_axis = nr; m.jjogmode = joint; give(m); }
    void jog_cont(int nr, double speed, bool joint) {
        EMC_JOG_CONT m;
        m.joint_or_axis = nr;
        m.vel = speed / 60;
        m.jjogmode = joint;
        give(m);
    }
    void jog_incr(int nr, double increment, double speed, bool joint) {
        EMC_JOG_INCR m;
        m.joint_or_axis = nr;
        m.incr = increment;
        m.vel = speed / 60;
        m.jjogmode = joint;
        give(m);
    }
    void spindle_start(int n, int direction) {
        double speed = std::fabs(stat_.task.activeSettings[2]);
        EMC_SPINDLE_ON m;
        m.spindle = n;
        m.speed = direction * (speed > 0 ? speed : 1);
        give(m);
    }

    int comp_ = -1;
    std::unique_ptr<EmcClient> client_;
    std::string nml_file_;
    EMC_STAT stat_;
    bool tools_ = false;

    // INI
    double max_feed_override_ = 1, min_spindle_override_ = 0, max_spindle_override_ = 1;
    double highest_velocity_ = 1e99; // units per second
    int joints_ = 3, spindles_ = 1, axis_mask_ = 0;
    bool home_all_exists_ = false;
    std::vector<std::string> mdi_commands_;

    // inputs
    Bit on_, off_, estop_activate_, estop_reset_, manual_, auto_, mdi_mode_, teleop_, joint_mode_, mist_on_, mist_off_,
        flood_on_, flood_off_;
    Bit run_, pause_, resume_, step_, program_stop_, abort_, optional_on_, optional_off_, delete_on_, delete_off_,
        home_all_;
    Override max_velocity_, feed_, rapid_;
    struct Spindle {
        Override override;
        Bit start, forward, reverse, stop, increase, decrease, brake_on, brake_off;
        hal_bit_t **is_on, **runs_forward, **runs_backward, **brake_is_on;
    };
    std::vector<Spindle> spindle_;
    std::vector<Bit> joint_home_, joint_unhome_, joint_select_, axis_select_, mdi_;
    Bit selected_home_, selected_unhome_;
    std::vector<Jog> joint_jog_, axis_jog_;
    Jog joint_selected_jog_, axis_selected_jog_;
    Real joint_speed_, joint_deadband_, axis_speed_, axis_deadband_;

    // outputs
    hal_float_t **units_per_mm_ = nullptr;
    hal_bit_t **is_on_, **is_estop_, **is_manual_, **is_auto_, **is_mdi_, **is_teleop_, **is_joint_, **is_mist_,
        **is_flood_;
    hal_bit_t **is_idle_, **is_running_, **is_paused_, **optional_is_on_, **delete_is_on_, **mdi_running_ = nullptr;
    std::vector<JointLamps> joint_lamps_;
    JointLamps selected_lamps_;
    std::vector<hal_bit_t **> joint_is_selected_, axis_is_selected_;
    hal_u32_t **joint_selected_, **axis_selected_, **tool_number_;
    std::vector<RealOut> pos_commanded_, pos_feedback_, pos_relative_, tool_offset_;
    hal_float_t **tool_diameter_;
    int remembered_mode_ = 0; // while MDI commands run
    int64_t writers_due_ = 0;
};

bool Halui::read_ini(const std::string &file) {
    linuxcnc::IniFile ini;
    if (!ini.open(file)) return false;
    set_rcs_print(ini);
    nml_file_ = ini.findStringV("NML_FILE", "EMC", "");
    auto positive = [&](const char *name, double *v) {
        if (auto r = ini.findReal(name, "DISPLAY"); r && *r > 0) *v = *r;
    };
    positive("MAX_FEED_OVERRIDE", &max_feed_override_);
    positive("MIN_SPINDLE_OVERRIDE", &min_spindle_override_);
    positive("MAX_SPINDLE_OVERRIDE", &max_spindle_override_);
    if (auto r = ini.findReal("MAX_LINEAR_VELOCITY", "TRAJ"); r && *r > 0) highest_velocity_ = *r;
    std::string coordinates = ini.findStringV("COORDINATES", "TRAJ", "");
    for (char c : coordinates)
        for (int i = 0; i < EMCMOT_MAX_AXIS; i++)
            if (tolower(static_cast<unsigned char>(c)) == AXES[i]) axis_mask_ |= 1 << i;
    if (axis_mask_ == 0) {
        fprintf(stderr, "halui: no [TRAJ]COORDINATES specified, enabling all axes\n");
        axis_mask_ = 0x1ff;
    }
    joints_ = std::clamp(ini.findIntV("JOINTS", "KINS", 3), 0, EMCMOT_MAX_JOINTS);
    spindles_ = std::clamp(ini.findIntV("SPINDLES", "TRAJ", 1), 0, EMCMOT_MAX_SPINDLES);
    home_all_exists_ = ini.isSet("HOME_SEQUENCE", "JOINT_0");
    mdi_commands_ = ini.findStringAll("MDI_COMMAND", "HALUI");
    if (mdi_commands_.size() > MAX_MDI) mdi_commands_.resize(MAX_MDI);
    return true;
}

bool Halui::connect() {
    verbose_nml_error_messages = 0;
    for (double waited = 0;; waited += 1.0) {
        client_ = std::make_unique<EmcClient>(nml_file_);
        if (client_->valid()) break;
        if (waited >= CONNECT_PATIENCE_S) {
            fprintf(stderr, "halui: can't connect to emc\n");
            return false;
        }
        kerf_clock_sleep_ns(1'000'000'000);
    }
    return true;
}

bool Halui::create() {
    comp_ = hal_init("halui");
    if (comp_ < 0) return false;
    Pins p(comp_);
    units_per_mm_ = p.out_real("halui.machine.units-per-mm");
    is_on_ = p.out("halui.machine.is-on");
    is_estop_ = p.out("halui.estop.is-activated");
    is_manual_ = p.out("halui.mode.is-manual");
    is_auto_ = p.out("halui.mode.is-auto");
    is_mdi_ = p.out("halui.mode.is-mdi");
    is_teleop_ = p.out("halui.mode.is-teleop");
    is_joint_ = p.out("halui.mode.is-joint");
    is_mist_ = p.out("halui.mist.is-on");
    is_flood_ = p.out("halui.flood.is-on");
    is_idle_ = p.out("halui.program.is-idle");
    is_running_ = p.out("halui.program.is-running");
    is_paused_ = p.out("halui.program.is-paused");
    optional_is_on_ = p.out("halui.program.optional-stop.is-on");
    delete_is_on_ = p.out("halui.program.block-delete.is-on");
    if (!mdi_commands_.empty()) mdi_running_ = p.out("halui.halui-mdi-is-running");
    tool_number_ = p.out_u32("halui.tool.number");
    tool_diameter_ = p.out_real("halui.tool.diameter");
    for (int i = 0; i < EMCMOT_MAX_AXIS; i++)
        tool_offset_.push_back({p.out_real(std::string("halui.tool.length_offset.") + AXES[i])});

    on_ = p.in_bit("halui.machine.on");
    off_ = p.in_bit("halui.machine.off");
    estop_activate_ = p.in_bit("halui.estop.activate");
    estop_reset_ = p.in_bit("halui.estop.reset");
    manual_ = p.in_bit("halui.mode.manual");
    auto_ = p.in_bit("halui.mode.auto");
    mdi_mode_ = p.in_bit("halui.mode.mdi");
    teleop_ = p.in_bit("halui.mode.teleop");
    joint_mode_ = p.in_bit("halui.mode.joint");
    mist_on_ = p.in_bit("halui.mist.on");
    mist_off_ = p.in_bit("halui.mist.off");
    flood_on_ = p.in_bit("halui.flood.on");
    flood_off_ = p.in_bit("halui.flood.off");
    run_ = p.in_bit("halui.program.run");
    pause_ = p.in_bit("halui.program.pause");
    resume_ = p.in_bit("halui.program.resume");
    step_ = p.in_bit("halui.program.step");
    program_stop_ = p.in_bit("halui.program.stop");
    abort_ = p.in_bit("halui.abort");
    optional_on_ = p.in_bit("halui.program.optional-stop.on");
    optional_off_ = p.in_bit("halui.program.optional-stop.off");
    delete_on_ = p.in_bit("halui.program.block-delete.on");
    delete_off_ = p.in_bit("halui.program.block-delete.off");
    if (home_all_exists_) home_all_ = p.in_bit("halui.home-all");
    max_velocity_.create(p, "halui.max-velocity", 0, false);
    feed_.create(p, "halui.feed-override", 0.1, true);
    rapid_.create(p, "halui.rapid-override", 0.1, true);
    for (int n = 0; n < spindles_; n++) {
        std::string name = "halui.spindle." + std::to_string(n);
        Spindle s;
        s.override.create(p, name + ".override", 0.1, true);
        const char *c = name.c_str();
        s.start = p.in_bit("%s.start", c);
        s.forward = p.in_bit("%s.forward", c);
        s.reverse = p.in_bit("%s.reverse", c);
        s.stop = p.in_bit("%s.stop", c);
        s.increase = p.in_bit("%s.increase", c);
        s.decrease = p.in_bit("%s.decrease", c);
        s.brake_on = p.in_bit("%s.brake-on", c);
        s.brake_off = p.in_bit("%s.brake-off", c);
        s.is_on = p.out(name + ".is-on");
        s.runs_forward = p.out(name + ".runs-forward");
        s.runs_backward = p.out(name + ".runs-backward");
        s.brake_is_on = p.out(name + ".brake-is-on");
        spindle_.push_back(s);
    }
    for (int n = 0; n < joints_; n++) {
        std::string name = "halui.joint." + std::to_string(n);
        JointLamps lamps;
        lamps.create(p, name);
        joint_lamps_.push_back(lamps);
        joint_is_selected_.push_back(p.out(name + ".is-selected"));
        joint_home_.push_back(p.in_bit("%s.home", name.c_str()));
        joint_unhome_.push_back(p.in_bit("%s.unhome", name.c_str()));
        joint_select_.push_back(p.in_bit("%s.select", name.c_str()));
        Jog j;
        j.create(p, name, true);
        joint_jog_.push_back(j);
    }
    selected_lamps_.create(p, "halui.joint.selected");
    selected_home_ = p.in_bit("halui.joint.selected.home");
    selected_unhome_ = p.in_bit("halui.joint.selected.unhome");
    joint_selected_jog_.create(p, "halui.joint.selected", false);
    joint_selected_ = p.out_u32("halui.joint.selected");
    joint_speed_ = p.in_real("halui.joint.jog-speed");
    joint_deadband_ = p.in_real("halui.joint.jog-deadband", 0.2);
    for (int i = 0; i < EMCMOT_MAX_AXIS; i++) {
        std::string name = std::string("halui.axis.") + AXES[i];
        bool present = axis_mask_ & (1 << i);
        pos_commanded_.push_back({present ? p.out_real(name + ".pos-commanded") : nullptr});
        pos_feedback_.push_back({present ? p.out_real(name + ".pos-feedback") : nullptr});
        pos_relative_.push_back({present ? p.out_real(name + ".pos-relative") : nullptr});
        axis_is_selected_.push_back(present ? p.out(name + ".is-selected") : nullptr);
        axis_select_.push_back(p.in_bit("%s.select", name.c_str()));
        Jog j;
        j.create(p, name, true);
        axis_jog_.push_back(j);
    }
    axis_selected_jog_.create(p, "halui.axis.selected", false);
    axis_selected_ = p.out_u32("halui.axis.selected");
    axis_speed_ = p.in_real("halui.axis.jog-speed");
    axis_deadband_ = p.in_real("halui.axis.jog-deadband", 0.2);
    for (size_t n = 0; n < mdi_commands_.size(); n++) mdi_.push_back(p.in_bit("halui.mdi-command-%02zu", n));
    if (!p.good()) {
        fprintf(stderr, "halui: can't make the HAL pins\n");
        return false;
    }
    if (joints_ > 0) **joint_is_selected_[0] = 1;
    for (int i = 0; i < EMCMOT_MAX_AXIS; i++)
        if (axis_is_selected_[static_cast<size_t>(i)]) {
            **axis_is_selected_[static_cast<size_t>(i)] = 1;
            break;
        }
    return hal_ready(comp_) == 0;
}

// ---- inputs ----

// Of two buttons at once the one that stops acts.
void Halui::commands() {
    const bool on = on_.rose(), off = off_.rose(), activate = estop_activate_.rose_or_came(),
               reset = estop_reset_.rose();
    if (off) set_state(EMC_TASK_STATE_OFF);
    else if (on) set_state(EMC_TASK_STATE_ON);
    if (activate) set_state(EMC_TASK_STATE_ESTOP);
    else if (reset) set_state(EMC_TASK_STATE_ESTOP_RESET);
    if (manual_.rose()) set_mode(EMC_TASK_MODE_MANUAL);
    if (auto_.rose()) set_mode(EMC_TASK_MODE_AUTO);
    if (mdi_mode_.rose()) set_mode(EMC_TASK_MODE_MDI);
    if (teleop_.rose()) teleop(1);
    if (joint_mode_.rose()) teleop(0);
    if (mist_on_.rose()) plain<EMC_COOLANT_MIST_ON>();
    if (mist_off_.rose()) plain<EMC_COOLANT_MIST_OFF>();
    if (flood_on_.rose()) plain<EMC_COOLANT_FLOOD_ON>();
    if (flood_off_.rose()) plain<EMC_COOLANT_FLOOD_OFF>();
    const bool run = run_.rose(), pause = pause_.rose(), resume = resume_.rose(), step = step_.rose(),
               program_stop = program_stop_.rose(), abort = abort_.rose();
    if (program_stop || abort) {
        plain<EMC_TASK_ABORT>();
    } else {
        if (run && stat_.task.file[0]) {
            set_mode(EMC_TASK_MODE_AUTO);
            plain<EMC_TASK_PLAN_RUN>();
        }
        if (pause) plain<EMC_TASK_PLAN_PAUSE>();
        else if (resume) plain<EMC_TASK_PLAN_RESUME>();
        else if (step) plain<EMC_TASK_PLAN_STEP>();
    }
    auto optional = [&](bool on) { EMC_TASK_PLAN_SET_OPTIONAL_STOP m; m.state = on; give(m); };
    if (optional_on_.rose()) optional(true);
    if (optional_off_.rose()) optional(false);
    auto block_delete = [&](bool on) { EMC_TASK_PLAN_SET_BLOCK_DELETE m; m.state = on; give(m); };
    if (delete_on_.rose()) block_delete(true);
    if (delete_off_.rose()) block_delete(false);

    double v;
    if (max_velocity_.wanted(stat_.motion.traj.maxVelocity, 0, highest_velocity_, &v)) {
        EMC_TRAJ_SET_MAX_VELOCITY m;
        m.velocity = v;
        give(m);
    }
    if (feed_.wanted(stat_.motion.traj.scale, 0, max_feed_override_, &v)) {
        EMC_TRAJ_SET_SCALE m;
        m.scale = v;
        give(m);
    }
    if (rapid_.wanted(stat_.motion.traj.rapid_scale, 0, 1.0, &v)) { EMC_TRAJ_SET_RAPID_SCALE m; m.scale = v; give(m); }
    for (int n = 0; n < spindles_; n++) {
        Spindle &s = spindle_[static_cast<size_t>(n)];
        if (s.override.wanted(stat_.motion.spindle[n].spindle_scale, min_spindle_override_, max_spindle_override_,
                              &v)) {
            EMC_TRAJ_SET_SPINDLE_SCALE m;
            m.spindle = n;
            m.scale = v;
            give(m);
        }
        const bool start = s.start.rose(), forward = s.forward.rose(), reverse = s.reverse.rose();
        if (s.stop.rose()) { EMC_SPINDLE_OFF m; m.spindle = n; give(m); }
        else if ((start || forward) != reverse) spindle_start(n, reverse ? -1 : 1);
        auto constant = [&] {
            if (stat_.task.state != EMC_TASK_STATE_ON) return; // no speed changes any more
            EMC_SPINDLE_CONSTANT m;
            m.spindle = n;
            give(m);
        };
        if (int e = s.increase.edge()) {
            if (e > 0) {
                EMC_SPINDLE_INCREASE m;
                m.spindle = n;
                give(m);
            } else constant();
        }
        if (int e = s.decrease.edge()) {
            if (e > 0) {
                EMC_SPINDLE_DECREASE m;
                m.spindle = n;
                give(m);
            } else constant();
        }
        const bool release_brake = s.brake_off.rose();
        if (s.brake_on.rose()) { EMC_SPINDLE_BRAKE_ENGAGE m; m.spindle = n; give(m); }
        else if (release_brake) { EMC_SPINDLE_BRAKE_RELEASE m; m.spindle = n; give(m); }
    }
    if (home_all_exists_ && home_all_.rose()) home(-1);
    for (int n = 0; n < joints_; n++) {
        if (joint_home_[static_cast<size_t>(n)].rose()) home(n);
        if (joint_unhome_[static_cast<size_t>(n)].rose()) unhome(n);
    }
    if (selected_home_.rose()) home(static_cast<int>(**joint_selected_));
    if (selected_unhome_.rose()) unhome(static_cast<int>(**joint_selected_));
}

void Halui::hold(Jog &j, int n, const char *pin, double way, double speed, bool joints) {
    if (pin) {
        j.holder = j.name + pin;
        j.driven = has_writer(j.holder);
    }
    if (!std::isfinite(way * speed)) jog_stop(n, joints); // task refuses the new speed and says why
    jog_cont(n, speed * way, joints);
    refresh();
    j.way = way;
    j.began = stat_.motion.heartbeat;
}

// A panel whose program has ended, or was killed, can not let go of its buttons.
void Halui::let_go_undriven() {
    if (kerf_clock_now_ns() < writers_due_) return;
    writers_due_ = kerf_clock_now_ns() + WRITERS_NS;
    bool looked = false;
    auto look = [&](Jog &j, int n, bool joints) {
        if (j.way == 0 || !j.driven) return;
        if (!looked) { // takes away what killed processes left in HAL
            hal_query_t q{};
            hal_list_comp(&q, [](hal_query_t *, void *) { return 1; }, nullptr);
            looked = true;
        }
        if (has_writer(j.holder)) return;
        let_go(j, n, joints);
        j.centred = false;
    };
    for (size_t n = 0; n < joint_jog_.size(); n++) look(joint_jog_[n], static_cast<int>(n), true);
    for (size_t n = 0; n < axis_jog_.size(); n++) look(axis_jog_[n], static_cast<int>(n), false);
    look(joint_selected_jog_, static_cast<int>(**joint_selected_), true);
    look(axis_selected_jog_, static_cast<int>(**axis_selected_), false);
}

void Halui::let_go(Jog &j, int n, bool joints) {
    j.way = 0;
    jog_stop(n, joints);
}

// Whether the jog of these pins is over though they may be held: by an abort, a limit, another program.
bool Halui::ended(const Jog &j) const {
    constexpr uint64_t CYCLES = 10; // until the status shows a new jog
    return !stat_.motion.jogging_active && stat_.motion.heartbeat > j.began + CYCLES;
}

// A jog begins with a press of its button, or with a joystick that leaves the dead band. Whatever ends it (an abort,
// the machine off, another mode), a button that is still held and a change of jog-speed do not begin it again.
void Halui::jog_group(std::vector<Jog> &all, Jog &selected, hal_u32_t **number, Real &speed, Real &deadband,
                      bool joints, std::vector<Bit> &select, std::vector<hal_bit_t **> &lamps,
                      const std::vector<int> &present) {
    int current = static_cast<int>(**number);
    bool active =
        joints ? stat_.motion.traj.mode != EMC_TRAJ_MODE_TELEOP : stat_.motion.traj.mode == EMC_TRAJ_MODE_TELEOP;
    active = active && jogs_possible();
    auto forget_if_over = [&](Jog &j) {
        if (j.way == 0 || (active && !ended(j))) return;
        j.way = 0;
        j.centred = false;
    };
    for (int n : present) forget_if_over(all[static_cast<size_t>(n)]);
    forget_if_over(selected);
    for (int n : present) {
        if (!select[static_cast<size_t>(n)].rose()) continue;
        **number = static_cast<rtapi_u32>(n);
        for (int k : present) **lamps[static_cast<size_t>(k)] = k == n;
        if (selected.way != 0) { // the button stays down: the jog goes over to the new one
            for (int k : present)
                if (k != n && all[static_cast<size_t>(k)].way == 0) jog_stop(k, joints);
            if (n != current) hold(selected, n, nullptr, selected.way, speed.now(), joints);
        }
        current = n;
    }
    bool faster = speed.changed();
    auto one = [&](Jog &j, int n) {
        int plus = j.plus.edge(), minus = j.minus.edge(), inc_plus = j.increment_plus.edge(),
            inc_minus = j.increment_minus.edge();
        bool turned = false, moves = false;
        if (j.has_analog) {
            if (j.analog.relinked()) j.centred = false;
            const double before = j.analog.old;
            turned = j.analog.changed();
            moves = j.analog.now() != 0 && std::fabs(j.analog.now()) > deadband.now();
            if (!active) j.centred = false;
            if (!moves || before * j.analog.now() < 0) j.centred = true;
        }
        if (!active) return;
        if (plus > 0 && minus <= 0) hold(j, n, ".plus", 1, speed.now(), joints);
        else if (minus > 0 && plus <= 0) hold(j, n, ".minus", -1, speed.now(), joints);
        else if (plus != 0 || minus != 0) let_go(j, n, joints);
        else if (turned && moves && j.centred) hold(j, n, ".analog", j.analog.now(), speed.now(), joints);
        else if (turned && !moves) let_go(j, n, joints);
        else if (faster && j.way != 0) hold(j, n, nullptr, j.way, speed.now(), joints);
        if (inc_plus > 0 && inc_minus <= 0) jog_incr(n, j.increment.now(), speed.now(), joints);
        if (inc_minus > 0 && inc_plus <= 0) jog_incr(n, -j.increment.now(), speed.now(), joints);
    };
    for (int n : present) one(all[static_cast<size_t>(n)], n);
    one(selected, current);
}

void Halui::jogs() {
    let_go_undriven();
    std::vector<int> joints, axes;
    for (int n = 0; n < joints_; n++) joints.push_back(n);
    for (int i = 0; i < EMCMOT_MAX_AXIS; i++)
        if (axis_mask_ & (1 << i)) axes.push_back(i);
    jog_group(joint_jog_, joint_selected_jog_, joint_selected_, joint_speed_, joint_deadband_, true, joint_select_,
              joint_is_selected_, joints);
    jog_group(axis_jog_, axis_selected_jog_, axis_selected_, axis_speed_, axis_deadband_, false, axis_select_,
              axis_is_selected_, axes);
}

void Halui::mdi() {
    const bool may =
        stat_.control_pid == 0 || stat_.control_pid == getpid(); // else task refuses it, and tells the operator
    for (size_t n = 0; n < mdi_.size(); n++) {
        if (!mdi_[n].rose()) continue;
        EMC_TASK_PLAN_EXECUTE m;
        if (mdi_commands_[n].size() >= sizeof m.command) {
            EMC_OPERATOR_ERROR text;
            copy_text(text.error, ("[HALUI]MDI_COMMAND " + std::to_string(n) +
                                   " is not executed: it is longer than 254 characters").c_str());
            give(text);
            return;
        }
        if (may && !**mdi_running_) {
            remembered_mode_ = stat_.task.mode;
            **mdi_running_ = 1;
        }
        if (may) set_mode(EMC_TASK_MODE_MDI);
        copy_text(m.command, mdi_commands_[n].c_str());
        give(m);
        refresh();
        return; // one a loop: the status of this one must be seen before it may look done
    }
    if (may && mdi_running_ && **mdi_running_ && stat_.status == RCS_DONE) {
        // who has chosen another mode meanwhile keeps it
        if (stat_.task.mode == EMC_TASK_MODE_MDI) set_mode(remembered_mode_);
        **mdi_running_ = 0;
    }
}

// ---- outputs ----

void Halui::show() {
    const EMC_TASK_STAT &t = stat_.task;
    const EMC_TRAJ_STAT &traj = stat_.motion.traj;
    if (**units_per_mm_ == 0 && traj.linearUnits != 0) **units_per_mm_ = traj.linearUnits;
    **is_on_ = t.state == EMC_TASK_STATE_ON;
    **is_estop_ = t.state == EMC_TASK_STATE_ESTOP;
    **is_manual_ = t.mode == EMC_TASK_MODE_MANUAL;
    **is_auto_ = t.mode == EMC_TASK_MODE_AUTO;
    **is_mdi_ = t.mode == EMC_TASK_MODE_MDI;
    **is_teleop_ = traj.mode == EMC_TRAJ_MODE_TELEOP;
    **is_joint_ = traj.mode == EMC_TRAJ_MODE_FREE;
    **is_mist_ = stat_.io.coolant.mist != 0;
    **is_flood_ = stat_.io.coolant.flood != 0;
    **is_idle_ = t.interpState == EMC_TASK_INTERP_IDLE;
    **is_running_ = t.interpState == EMC_TASK_INTERP_READING || t.interpState == EMC_TASK_INTERP_WAITING;
    **is_paused_ = t.interpState == EMC_TASK_INTERP_PAUSED;
    **optional_is_on_ = t.optional_stop_state;
    **delete_is_on_ = t.block_delete_state;
    **max_velocity_.value = traj.maxVelocity;
    **feed_.value = traj.scale;
    **rapid_.value = traj.rapid_scale;
    for (int n = 0; n < spindles_; n++) {
        const EMC_SPINDLE_STAT &from = stat_.motion.spindle[n];
        Spindle &s = spindle_[static_cast<size_t>(n)];
        **s.override.value = from.spindle_scale;
        **s.is_on = from.enabled != 0;
        **s.runs_forward = from.direction == 1;
        **s.runs_backward = from.direction == -1;
        **s.brake_is_on = from.brake != 0;
    }
    for (int n = 0; n < joints_; n++) joint_lamps_[static_cast<size_t>(n)].show(stat_.motion.joint[n]);
    if (**joint_selected_ < EMCMOT_MAX_JOINTS) selected_lamps_.show(stat_.motion.joint[**joint_selected_]);

    auto nine = [](const EmcPose &p) {
        return std::vector<double>{p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w};
    };
    std::vector<double> cmd = nine(traj.position), act = nine(traj.actualPosition), g5x = nine(t.g5x_offset),
                        g92 = nine(t.g92_offset), tool = nine(t.toolOffset);
    double x = act[0] - g5x[0] - tool[0], y = act[1] - g5x[1] - tool[1], a = -t.rotation_xy * M_PI / 180;
    for (size_t i = 0; i < EMCMOT_MAX_AXIS; i++) {
        tool_offset_[i].set(tool[i]);
        if (!pos_commanded_[i].pin) continue;
        pos_commanded_[i].set(cmd[i]);
        pos_feedback_[i].set(act[i]);
        double rel = i == 0   ? x * std::cos(a) - y * std::sin(a)
                     : i == 1 ? x * std::sin(a) + y * std::cos(a)
                              : act[i] - g5x[i] - tool[i];
        pos_relative_[i].set(rel - g92[i]);
    }
    int number = stat_.io.tool.toolInSpindle;
    **tool_number_ = static_cast<rtapi_u32>(number);
    if (number == 0) **tool_diameter_ = 0;
    else if (tools_) {
        for (int i = 0; i <= tooldata_last_index_get(); i++) {
            CANON_TOOL_TABLE rec;
            if (tooldata_get(&rec, i) == IDX_OK && rec.toolno == number) {
                **tool_diameter_ = rec.diameter;
                break;
            }
        }
    }
}

void Halui::run() {
    tools_ = tool_mmap_user() == 0;
    while (!stop) {
        refresh();
        commands();
        jogs();
        mdi();
        refresh();
        show();
        kerf_clock_sleep_ns(PERIOD_NS);
    }
    release();
}

// Nobody is left to let go of the buttons: what they keep moving stops.
void Halui::release() {
    auto all = [&](std::vector<Jog> &jogs, const Jog &selected, hal_u32_t **number, bool joints) {
        for (size_t n = 0; n < jogs.size(); n++)
            if (jogs[n].way != 0 || (selected.way != 0 && **number == n)) jog_stop(static_cast<int>(n), joints);
    };
    refresh();
    if (!jogs_possible()) return;
    all(axis_jog_, axis_selected_jog_, axis_selected_, false);
    all(joint_jog_, joint_selected_jog_, joint_selected_, true);
}

} // namespace

int main(int argc, char **argv) {
    EmcArgs args(argc, argv);
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    kerf_clock_join("halui", KERF_CLOCK_PRIO_USER);
    int result = 1;
    {
        Halui halui;
        if (!halui.read_ini(args.ini_file)) result = 2;
        else if (halui.create() && halui.connect()) {
            halui.run();
            result = 0;
        }
    }
    kerf_clock_leave();
    return result;
}
