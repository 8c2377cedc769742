// SPDX-License-Identifier: GPL-2.0-or-later
//
// ini_settings.cc - see ini_settings.hh.
#include "ini_settings.hh"

#include <strings.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

#include "rcs_print.hh"

int word_of(const linuxcnc::IniFile &ini, const char *section, const char *name, int standard,
            std::initializer_list<const char *> words) {
    const std::string value = ini.findStringV(name, section, "");
    if (value.empty()) return standard;
    int n = 0;
    std::string all;
    for (const char *w : words) {
        if (strcasecmp(value.c_str(), w) == 0) return n;
        n++;
        all += std::string(all.empty() ? "" : ", ") + w;
    }
    rcs_print_error("[%s]%s = %s: it must be one of %s\n", section, name, value.c_str(), all.c_str());
    return -1;
}

namespace {

const char AXES[] = "XYZABCUVW";

// Sends, and tells which call failed.
struct Sender {
    int failed = 0;
    void operator()(int r) { if (r != 0) failed = r; }
};

int axis_mask_of(const std::string &coordinates) {
    int mask = 0;
    for (char c : coordinates)
        for (int i = 0; i < EMCMOT_MAX_AXIS; i++)
            if (toupper(static_cast<unsigned char>(c)) == AXES[i]) mask |= 1 << i;
    return mask;
}

bool read_home(const linuxcnc::IniFile &ini, EmcPose *home, bool *present) {
    auto text = ini.findString("HOME", "TRAJ");
    *present = text.has_value();
    if (!text) return true;
    double v[EMCMOT_MAX_AXIS] = {};
    std::istringstream in(*text);
    std::string word;
    for (size_t n = 0; in >> word; n++) {
        if (n >= EMCMOT_MAX_AXIS) {
            rcs_print("Value for invalid axis number %zu cannot be part of homePose\n", n);
            return false;
        }
        char *end;
        v[n] = strtod(word.c_str(), &end);
        if (*end || end == word.c_str()) {
            rcs_print("Invalid value '%s' for axis %zu in homePose\n", word.c_str(), n);
            return false;
        }
    }
    home->tran.x = v[0]; home->tran.y = v[1]; home->tran.z = v[2];
    home->a = v[3]; home->b = v[4]; home->c = v[5];
    home->u = v[6]; home->v = v[7]; home->w = v[8];
    return true;
}

int send_arc_blends(const Settings &s, MotionLink &m) {
    return m.set_arc_blends(s.arc_blend, s.arc_blend_fallback, s.arc_blend_depth,
                            static_cast<int>(s.arc_blend_gap_cycles), s.arc_blend_ramp_freq, s.arc_blend_kink_ratio);
}

int load_traj(const linuxcnc::IniFile &ini, EMC_STAT &stat, MotionLink &motion, Settings &s) {
    EMC_TRAJ_STAT &t = stat.motion.traj;
    Sender send;
    if (motion.set_joints(ini.findIntV("JOINTS", "KINS", 0)) != 0) return -1;
    if (motion.set_spindles(ini.findIntV("SPINDLES", "TRAJ", 1)) != 0) return -1;
    t.axis_mask = axis_mask_of(ini.findStringV("COORDINATES", "TRAJ", "XYZ"));
    auto linear = ini.findLinearUnits("LINEAR_UNITS", "TRAJ");
    auto angular = ini.findAngularUnits("ANGULAR_UNITS", "TRAJ");
    if (!linear || !angular || *linear <= 0 || *angular <= 0) {
        rcs_print("emcTrajSetUnits failed to set [TRAJ]LINEAR_UNITS or [TRAJ]ANGULAR_UNITS\n");
        return -1;
    }
    t.linearUnits = *linear;
    t.angularUnits = *angular;
    s.default_velocity = ini.findRealV("DEFAULT_LINEAR_VELOCITY", "TRAJ", 1.0);
    s.max_velocity = ini.findRealV("MAX_LINEAR_VELOCITY", "TRAJ", 1e99);
    s.default_acceleration = ini.findRealV("DEFAULT_LINEAR_ACCELERATION", "TRAJ", 1e99);
    s.max_acceleration = ini.findRealV("MAX_LINEAR_ACCELERATION", "TRAJ", 1e99);
    s.max_jerk = ini.findRealV("MAX_LINEAR_JERK", "TRAJ", 1e9);
    send(motion.set_velocity(0, s.default_velocity));
    send(motion.set_max_velocity(s.max_velocity));
    send(motion.set_acceleration(s.default_acceleration));
    motion.max_traj_acceleration = std::max(0.0, s.max_acceleration);
    send(motion.set_jerk(s.max_jerk));
    s.planner_type = ini.findIntV("PLANNER_TYPE", "TRAJ", 0, 0, 1);
    s.smooth_planner = ini.findIntV("SMOOTH_PLANNER", "TRAJ", s.planner_type > 0 ? s.planner_type : 1, 0, 1);
    if (s.max_jerk < 1) {
        s.smooth_planner = 0;
        if (s.planner_type == 1)
            rcs_print("[TRAJ]PLANNER_TYPE = 1 (S-curve) requires [TRAJ]MAX_LINEAR_JERK >= 1.0 (got %g); using "
                      "trapezoidal planner\n",
                      s.max_jerk);
        s.planner_type = 0;
    }
    send(motion.set_planner_type(s.planner_type));
    s.scurve_peak_scale = ini.findRealV("SCURVE_PEAK_SCALE", "TRAJ", 1.0);
    send(motion.set_scurve_peak_scale(s.scurve_peak_scale));
    s.arc_blend = ini.findBoolV("ARC_BLEND_ENABLE", "TRAJ", true);
    s.arc_blend_fallback = ini.findBoolV("ARC_BLEND_FALLBACK_ENABLE", "TRAJ", false);
    s.arc_blend_depth = ini.findIntV("ARC_BLEND_OPTIMIZATION_DEPTH", "TRAJ", 50);
    s.arc_blend_gap_cycles = ini.findIntV("ARC_BLEND_GAP_CYCLES", "TRAJ", 4);
    s.arc_blend_ramp_freq = ini.findRealV("ARC_BLEND_RAMP_FREQ", "TRAJ", 100.0);
    s.arc_blend_kink_ratio = ini.findRealV("ARC_BLEND_KINK_RATIO", "TRAJ", 0.1);
    send(send_arc_blends(s, motion));
    send(motion.set_max_feed_override(ini.findRealV("MAX_FEED_OVERRIDE", "DISPLAY", 1.0)));
    const int feed_contact = word_of(ini, "TRAJ", "PROBE_CONTACT_FEED", PROBE_CONTACT_STOP, {"STOP", "WARN", "IGNORE"});
    const int rapid_contact =
        word_of(ini, "TRAJ", "PROBE_CONTACT_RAPID", PROBE_CONTACT_STOP, {"STOP", "WARN", "IGNORE"});
    if (feed_contact < 0 || rapid_contact < 0) return -1;
    send(motion.set_probe_errors(ini.findBoolV("NO_PROBE_JOG_ERROR", "TRAJ", false),
                                 ini.findBoolV("NO_PROBE_HOME_ERROR", "TRAJ", false), feed_contact, rapid_contact,
                                 ini.findRealV("PROBE_CONTACT_FILTER", "TRAJ", 0.0, 0.0, 10.0)));
    EmcPose home{};
    bool present;
    if (!read_home(ini, &home, &present)) return -1;
    if (present) send(motion.set_home(home));
    s.no_force_homing = ini.findBoolV("NO_FORCE_HOMING", "TRAJ", false);
    s.position_file = ini.findStringV("POSITION_FILE", "TRAJ", "");
    return send.failed;
}

int load_joint(int n, const linuxcnc::IniFile &ini, EMC_STAT &stat, MotionLink &motion, Settings::Joint &s) {
    std::string sec = "JOINT_" + std::to_string(n);
    Sender send;
    EMC_JOINT_STAT &j = stat.motion.joint[n];
    j.joint = n;
    j.jointType = static_cast<unsigned char>(ini.findJointType("TYPE", sec).value_or(EMC_LINEAR));
    j.units = j.jointType == EMC_LINEAR ? stat.motion.traj.linearUnits : stat.motion.traj.angularUnits;
    s.backlash = ini.findRealV("BACKLASH", sec, 0);
    send(motion.set_joint_backlash(n, s.backlash));
    s.min_limit = ini.findRealV("MIN_LIMIT", sec, -1e99);
    send(motion.set_joint_min_limit(n, s.min_limit));
    s.max_limit = ini.findRealV("MAX_LIMIT", sec, 1e99);
    send(motion.set_joint_max_limit(n, s.max_limit));
    s.ferror = ini.findRealV("FERROR", sec, 1.0);
    send(motion.set_joint_ferror(n, s.ferror));
    s.min_ferror = ini.findRealV("MIN_FERROR", sec, s.ferror);
    send(motion.set_joint_min_ferror(n, s.min_ferror));
    EMC_JOINT_SET_HOMING_PARAMS h;
    h.joint = n;
    h.home = s.home = ini.findRealV("HOME", sec, 0);
    h.offset = s.home_offset = ini.findRealV("HOME_OFFSET", sec, 0);
    h.search_vel = ini.findRealV("HOME_SEARCH_VEL", sec, 0);
    h.latch_vel = ini.findRealV("HOME_LATCH_VEL", sec, 0);
    h.home_final_vel = ini.findRealV("HOME_FINAL_VEL", sec, -1);
    h.is_shared = ini.findBoolV("HOME_IS_SHARED", sec, false);
    h.use_index = ini.findBoolV("HOME_USE_INDEX", sec, false);
    h.encoder_does_not_reset = ini.findBoolV("HOME_INDEX_NO_ENCODER_RESET", sec, false);
    h.ignore_limits = ini.findBoolV("HOME_IGNORE_LIMITS", sec, false);
    h.home_sequence = s.home_sequence = ini.findIntV("HOME_SEQUENCE", sec, 999);
    h.volatile_home = ini.findBoolV("VOLATILE_HOME", sec, false);
    h.locking_indexer = ini.findBoolV("LOCKING_INDEXER", sec, false);
    h.absolute_encoder = ini.findIntV("HOME_ABSOLUTE_ENCODER", sec, 0, 0, 2);
    send(motion.set_homing_params(h));
    s.max_velocity = ini.findRealV("MAX_VELOCITY", sec, 1.0);
    send(motion.set_joint_max_velocity(n, s.max_velocity));
    s.max_acceleration = ini.findRealV("MAX_ACCELERATION", sec, 1.0);
    send(motion.set_joint_max_acceleration(n, s.max_acceleration));
    s.max_jerk = ini.findRealV("MAX_JERK", sec, 0);
    send(motion.set_joint_max_jerk(n, s.max_jerk));
    if (auto comp = ini.findString("COMP_FILE", sec))
        send(motion.load_comp(n, comp->c_str(), ini.findIntV("COMP_FILE_TYPE", sec, 0, 0, 1)));
    send(motion.activate_joint(n));
    return send.failed;
}

int load_axis(int n, const linuxcnc::IniFile &ini, MotionLink &motion, Settings::Axis &s) {
    std::string sec = std::string("AXIS_") + AXES[n];
    Sender send;
    s.min_limit = ini.findRealV("MIN_LIMIT", sec, -1e99);
    send(motion.set_axis_min_limit(n, s.min_limit));
    s.max_limit = ini.findRealV("MAX_LIMIT", sec, 1e99);
    send(motion.set_axis_max_limit(n, s.max_limit));
    s.offset_ratio = ini.findRealV("OFFSET_AV_RATIO", sec, 0);
    if (s.offset_ratio < 0 || s.offset_ratio > 0.9) {
        rcs_print("\n   Invalid: [%s]OFFSET_AV_RATIO=%8.5f (range [0.0,%f]); using: [%s]OFFSET_AV_RATIO=%8.5f\n",
                  sec.c_str(), s.offset_ratio, 0.9, sec.c_str(), 0.1);
        s.offset_ratio = 0.1;
    }
    s.max_velocity = ini.findRealV("MAX_VELOCITY", sec, 1.0);
    send(motion.set_axis_max_velocity(n, s.max_velocity * (1 - s.offset_ratio), s.max_velocity * s.offset_ratio));
    s.max_acceleration = ini.findRealV("MAX_ACCELERATION", sec, 1.0);
    send(motion.set_axis_max_acceleration(n, s.max_acceleration * (1 - s.offset_ratio),
                                          s.max_acceleration * s.offset_ratio));
    send(motion.set_axis_locking_joint(n, ini.findIntV("LOCKING_INDEXER_JOINT", sec, -1)));
    s.max_jerk = ini.findRealV("MAX_JERK", sec, 0);
    send(motion.set_axis_max_jerk(n, s.max_jerk));
    return send.failed;
}

int load_spindle(int n, const linuxcnc::IniFile &ini, MotionLink &motion) {
    std::string sec = "SPINDLE_" + std::to_string(n);
    double max_forward = 1e99, min_forward = 0, min_reverse = 0, max_reverse = -1e99;
    if (auto v = ini.findReal("MAX_FORWARD_VELOCITY", sec)) { max_forward = *v; max_reverse = -*v; }
    if (auto v = ini.findReal("MIN_FORWARD_VELOCITY", sec)) { min_forward = *v; min_reverse = -*v; }
    if (auto v = ini.findReal("MIN_REVERSE_VELOCITY", sec)) min_reverse = -std::fabs(*v);
    if (auto v = ini.findReal("MAX_REVERSE_VELOCITY", sec)) max_reverse = -std::fabs(*v);
    return motion.set_spindle_params(n, max_forward, min_forward, max_reverse, min_reverse,
                                     ini.findRealV("HOME_SEARCH_VELOCITY", sec, 0), 0,
                                     ini.findIntV("HOME_SEQUENCE", sec, 0), ini.findRealV("INCREMENT", sec, 100));
}

} // namespace

