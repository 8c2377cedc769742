// SPDX-License-Identifier: GPL-2.0-or-later
//
// ini_settings.hh - the INI file's machine to the motion controller, at start and, through
// the pins of HAL component inihal, while running.
//
// [task] Source: motion sheet, section 17; INI sheet, sections 6 and 8.
#ifndef KERF_INI_SETTINGS_HH
#define KERF_INI_SETTINGS_HH

#include <initializer_list>
#include <string>

#include "hal.h"
#include "inifile.hh"
#include "motion_link.hh"

// What the INI file says and a pin may change later.
struct Settings {
    struct Joint {
        double backlash = 0, ferror = 1, min_ferror = 1, min_limit = -1e99, max_limit = 1e99;
        double max_velocity = 1, max_acceleration = 1, max_jerk = 0, home = 0, home_offset = 0;
        int home_sequence = 999;
    } joint[EMCMOT_MAX_JOINTS];
    struct Axis {
        double min_limit = -1e99, max_limit = 1e99, max_velocity = 1, max_acceleration = 1, max_jerk = 0;
        double offset_ratio = 0; // share of speed and acceleration for external offsets
    } axis[EMCMOT_MAX_AXIS];
    double default_velocity = 1, max_velocity = 1e99, default_acceleration = 1e99, max_acceleration = 1e99,
           max_jerk = 1e9;
    double scurve_peak_scale = 1;
    int planner_type = 0, smooth_planner = 1;
    bool arc_blend = true, arc_blend_fallback = false;
    int arc_blend_depth = 50;
    double arc_blend_gap_cycles = 4, arc_blend_ramp_freq = 100, arc_blend_kink_ratio = 0.1;
    bool no_force_homing = false;
    std::string position_file;
};

// Index of the value among the words, those in any case; `standard` without a value; -1, with a message, none of them.
int word_of(const linuxcnc::IniFile &ini, const char *section, const char *name, int standard,
            std::initializer_list<const char *> words);

// Sends everything in the documented order. 0; -1 with a message.
int load_settings(const linuxcnc::IniFile &ini, EMC_STAT &stat, MotionLink &motion, Settings *settings);

// The component inihal: pins that show the settings and take changes.
class IniPins {
public:
    ~IniPins();
    // Pins for `joints` joints; the component is ready when this returns true.
    bool create(int joints);
    void show(const Settings &s);
    // Sends what changed on the pins since the last call; keeps s up to date.
    void poll(Settings &s, MotionLink &motion);
private:
    struct Pins;
    int comp_ = -1, joints_ = 0;
    Pins *pins_ = nullptr;
    bool planner_warned_ = false;
    int planner_pin_ = 0; // what its pin said, which may be no type there is
};

#endif