int load_settings(const linuxcnc::IniFile &ini, EMC_STAT &stat, MotionLink &motion, Settings *s) {
    if (load_traj(ini, stat, motion, *s) != 0) return -1;
    for (int j = 0; j < stat.motion.traj.joints; j++)
        if (load_joint(j, ini, stat, motion, s->joint[j]) != 0) return -1;
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
        if ((stat.motion.traj.axis_mask & (1 << a)) && load_axis(a, ini, motion, s->axis[a]) != 0) return -1;
    for (int n = 0; n < stat.motion.traj.spindles; n++)
        if (load_spindle(n, ini, motion) != 0) return -1;
    if (!s->position_file.empty()) return motion.load_positions(s->position_file);
    return 0;
}

// ---- inihal ----

struct JointPins {
    hal_float_t *backlash, *ferror, *min_ferror, *min_limit, *max_limit, *max_velocity, *max_acceleration, *max_jerk,
        *home, *home_offset;
    hal_s32_t *home_sequence;
};
struct AxisPins { hal_float_t *min_limit, *max_limit, *max_velocity, *max_acceleration, *max_jerk; };

struct IniPins::Pins {
    JointPins joint[EMCMOT_MAX_JOINTS];
    AxisPins axis[EMCMOT_MAX_AXIS];
    hal_float_t *default_velocity, *max_velocity, *default_acceleration, *max_acceleration, *max_jerk, *peak_scale;
    hal_s32_t *planner_type;
    hal_bit_t *arc_blend, *arc_blend_fallback;
    hal_s32_t *arc_blend_depth;
    hal_float_t *gap_cycles, *ramp_freq, *kink_ratio;
};

IniPins::~IniPins() {
    if (comp_ >= 0) hal_exit(comp_);
}

bool IniPins::create(int joints) {
    joints_ = std::clamp(joints, 0, EMCMOT_MAX_JOINTS);
    comp_ = hal_init("inihal");
    if (comp_ < 0) return false;
    pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
    if (!pins_) return false;
    int r = 0;
    auto real = [&](hal_float_t **p, const std::string &name) {
        r |= hal_pin_float_newf(HAL_IN, p, comp_, "ini.%s", name.c_str());
    };
    for (int n = 0; n < joints_; n++) {
        JointPins &j = pins_->joint[n];
        std::string p = std::to_string(n) + ".";
        real(&j.backlash, p + "backlash");
        real(&j.ferror, p + "ferror");
        real(&j.min_ferror, p + "min_ferror");
        real(&j.min_limit, p + "min_limit");
        real(&j.max_limit, p + "max_limit");
        real(&j.max_velocity, p + "max_velocity");
        real(&j.max_acceleration, p + "max_acceleration");
        real(&j.max_jerk, p + "max_jerk");
        real(&j.home, p + "home");
        real(&j.home_offset, p + "home_offset");
        r |= hal_pin_s32_newf(HAL_IN, &j.home_sequence, comp_, "ini.%d.home_sequence", n);
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        AxisPins &a = pins_->axis[n];
        std::string p = std::string(1, static_cast<char>(tolower(AXES[n]))) + ".";
        real(&a.min_limit, p + "min_limit");
        real(&a.max_limit, p + "max_limit");
        real(&a.max_velocity, p + "max_velocity");
        real(&a.max_acceleration, p + "max_acceleration");
        real(&a.max_jerk, p + "max_jerk");
    }
    real(&pins_->default_velocity, "traj_default_velocity");
    real(&pins_->max_velocity, "traj_max_velocity");
    real(&pins_->default_acceleration, "traj_default_acceleration");
    real(&pins_->max_acceleration, "traj_max_acceleration");
    real(&pins_->max_jerk, "traj_max_jerk");
    real(&pins_->peak_scale, "traj_scurve_peak_scale");
    r |= hal_pin_s32_newf(HAL_IN, &pins_->planner_type, comp_, "ini.traj_planner_type");
    r |= hal_pin_bit_newf(HAL_IN, &pins_->arc_blend, comp_, "ini.traj_arc_blend_enable");
    r |= hal_pin_bit_newf(HAL_IN, &pins_->arc_blend_fallback, comp_, "ini.traj_arc_blend_fallback_enable");
    r |= hal_pin_s32_newf(HAL_IN, &pins_->arc_blend_depth, comp_, "ini.traj_arc_blend_optimization_depth");
    real(&pins_->gap_cycles, "traj_arc_blend_gap_cycles");
    real(&pins_->ramp_freq, "traj_arc_blend_ramp_freq");
    real(&pins_->kink_ratio, "traj_arc_blend_tangent_kink_ratio");
    return r == 0 && hal_ready(comp_) == 0;
}

void IniPins::show(const Settings &s) {
    for (int n = 0; n < joints_; n++) {
        const Settings::Joint &from = s.joint[n];
        JointPins &j = pins_->joint[n];
        *j.backlash = from.backlash;
        *j.ferror = from.ferror;
        *j.min_ferror = from.min_ferror;
        *j.min_limit = from.min_limit;
        *j.max_limit = from.max_limit;
        *j.max_velocity = from.max_velocity;
        *j.max_acceleration = from.max_acceleration;
        *j.max_jerk = from.max_jerk;
        *j.home = from.home;
        *j.home_offset = from.home_offset;
        *j.home_sequence = from.home_sequence;
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const Settings::Axis &from = s.axis[n];
        AxisPins &a = pins_->axis[n];
        *a.min_limit = from.min_limit;
        *a.max_limit = from.max_limit;
        *a.max_velocity = from.max_velocity;
        *a.max_acceleration = from.max_acceleration;
        *a.max_jerk = from.max_jerk;
    }
    *pins_->default_velocity = s.default_velocity;
    *pins_->max_velocity = s.max_velocity;
    *pins_->default_acceleration = s.default_acceleration;
    *pins_->max_acceleration = s.max_acceleration;
    *pins_->max_jerk = s.max_jerk;
    *pins_->peak_scale = s.scurve_peak_scale;
    *pins_->planner_type = planner_pin_ = s.planner_type;
    *pins_->arc_blend = s.arc_blend;
    *pins_->arc_blend_fallback = s.arc_blend_fallback;
    *pins_->arc_blend_depth = s.arc_blend_depth;
    *pins_->gap_cycles = s.arc_blend_gap_cycles;
    *pins_->ramp_freq = s.arc_blend_ramp_freq;
    *pins_->kink_ratio = s.arc_blend_kink_ratio;
}

void IniPins::poll(Settings &s, MotionLink &m) {
    auto real = [](const hal_float_t *pin, double &known) {
        double v = *pin;
        if (!(std::fabs(v - known) > 1e-5)) return false; // NaN is no value
        known = v;
        return true;
    };
    auto whole = [](const hal_s32_t *pin, int &known) {
        int v = *pin;
        if (v == known) return false;
        known = v;
        return true;
    };
    auto flag = [](const hal_bit_t *pin, bool &known) {
        bool v = *pin;
        if (v == known) return false;
        known = v;
        return true;
    };
    for (int n = 0; n < joints_; n++) {
        const JointPins &p = pins_->joint[n];
        Settings::Joint &j = s.joint[n];
        if (real(p.backlash, j.backlash)) m.set_joint_backlash(n, j.backlash);
        if (real(p.min_limit, j.min_limit)) m.set_joint_min_limit(n, j.min_limit);
        if (real(p.max_limit, j.max_limit)) m.set_joint_max_limit(n, j.max_limit);
        if (real(p.ferror, j.ferror)) m.set_joint_ferror(n, j.ferror);
        if (real(p.min_ferror, j.min_ferror)) m.set_joint_min_ferror(n, j.min_ferror);
        if (real(p.max_velocity, j.max_velocity)) m.set_joint_max_velocity(n, j.max_velocity);
        if (real(p.max_acceleration, j.max_acceleration)) m.set_joint_max_acceleration(n, j.max_acceleration);
        if (real(p.max_jerk, j.max_jerk)) m.set_joint_max_jerk(n, j.max_jerk);
        bool home = real(p.home, j.home);
        home |= real(p.home_offset, j.home_offset);
        home |= whole(p.home_sequence, j.home_sequence);
        if (home) m.update_homing_params(n, j.home, j.home_offset, j.home_sequence);
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const AxisPins &p = pins_->axis[n];
        Settings::Axis &a = s.axis[n];
        if (real(p.min_limit, a.min_limit)) m.set_axis_min_limit(n, a.min_limit);
        if (real(p.max_limit, a.max_limit)) m.set_axis_max_limit(n, a.max_limit);
        if (real(p.max_velocity, a.max_velocity))
            m.set_axis_max_velocity(n, a.max_velocity * (1 - a.offset_ratio), a.max_velocity * a.offset_ratio);
        if (real(p.max_acceleration, a.max_acceleration))
            m.set_axis_max_acceleration(n, a.max_acceleration * (1 - a.offset_ratio),
                                        a.max_acceleration * a.offset_ratio);
        if (real(p.max_jerk, a.max_jerk)) m.set_axis_max_jerk(n, a.max_jerk);
    }
    if (real(pins_->default_velocity, s.default_velocity)) m.set_velocity(0, s.default_velocity);
    if (real(pins_->max_velocity, s.max_velocity)) m.set_max_velocity(s.max_velocity);
    if (real(pins_->default_acceleration, s.default_acceleration)) m.set_acceleration(s.default_acceleration);
    if (real(pins_->max_acceleration, s.max_acceleration)) m.max_traj_acceleration = std::max(0.0, s.max_acceleration);
    bool jerk = real(pins_->max_jerk, s.max_jerk), planner = whole(pins_->planner_type, planner_pin_);
    if (jerk) m.set_jerk(s.max_jerk);
    if (planner) s.planner_type = planner_pin_ == 1;
    if (s.planner_type == 1 && s.max_jerk < 1 && (jerk || planner)) {
        if (!planner_warned_)
            rcs_print("S-curve planner (planner type 1) requires max jerk >= 1.0; using trapezoidal planner\n");
        planner_warned_ = true;
        m.set_planner_type(0);
    } else if (planner) {
        m.set_planner_type(s.planner_type);
    }
    if (real(pins_->peak_scale, s.scurve_peak_scale)) m.set_scurve_peak_scale(s.scurve_peak_scale);
    bool arcs = flag(pins_->arc_blend, s.arc_blend);
    arcs |= flag(pins_->arc_blend_fallback, s.arc_blend_fallback);
    arcs |= whole(pins_->arc_blend_depth, s.arc_blend_depth);
    arcs |= real(pins_->gap_cycles, s.arc_blend_gap_cycles);
    arcs |= real(pins_->ramp_freq, s.arc_blend_ramp_freq);
    arcs |= real(pins_->kink_ratio, s.arc_blend_kink_ratio);
    if (arcs) send_arc_blends(s, m);
}
