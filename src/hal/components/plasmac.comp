// SPDX-License-Identifier: GPL-2.0-or-later
component plasmac "Plasma cutting controller";
pin in float arc_fail_delay "Seconds to wait for the arc after the torch was started.";
pin in float arc_lost_delay "Seconds that a lost arc is tolerated.";
pin in float arc_ok_high "Upper limit of a good arc voltage (mode 0).";
pin in float arc_ok_low "Lower limit of a good arc voltage (mode 0).";
pin in float arc_voltage_in "Arc voltage as measured.";
pin in float arc_voltage_offset "Value of *arc-voltage-in* at 0 volts.";
pin in float arc_voltage_scale "Volts per unit of *arc-voltage-in*.";
pin in float axis_x_max_limit "Maximum limit of X.";
pin in float axis_x_min_limit "Minimum limit of X.";
pin in float axis_x_position "Position of X.";
pin in float axis_y_max_limit "Maximum limit of Y.";
pin in float axis_y_min_limit "Minimum limit of Y.";
pin in float axis_y_position "Position of Y.";
pin in float axis_z_max_limit "Maximum limit of Z.";
pin in float axis_z_min_limit "Minimum limit of Z.";
pin in float axis_z_position "Position of Z.";
pin in float cornerlock_threshold "Percentage of the feed rate below which height control stops.";
pin in float current_velocity "Present velocity, units per second.";
pin in float cut_feed_rate "Feed rate of the material, units per minute.";
pin in float cut_height "Height of the cut.";
pin in float cut_volts "Arc voltage of the cut.";
pin in float feed_override "Feed override.";
pin in float feed_reduction "Feed in percent, from the program; 0 or from 100 on: no reduction.";
pin in float feed_upm "Feed rate of the program, units per minute.";
pin in float float_switch_travel "Travel of the float switch.";
pin in float gcode_scale = 1 "Scale of the program.";
pin in float height_override "Volts to add to the target.";
pin in float height_per_volt "Change of height that changes the arc by one volt.";
pin in float kerf_width "Not used.";
pin in float lowpass_frequency "Cutoff of the filter of the arc voltage in Hz; 0: no filter.";
pin in float material_thickness "Thickness of the material.";
pin in float offset_feed_rate "Feed rate of offset probing.";
pin in float offset_probe_delay "Seconds that the offset probe needs to deploy.";
pin in float offset_probe_x "Offset of the probe in X.";
pin in float offset_probe_y "Offset of the probe in Y.";
pin in float ohmic_probe_offset "Offset of the ohmic probe in Z.";
pin in float ok_sample_threshold = 10 "Volts that samples may differ for a good arc.";
pin in float pause_at_end "Seconds to wait with the arc on at the end of the cut.";
pin in float paused_motion_speed "Speed factor of motion while paused; negative backward.";
pin in float pid_d_gain "Derivative gain of the height control.";
pin in float pid_i_gain "Integral gain of the height control.";
pin in float pid_p_gain "Proportional gain of the height control.";
pin in float pierce_delay "Seconds for the pierce.";
pin in float pierce_height "Height of the pierce.";
pin in float probe_feed_rate "Feed rate of probing.";
pin in float probe_start_height "Height where probing begins.";
pin in float puddle_jump_delay "Seconds at the puddle jump height.";
pin in float puddle_jump_height "Height of the puddle jump in percent of the pierce height.";
pin in float requested_velocity "Not used.";
pin in float restart_delay "Seconds between attempts to start the arc.";
pin in float safe_height "Height of moves without cutting.";
pin in float scribe_arm_delay "Seconds to arm the scribe.";
pin in float scribe_on_delay "Seconds for the scribe to start.";
pin in float setup_feed_rate "Feed rate of moves of Z that are no probing.";
pin in float skip_ihs_distance "Distance from the last cut within which no probing is needed.";
pin in float slat_height "Height of the slats.";
pin in float spotting_threshold "Arc voltage at which the time of a spot begins.";
pin in float spotting_time "Milliseconds of a spot.";
pin in float thc_delay "Seconds from the start of the cut to height control.";
pin in float thc_feed_rate "Feed rate of height control.";
pin in float thc_sample_threshold = 1 "Volts that samples may differ for the target voltage.";
pin in float thc_threshold "Volts of error that are ignored.";
pin in float torch_pulse_time "Seconds of a torch pulse.";
pin in float units_per_mm "Machine units per millimeter.";
pin in float x_offset_current "Present external offset of X.";
pin in float xy_feed_rate "Feed rate of consumable changes.";
pin in float y_offset_current "Present external offset of Y.";
pin in float z_offset_current "Present external offset of Z.";
pin in float zero_window = 0.1 "Arc voltages nearer to zero are zero.";
pin in float pierce_motion_delay "Percentage of the pierce delay before a ramp moves Z.";
pin in float cut_height_delay "Seconds at the end of the pierce.";
pin in float pierce_end_height "Height at the end of a ramp pierce.";
pin in float gouge_speed "Speed of the first part of a ramp pierce.";
pin in float gouge_speed_distance "Length of that part.";
pin in float creep_speed "Speed of the second part.";
pin in float creep_speed_distance "Length of that part.";
pin in bit arc_ok_in "The plasma source says that the arc is good (modes 1 and 2).";
pin in bit breakaway "Breakaway switch.";
pin in bit consumable_change "Go to the place where consumables are changed.";
pin in bit cornerlock_enable "Stop height control while slow.";
pin in bit cut_recovery "Move off the path to recover a cut.";
pin in bit cutting_start "Start a cut; from spindle.0.on.";
pin in bit debug_print "Print changes of the state.";
pin in bit dry_run "Run without the torch.";
pin in bit external_estop "Not used.";
pin in bit float_switch "Float switch.";
pin in bit homed "The machine is homed.";
pin in bit ignore_arc_ok_0 "Ignore arc ok.";
pin in bit ignore_arc_ok_1 "Ignore arc ok.";
pin in bit laser_mode "A laser is used for alignment.";
pin in bit machine_is_on "The machine is on.";
pin in bit mesh_arc_ok "Not used.";
pin in bit mesh_enable "Cut mesh: no height control, no arc ok.";
pin in bit move_down "Lower the torch (mode 2).";
pin in bit move_up "Raise the torch (mode 2).";
pin in bit multi_tool = 1 "Scribe and spotting may be used.";
pin in bit offset_set_probe "Deploy the offset probe.";
pin in bit offset_set_scribe "Deploy the scribe.";
pin in bit offsets_active "External offsets are not zero.";
pin in bit offsets_limited "External offsets are limited.";
pin in bit ohmic_probe "Ohmic probe.";
pin in bit ohmic_probe_enable "Use the ohmic probe.";
pin in bit ohmic_sense_in "Contact of the ohmic sensor.";
pin in bit ohmic_test "Test the ohmic probe.";
pin in bit override_jog "Allow jogging while a sensor is active.";
pin in bit probe_test "Test probing.";
pin in bit program_is_idle "No program runs.";
pin in bit program_is_paused "The program is paused.";
pin in bit program_is_running "A program runs.";
pin in bit scribe_start "Start the scribe; from spindle.1.on.";
pin in bit spotting_start "Start a spot; from spindle.2.on.";
pin in bit thc_auto "Start height control when the voltage is steady.";
pin in bit thc_disable "No height control, from the program.";
pin in bit thc_enable "Use height control.";
pin in bit torch_enable "The torch may be used.";
pin in bit torch_off "Switch the torch off.";
pin in bit torch_pulse_abort "End a torch pulse.";
pin in bit torch_pulse_hold "Prolong a torch pulse.";
pin in bit torch_pulse_start "Start a torch pulse.";
pin in bit tube_cut "Cut a tube: no probing.";
pin in bit use_auto_volts "Take the voltage at the start of the cut as target.";
pin in bit voidlock_enable "Stop height control over voids.";
pin in signed arc_max_starts "Attempts to start the arc.";
pin in signed laser_recovery_start "Show the place of the cut with the laser.";
pin in signed laser_x_offset "Offset of the laser in X, counts.";
pin in signed laser_y_offset "Offset of the laser in Y, counts.";
pin in signed max_offset = 5 "Distance from the maximum limit of Z, millimeters.";
pin in signed mode "0: arc voltage; 1: voltage and arc ok; 2: arc ok, up and down.";
pin in signed motion_type "Type of motion; from motion.motion-type.";
pin in signed ohmic_max_attempts "Attempts with the ohmic probe before the float switch is used.";
pin in signed ohmic_sense_on_delay = 3 "Cycles of contact until it counts.";
pin in signed ohmic_sense_off_delay = 3 "Cycles without contact until it counts.";
pin in signed ok_sample_counts = 10 "Samples for a good arc, 1 to 1000.";
pin in signed probe_final_speed = 1 "Speed of the last part of probing, 1 to 10.";
pin in signed resolution = 100 "Counts per unit and cycle, 1 to 1000.";
pin in signed thc_sample_counts = 50 "Samples for the target voltage, 1 to 1000.";
pin in signed voidlock_off_cycles = 10 "Quiet cycles after which height control goes on.";
pin in signed voidlock_on_cycles = 2 "Cycles of a steep voltage that are a void.";
pin in signed voidlock_slope = 500 "Volts per second of a void.";
pin in signed x_offset "Offset of X for consumable change and recovery, counts.";
pin in signed y_offset "Offset of Y for consumable change and recovery, counts.";
pin in signed pierce_type "0: normal; 1: wiggle; 2: ramp.";
pin in signed low_cut_volts "Pause below this voltage while height control is active.";
pin in signed target_samples = 6 "Samples for the automatic target voltage.";
pin out float adaptive_feed "To motion.adaptive-feed.";
pin out float arc_voltage_out "Arc voltage.";
pin out float current_feed_rate "Present feed rate, units per minute.";
pin out float cut_length "Length cut.";
pin out float cut_time "Seconds cut.";
pin out float offset_scale "To axis.L.eoffset-scale.";
pin out float paused_time "Seconds paused.";
pin out float probe_time "Seconds of probing.";
pin out float rapid_time "Seconds of rapid motion.";
pin out float requested_feed_rate "Feed rate wanted.";
pin out float run_time "Seconds of the program.";
pin out float torch_time "Seconds of the torch.";
pin out float z_height "Height of the torch.";
pin out float z_relative "Not used.";
pin out float target_volts "Voltage that height control keeps.";
pin out bit arc_ok_out "The arc is good.";
pin out bit consumable_changing "At or on the way to the place of consumable change.";
pin out bit cornerlock_is_locked "Height control is stopped by speed.";
pin out bit cut_recovering "A cut is being recovered.";
pin out bit cutting_stop "To halui.spindle.0.stop.";
pin out bit feed_hold "To motion.feed-hold.";
pin out bit jog_inhibit "To motion.jog-inhibit.";
pin out bit led_down "The torch moves down.";
pin out bit led_up "The torch moves up.";
pin out bit ohmic_enable "Switch the ohmic probe on.";
pin out bit ohmic_sense_out "Debounced contact of the ohmic sensor.";
pin out bit paused_motion "Motion while paused is active.";
pin out bit probe_out "To motion.probe-input.";
pin out bit probe_test_error "The probe test failed.";
pin out bit program_pause "To halui.program.pause.";
pin out bit program_resume "To halui.program.resume.";
pin out bit program_run "To halui.program.run.";
pin out bit program_stop "To halui.program.stop.";
pin out bit safe_height_is_limited "The safe height could not be kept.";
pin out bit sensor_active "Breakaway, float switch or ohmic probe is active.";
pin out bit scribe_arm "Arm the scribe.";
pin out bit scribe_on "Start the scribe.";
pin out bit thc_active "Height control is active.";
pin out bit thc_enabled "Height control may become active.";
pin out bit torch_on "Switch the torch on.";
pin out bit voidlock_is_locked "Height control is stopped by a void.";
pin out bit xy_offset_enable "To axis.x.eoffset-enable and axis.y.eoffset-enable.";
pin out bit z_offset_enable "To axis.z.eoffset-enable.";
pin out signed laser_recovery_state "0 off, 1 set, 2 setting, 3 on, 4 reset, 5 resetting.";
pin out signed pierce_count "Number of pierces.";
pin out signed state_out "State, see below.";
pin out signed stop_type_out "0 none, 1 stop, 2 wait, 3 pause.";
pin out signed x_offset_counts "To axis.x.eoffset-counts.";
pin out signed y_offset_counts "To axis.y.eoffset-counts.";
pin out signed z_offset_counts "To axis.z.eoffset-counts.";function _ "Runs the controller; in the servo thread.";
option singleton;
description """
The realtime part of a plasma cutting controller: probing, starting and supervising the arc, height control, pausing
and recovering. It moves the axes by external offsets.

States (*state-out*): 0 idle, 1 probe height, 2 probe down, 3 probe up, 4 zero height, 5 pierce height, 6 torch on,
7 arc ok, 8 pierce delay, 9 puddle jump, 10 cut height, 11 cut in modes 0 and 1, 12 cut in mode 2, 13 pause at end,
14 safe height, 15 maximum height, 16 end of cut, 17 end of job, 18 torch pulse, 19 paused motion, 20 ohmic test,
21 probe test, 22 scribing, 23 and 24 consumable change on and off, 25 and 26 cut recovery on and off, 27 debug.

*mode* is 0 for arc voltage only, 1 for arc voltage with an arc ok signal of the plasma source, 2 for arc ok with up
and down signals.
""";
see_also "thc(9), thcud(9), ohmic(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include "components/real_to_int.h";
;;
#define SELF struct __comp_state *__comp_inst
#define ME __comp_inst

enum state {
    IDLE, PROBE_HEIGHT, PROBE_DOWN, PROBE_UP, ZERO_HEIGHT, PIERCE_HEIGHT, TORCH_ON, ARC_OK, PIERCE_DELAY,
    PUDDLE_JUMP, CUT_HEIGHT, CUT_MODE_01, CUT_MODE_2, PAUSE_AT_END, SAFE_HEIGHT, MAX_HEIGHT, END_CUT, END_JOB,
    TORCHPULSE, PAUSED_MOTION, OHMIC_TEST, PROBE_TEST, SCRIBING, CONSUMABLE_CHANGE_ON, CONSUMABLE_CHANGE_OFF,
    CUT_RECOVERY_ON, CUT_RECOVERY_OFF, DEBUG_STATE, STATES
};
enum stop { STOP_NONE, STOP_STOP, STOP_WAIT, STOP_PAUSE };
enum tool { TOOL_NONE, TOOL_CUTTING, TOOL_SCRIBE, TOOL_SPOTTING };
enum laser { LASER_OFF, LASER_SET, LASER_SETTING, LASER_ON, LASER_RESET, LASER_RESETTING };
enum probe { PROBE_FLOAT, PROBE_OHMIC };

#define SAMPLES 1000                    /* room for arc voltages */
#define TORCH_OFF_HOLD 0.25             /* s that "height control was active" stays known */

static const char *const state_names[STATES] = {
    "IDLE", "PROBE_HEIGHT", "PROBE_DOWN", "PROBE_UP", "ZERO_HEIGHT", "PIERCE_HEIGHT", "TORCH_ON", "ARC_OK",
    "PIERCE_DELAY", "PUDDLE_JUMP", "CUT_HEIGHT", "CUT_MODE_01", "CUT_MODE_2", "PAUSE_AT_END", "SAFE_HEIGHT",
    "MAX_HEIGHT", "END_CUT", "END_JOB", "TORCHPULSE", "PAUSED_MOTION", "OHMIC_TEST", "PROBE_TEST", "SCRIBING",
    "CONSUMABLE_CHANGE_ON", "CONSUMABLE_CHANGE_OFF", "CUT_RECOVERY_ON", "CUT_RECOVERY_OFF", "DEBUG"
};

/* Everything that lasts from one cycle to the next. Counts are external offset
 * counts; one count is offset-scale machine units. */
static struct {
    enum state state, shown_state;
    enum stop stop;
    enum tool tool;
    double dt;                          /* s */

    /* Scales and velocities of this cycle. */
    int res, ores;
    double vs;                          /* counts per cycle for 1 unit/min */
    double recovery_vel;
    int setup_vel, offset_vel, probe_vel, thc_vel;
    int ok_samples, thc_samples;

    /* Program and cut. */
    int auto_cut, manual_cut, cut_started, statistics_cleared, first_cut_finished;
    int limit_told, voltage_told, cap_told, recovery_told, change_told, start_told;
    double bad_voltage_s;
    double start_x, start_y, finish_x, finish_y;

    /* Probing. */
    int probe_inhibit, probe_required, probe_testing, probe_retry, float_detected, ohmic_detected;
    int ohmic_attempts, offset_probing;
    enum probe probe_type;
    double deploy_s, last_probe_z;
    int probe_x_target, probe_y_target, probe_x_vel, probe_y_vel;

    /* Heights in counts. */
    int probe_start_target, zero_target, cut_target, datum, pierce_target, pierce_end_target, puddle_target;
    int safe_target, offset_min, offset_max, last_cut_counts, puddle_percent;

    /* Torch and arc. */
    int arc_starts;
    double restart_s, arc_fail_s, arc_lost_s, pierce_s, motion_s, height_s, puddle_s, end_s, spot_s, pulse_s;
    double pierce_travel;
    int spotting, pulse_on, cut_ending;
    double raw_volts, volts, ring[SAMPLES];
    int ring_at;
    int sense_count;

    /* Height control. */
    double thc_delay_s, thc_active_s, last_override, thc_error, last_volts, volts_sum;
    int thc_activated, counts_to_move, steep, quiet, averaged;

    /* Scribe, recovery. */
    double scribe_arm_s, scribe_on_s;
    int scribe_armed, recovery_x, recovery_y, laser_x, laser_y;
} p;

static int clamp_int(int x, int low, int high) {
    return x < low ? low : x > high ? high : x;
}

static int whole(double x) {
    return real_to_s32(x);
}

/* One step of at most v from o towards t. */
static int move(int o, int v, int t) {
    if(o - v > t) return o - v;
    if(o + v < t) return o + v;
    return t;
}

static int counts_of(SELF, double length) {
    return whole(length / offset_scale);
}

/* z has been told to go to t and the external offset is there. */
static int reached(SELF, int t) {
    return z_offset_counts == t && whole(z_offset_current * p.ores) == whole(t * offset_scale * p.ores);
}

static int any_sensor(SELF) {
    return float_switch || breakaway || p.ohmic_detected;
}

static int ignoring_arc(SELF) {
    return mesh_enable || ignore_arc_ok_0 || ignore_arc_ok_1;
}

static int is_cutting(void) {
    return p.state == CUT_MODE_01 || p.state == CUT_MODE_2;
}

/* ---- Stopping and pausing -------------------------------------------------- */

/* Torch off, program paused, torch to the top. reason NULL: said already. */
static void pause_program(SELF, const char *reason, int inhibit) {
    torch_on = 0;
    program_pause = 1;
    p.stop = STOP_PAUSE;
    p.probe_required = 1;
    if(inhibit) p.probe_inhibit = 1;
    p.state = MAX_HEIGHT;
    if(reason) rtapi_print_msg(RTAPI_MSG_ERR, "%s\nprogram is paused.\n", reason);
}

static const char *sensor_message(SELF) {
    return breakaway ? "breakaway switch activated"
        : float_switch ? "float switch activated" : "ohmic probe activated";
}

static void fail_probe_test(SELF) {
    probe_test_error = 1;
    p.probe_inhibit = 1;
    p.state = PROBE_TEST;
}

/* A mistake while probing: ends the test or pauses the program. */
static void fail_probing(SELF, const char *reason, const char *test_reason) {
    if(p.probe_testing) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s\n", test_reason ? test_reason : reason);
        fail_probe_test(ME);
    } else {
        pause_program(ME, reason, 0);
    }
}

static void remember_finish(SELF, int known) {
    p.finish_x = known ? axis_x_position : 0;
    p.finish_y = known ? axis_y_position : 0;
}

static void end_with_pause(SELF) {
    p.end_s = pause_at_end;
    p.state = PAUSE_AT_END;
}

static void abort_idle_sensor(SELF) {
    torch_on = 0;
    if(p.stop != STOP_PAUSE) rtapi_print_msg(RTAPI_MSG_ERR, "%s\nprogram is paused.\n", sensor_message(ME));
    program_pause = 1;
    if(p.stop != STOP_WAIT) p.stop = STOP_PAUSE;
    p.probe_required = 1;
    p.probe_inhibit = 1;
    p.state = MAX_HEIGHT;
}

static void abort_program_end(SELF) {
    if(consumable_changing) {
        p.state = CONSUMABLE_CHANGE_OFF;
        return;
    }
    if(cut_recovering) {
        p.state = CUT_RECOVERY_OFF;
        return;
    }
    if(pause_at_end == 0) torch_on = 0;
    p.stop = STOP_STOP;
    program_stop = 1;
    p.cut_started = 0;
    p.probe_required = 1;
    remember_finish(ME, 0);
    if(pause_at_end != 0) end_with_pause(ME);
    else p.state = MAX_HEIGHT;
}

static void abort_cut(SELF) {
    if(program_is_paused) {
        torch_on = 0;
        p.stop = STOP_PAUSE;
        p.probe_required = 1;
        p.state = MAX_HEIGHT;
    } else if(p.tool == TOOL_NONE) {
        if(pause_at_end == 0) torch_on = 0;
        p.stop = STOP_WAIT;
        if(thc_enabled || !torch_enable) remember_finish(ME, 1);
        end_with_pause(ME);
    } else if(breakaway) {
        pause_program(ME, sensor_message(ME), 1);
    } else if(p.state > ARC_OK) {
        if(float_switch && !tube_cut) pause_program(ME, "float switch activated", 1);
        else if(p.ohmic_detected) pause_program(ME, "ohmic probe activated", 1);
        else if(!arc_ok_out && torch_enable && !torch_off && !ignoring_arc(ME))
            pause_program(ME, "valid arc lost", 0);
    }
}

static void check_aborts(SELF) {
    if(p.auto_cut) {
        if(p.state == IDLE && any_sensor(ME) && !program_is_idle && !tube_cut) abort_idle_sensor(ME);
        else if(!probe_test && program_is_idle && p.cut_started && !program_run) abort_program_end(ME);
        else if(!probe_test && p.state > IDLE && p.state <= CUT_MODE_2 && p.stop == STOP_NONE && p.cut_started)
            abort_cut(ME);
    } else if(p.manual_cut && p.tool == TOOL_NONE) {
        p.manual_cut = 0;
        torch_on = 0;
        p.stop = STOP_NONE;
        program_stop = 1;
        p.cut_started = 0;
        p.probe_required = 1;
        remember_finish(ME, 0);
        p.state = MAX_HEIGHT;
    }
}

static void check_offset_limits(SELF) {
    if(!(offsets_limited && offsets_active)) {
        p.limit_told = 0;
        return;
    }
    if(p.limit_told) return;
    p.limit_told = 1;
    rtapi_print_msg(RTAPI_MSG_ERR, "Offset limit violation (state: %s)\nprogram is paused.\n",
                    state_names[p.state]);
    torch_on = 0;
    if(program_is_running) program_pause = 1;
    p.stop = STOP_PAUSE;
    p.probe_inhibit = 1;
    p.state = MAX_HEIGHT;
}

/* ---- What is done before the state, in this order -------------------------- */

static void choose_tool(SELF) {
    if(cutting_start && !dry_run) p.tool = TOOL_CUTTING;
    else if(multi_tool && !dry_run && scribe_start && !spotting_start) p.tool = TOOL_SCRIBE;
    else if(multi_tool && !dry_run && spotting_start && !scribe_start) p.tool = TOOL_SPOTTING;
    else p.tool = TOOL_NONE;
}

static void set_scales(SELF) {
    p.res = clamp_int(resolution, 1, 1000);
    p.ores = units_per_mm == 1 ? p.res : 10 * p.res;
    offset_scale = units_per_mm * p.dt / p.res;
    p.vs = p.res / units_per_mm / 60;
    p.recovery_vel = cut_feed_rate * p.vs * 0.5;
}

static void set_velocities(SELF) {
    p.setup_vel = whole(setup_feed_rate * p.vs);
    p.offset_vel = whole(offset_feed_rate * p.vs);
    p.probe_vel = whole((probe_feed_rate < setup_feed_rate ? probe_feed_rate : setup_feed_rate) * p.vs);
    p.thc_vel = whole(thc_feed_rate * p.vs * (mode == 2 ? pid_p_gain / 100 : 1));
    if(p.thc_vel < 1) p.thc_vel = 1;
}

static void update_thc_flags(SELF) {
    int locked = cornerlock_is_locked || voidlock_is_locked;
    thc_enabled = thc_enable && !thc_disable && !ignoring_arc(ME) && p.arc_lost_s > arc_lost_delay - 1e-6;
    thc_active = is_cutting() && ((mode < 2 && target_volts != 0) || (mode == 2 && arc_ok_out))
        && thc_enabled && !locked;
    if(thc_active) {
        p.thc_activated = 1;
        p.thc_active_s = TORCH_OFF_HOLD;
    } else if(is_cutting() && p.thc_active_s > 0) {
        p.thc_active_s -= p.dt;
        if(p.thc_active_s <= 0) p.thc_activated = 0;
    } else if(!is_cutting() && p.probe_required) {
        p.thc_activated = 0;
    }
}

static void filter_voltage(SELF) {
    double v;
    if(lowpass_frequency != 0)
        p.raw_volts += (arc_voltage_in - p.raw_volts) * (1 - exp(-2 * M_PI * fabs(lowpass_frequency) * p.dt));
    else
        p.raw_volts = arc_voltage_in;
    if(!isfinite(p.raw_volts)) p.raw_volts = arc_voltage_in;
    v = (fabs(p.raw_volts) - arc_voltage_offset) * fabs(arc_voltage_scale);
    v = round(v * 1000) / 1000;
    if(fabs(v) < zero_window) v = 0;
    p.volts = v;
    arc_voltage_out = v;
    if(thc_active && low_cut_volts && v < low_cut_volts) {
        double wanted = target_volts;
        pause_program(ME, NULL, 1);
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "arc voltage fell below safe level while THC active\ntarget voltage = %.2f\n"
                        "low cut volts = %d\narc voltage = %.2f\nprogram is paused.\n",
                        wanted, (int)low_cut_volts, v);
    }
}

static void debounce_ohmic_sense(SELF) {
    if(!ohmic_enable) {
        ohmic_sense_out = 0;
        p.sense_count = 0;
    } else if(ohmic_sense_in) {
        if(p.sense_count < ohmic_sense_on_delay) {
            p.sense_count++;
        } else {
            ohmic_sense_out = 1;
            p.sense_count = 0;
        }
    } else if(ohmic_sense_out) {
        if(p.sense_count < ohmic_sense_off_delay) p.sense_count++;
        else ohmic_sense_out = 0;
    } else {
        p.sense_count = 0;
    }
}

static void deploy_offset_probe(SELF) {
    int probing = p.state == PROBE_HEIGHT || p.state == PROBE_DOWN || p.state == PROBE_UP
        || p.state == PIERCE_HEIGHT;
    p.offset_probing = ohmic_probe_enable && (offset_probe_x != 0 || offset_probe_y != 0);
    if(p.offset_probing && probing && (ohmic_enable || p.state == PIERCE_HEIGHT)) p.deploy_s += p.dt;
    else p.deploy_s = 0;
}

/* The last n samples are all within `most` of `of`; within FALSE: all beyond it. */
static int samples_agree(int n, double of, double most, int within) {
    int i, at = p.ring_at;
    for(i = 0; i < n; i++) {
        at = at == 0 ? SAMPLES - 1 : at - 1;
        if((fabs(p.ring[at] - of) <= most) != within) return 0;
    }
    return 1;
}

static void supervise_arc(SELF) {
    double v = p.volts;
    int good = v >= arc_ok_low && v <= arc_ok_high;
    if(!torch_on) {
        arc_ok_out = 0;
        p.arc_lost_s = arc_lost_delay;
        return;
    }
    torch_time += p.dt;
    p.ring[p.ring_at] = v;
    p.ring_at = (p.ring_at + 1) % SAMPLES;
    if(mode > 0) {
        if(arc_ok_in) {
            arc_ok_out = 1;
            p.arc_lost_s = arc_lost_delay;
        } else if(p.arc_lost_s > 0) {
            p.arc_lost_s -= p.dt;
        } else {
            arc_ok_out = 0;
        }
    } else if(!arc_ok_out) {
        if(good && samples_agree(p.ok_samples, v, ok_sample_threshold, 1)) {
            arc_ok_out = 1;
            p.arc_lost_s = arc_lost_delay;
        }
    } else if(!good && samples_agree(p.ok_samples, target_volts, ok_sample_threshold, 0)) {
        p.arc_lost_s -= p.dt;
        if(p.arc_lost_s <= 0) arc_ok_out = 0;
    } else {
        p.arc_lost_s = arc_lost_delay;
    }
}

static void clear_statistics(SELF) {
    cut_length = cut_time = paused_time = probe_time = rapid_time = run_time = torch_time = 0;
    pierce_count = 0;
}

static void follow_program(SELF) {
    if(program_is_idle) {
        program_stop = 0;
        program_resume = 0;
        p.statistics_cleared = 0;
    }
    if(program_is_paused) {
        program_pause = 0;
        paused_time += p.dt;
        run_time += p.dt;
    }
    if(program_is_running) {
        program_run = 0;
        program_resume = 0;
        p.auto_cut = 1;
        run_time += p.dt;
        if(motion_type == 1) rapid_time += p.dt;
        if(!p.statistics_cleared) {
            p.statistics_cleared = 1;
            clear_statistics(ME);
        }
    }
}

static void set_offset_tools(SELF) {
    if(!(homed && program_is_idle && p.state == IDLE)) return;
    if(offset_set_probe) ohmic_enable = 1;
    else if(!p.probe_testing && !ohmic_test) ohmic_enable = 0;
    scribe_arm = offset_set_scribe;
}

static void set_machine_off(SELF) {
    x_offset_counts = y_offset_counts = z_offset_counts = 0;
    p.stop = STOP_NONE;
    p.cut_started = 0;
    p.probe_required = 1;
    program_stop = 0;
    program_resume = 0;
    program_pause = 0;
    torch_on = 0;
    p.state = IDLE;
}

/* ---- Idle: what to begin --------------------------------------------------- */

static double distance_from_last(SELF) {
    double x = p.thc_activated ? p.finish_x : p.start_x, y = p.thc_activated ? p.finish_y : p.start_y;
    return hypot(axis_x_position - x, axis_y_position - y);
}

/* Heights of the last probing are good enough here. */
static void reuse_heights(SELF) {
    if(thc_enabled) {
        int shift = p.last_cut_counts - p.cut_target;
        p.pierce_target += shift;
        p.puddle_target += shift;
        p.cut_target = p.last_cut_counts;
    }
    p.state = PIERCE_HEIGHT;
}

/* Splits velocity v (counts per cycle) over two ways. */
static void split_velocity(double v, double x, double y, int *vx, int *vy) {
    double length = hypot(x, y);
    *vx = length > 0 ? whole(fabs(v * x / length)) : 0;
    *vy = length > 0 ? whole(fabs(v * y / length)) : 0;
    if(x != 0 && *vx < 1) *vx = 1;
    if(y != 0 && *vy < 1) *vy = 1;
}

/* Targets of offset probing; false if the probe would leave the machine. */
static int aim_offset_probe(SELF) {
    double x = axis_x_position + offset_probe_x, y = axis_y_position + offset_probe_y;
    const char *reason = NULL;
    split_velocity(p.offset_vel, offset_probe_x, offset_probe_y, &p.probe_x_vel, &p.probe_y_vel);
    p.probe_x_target = x_offset_counts + counts_of(ME, offset_probe_x);
    p.probe_y_target = y_offset_counts + counts_of(ME, offset_probe_y);
    if(x < axis_x_min_limit) reason = "probe offset would violate axis X minimum limit.";
    else if(x > axis_x_max_limit) reason = "probe offset would violate axis X maximum limit.";
    else if(y < axis_y_min_limit) reason = "probe offset would violate axis Y minimum limit.";
    else if(y > axis_y_max_limit) reason = "probe offset would violate axis Y maximum limit.";
    if(!reason) return 1;
    fail_probing(ME, reason, NULL);
    return 0;
}

static void set_probe_start(SELF) {
    double down = axis_z_position - axis_z_min_limit;
    if(p.first_cut_finished) return;
    if(material_thickness != 0 && slat_height != 0)
        p.probe_start_target = z_offset_counts - counts_of(ME, down - material_thickness - slat_height);
    else if(probe_start_height != 0)
        p.probe_start_target = z_offset_counts - counts_of(ME, down - probe_start_height);
    else
        p.probe_start_target = z_offset_counts;
}

/* Takes an offset of the laser back; true when there is none. */
static int laser_offset_gone(SELF) {
    int v = whole(cut_feed_rate * p.vs);
    if(laser_recovery_state == LASER_OFF) return 1;
    x_offset_counts = move(x_offset_counts, v, x_offset);
    y_offset_counts = move(y_offset_counts, v, y_offset);
    if(x_offset_counts != x_offset || y_offset_counts != y_offset) return 0;
    laser_recovery_state = LASER_OFF;
    return 1;
}

static void begin_cut(SELF) {
    feed_hold = 1;
    p.stop = STOP_NONE;
    if(probe_test) p.probe_testing = 1;
    else p.cut_started = 1;
    if(skip_ihs_distance != 0 && distance_from_last(ME) < skip_ihs_distance && !p.probe_required
       && !p.probe_testing) {
        reuse_heights(ME);
        return;
    }
    p.start_x = axis_x_position;
    p.start_y = axis_y_position;
    if(any_sensor(ME)) {
        const char *what = breakaway ? "breakaway switch" : float_switch ? "float switch" : "ohmic probe";
        p.probe_inhibit = 1;
        rtapi_print_msg(RTAPI_MSG_ERR, "%s detected before probing.\n%s.\n", what,
                        p.probe_testing ? "probe test aborted" : "program is paused");
        if(p.probe_testing) fail_probe_test(ME);
        else pause_program(ME, NULL, 1);
        return;
    }
    if(program_is_paused) return;
    p.float_detected = 0;
    p.ohmic_attempts = 0;
    p.probe_type = ohmic_probe_enable ? PROBE_OHMIC : PROBE_FLOAT;
    set_probe_start(ME);
    if(!laser_offset_gone(ME)) return;
    if(p.offset_probing && !aim_offset_probe(ME)) return;
    p.state = PROBE_HEIGHT;
}

static void begin_tube_cut(SELF) {
    p.cut_started = 1;
    p.stop = STOP_NONE;
    if(torch_enable) {
        feed_hold = 1;
        p.arc_starts = 0;
        p.restart_s = 0;
        p.state = TORCH_ON;
    } else {
        feed_hold = 0;
        p.state = CUT_MODE_01;
    }
}

static void begin_scribe(SELF) {
    feed_hold = 1;
    p.scribe_arm_s = scribe_arm_delay;
    p.scribe_on_s = scribe_on_delay;
    p.scribe_armed = 0;
    p.state = SCRIBING;
}

static void begin_torch_pulse(SELF) {
    feed_hold = 1;
    p.pulse_on = 0;
    p.state = TORCHPULSE;
}

static void begin_ohmic_test(SELF) {
    feed_hold = 1;
    ohmic_enable = 1;
    p.state = OHMIC_TEST;
}

static void state_idle(SELF) {
    int held = p.stop == STOP_PAUSE || p.stop == STOP_WAIT;
    int free_to_cut = (p.stop == STOP_NONE || p.stop == STOP_WAIT) && homed;
    if(mode == 2 && program_is_idle) {
        led_down = move_down;
        led_up = move_up;
    }
    if(p.probe_inhibit) {
        if(!any_sensor(ME)) p.probe_inhibit = 0;
        return;
    }
    if(paused_motion_speed != 0 && held) p.state = PAUSED_MOTION;
    else if(consumable_change && held && !consumable_changing) p.state = MAX_HEIGHT;
    else if(!consumable_change && held && consumable_changing) p.state = CONSUMABLE_CHANGE_OFF;
    else if(cut_recovery && p.stop == STOP_PAUSE && (!cut_recovering || laser_recovery_start))
        p.state = CUT_RECOVERY_ON;
    else if(tube_cut && p.tool == TOOL_CUTTING && free_to_cut) begin_tube_cut(ME);
    else if((p.tool == TOOL_CUTTING || p.tool == TOOL_SPOTTING || probe_test) && free_to_cut) begin_cut(ME);
    else if(!program_is_paused && p.stop == STOP_PAUSE) {
        if(consumable_changing) p.state = CONSUMABLE_CHANGE_OFF;
        feed_hold = motion_type != 1;
        p.stop = STOP_NONE;
    } else if(torch_pulse_start && torch_enable && !any_sensor(ME)) begin_torch_pulse(ME);
    else if(ohmic_test && ohmic_probe_enable) begin_ohmic_test(ME);
    else if(p.tool == TOOL_SCRIBE && !probe_test && homed) begin_scribe(ME);
    else if(!p.cut_started) feed_hold = 0;
}

/* ---- Probing --------------------------------------------------------------- */

static int probe_offset_counts(SELF) {
    return counts_of(ME, p.probe_type == PROBE_OHMIC ? ohmic_probe_offset : float_switch_travel);
}

/* The pierce height above the present place must be below the top; false if not. */
static int pierce_fits(SELF) {
    int pierce = z_offset_counts + probe_offset_counts(ME) + counts_of(ME, pierce_height + units_per_mm);
    int top = z_offset_counts
        + counts_of(ME, axis_z_max_limit - axis_z_position - max_offset * units_per_mm);
    if(pierce < top) return 1;
    fail_probing(ME, "pierce height would exceed Z axis maximum limit.", NULL);
    return 0;
}

static int probe_test_over(SELF) {
    if(!p.probe_testing) return 0;
    if(!probe_test) {
        p.state = PROBE_TEST;
        return 1;
    }
    if(breakaway) {
        fail_probe_test(ME);
        return 1;
    }
    return 0;
}

static void state_probe_height(SELF) {
    int at_probe = 1;
    probe_time += p.dt;
    feed_hold = 1;
    z_offset_enable = 1;
    if(ohmic_probe_enable) ohmic_enable = 1;
    if(probe_test_over(ME)) return;
    if(p.offset_probing) {
        xy_offset_enable = 1;
        x_offset_counts = move(x_offset_counts, p.probe_x_vel, p.probe_x_target);
        y_offset_counts = move(y_offset_counts, p.probe_y_vel, p.probe_y_target);
        at_probe = x_offset_counts == p.probe_x_target && y_offset_counts == p.probe_y_target;
    }
    if((float_switch && !p.float_detected) || p.ohmic_detected) {
        if(!pierce_fits(ME)) return;
        if(!at_probe) {
            fail_probing(ME, "material contact before the probe offset was reached.", NULL);
            return;
        }
        p.probe_retry = 1;
        p.state = PROBE_UP;
        return;
    }
    z_offset_counts = move(z_offset_counts, p.setup_vel, p.probe_start_target);
    if(!reached(ME, p.probe_start_target) || !at_probe) return;
    if(p.float_detected && float_switch) return;
    p.last_probe_z = 1e99;
    p.state = PROBE_DOWN;
}

static void state_probe_down(SELF) {
    probe_time += p.dt;
    feed_hold = 1;
    if(probe_test_over(ME)) return;
    if(ohmic_probe_enable && p.deploy_s < offset_probe_delay) return;
    if(float_switch && !p.float_detected) {
        if(!ohmic_probe_enable || p.ohmic_attempts >= ohmic_max_attempts) {
            p.probe_type = PROBE_FLOAT;
            if(pierce_fits(ME)) p.state = PROBE_UP;
        } else {
            p.ohmic_attempts++;
            p.float_detected = 1;
            p.state = PROBE_HEIGHT;
        }
    } else if(p.ohmic_detected) {
        p.probe_type = PROBE_OHMIC;
        p.state = PROBE_UP;
    } else if(axis_z_position - p.probe_vel * offset_scale <= axis_z_min_limit + 0.25 * units_per_mm
              && fabs(axis_z_position - p.last_probe_z) < 0.0001) {
        fail_probing(ME, "bottom limit reached while probing down.",
                     "bottom limit reached while probe testing.");
    } else {
        p.last_probe_z = axis_z_position;
        z_offset_counts -= p.probe_vel;
    }
}

/* The height of moves without cutting; false if the material is too high. */
static int set_safe_height(SELF) {
    int least = p.pierce_target + counts_of(ME, units_per_mm);
    int wanted = p.zero_target + counts_of(ME, safe_height);
    if(least > p.offset_max) {
        pause_program(ME, "material is too high for safe traverse.", 0);
        return 0;
    }
    if(safe_height == 0 || wanted > p.offset_max) {
        p.safe_target = p.offset_max;
        if(safe_height != 0) {
            double left = (p.offset_max - p.zero_target) * offset_scale;
            if(units_per_mm == 1)
                rtapi_print_msg(RTAPI_MSG_ERR, "safe traverse height has been reduced to %0.1fmm.\n", left);
            else
                rtapi_print_msg(RTAPI_MSG_ERR, "safe traverse height has been reduced to %0.2fin.\n", left);
        }
    } else {
        p.safe_target = wanted < least ? least : wanted;
    }
    return 1;
}

static void state_probe_up(SELF) {
    probe_time += p.dt;
    if(probe_test_over(ME)) return;
    if(float_switch || p.ohmic_detected) {
        z_offset_counts += p.probe_retry ? 10 * p.res : clamp_int(probe_final_speed, 1, 10) * p.res;
        return;
    }
    if(p.probe_retry) {
        p.probe_retry = 0;
        p.last_probe_z = 1e99;
        p.state = PROBE_DOWN;
        return;
    }
    ohmic_enable = 0;
    p.zero_target = z_offset_counts + probe_offset_counts(ME);
    p.cut_target = p.datum = p.zero_target + counts_of(ME, cut_height);
    p.pierce_target = p.zero_target + counts_of(ME, pierce_height);
    p.pierce_end_target = p.zero_target + counts_of(ME, pierce_end_height);
    p.puddle_target = p.zero_target + counts_of(ME, pierce_height * p.puddle_percent / 100.0);
    p.offset_min = z_offset_counts - counts_of(ME, axis_z_position - axis_z_min_limit);
    p.offset_max = z_offset_counts
        + counts_of(ME, axis_z_max_limit - axis_z_position - max_offset * units_per_mm);
    safe_height_is_limited = 0;
    p.cap_told = 0;
    if(set_safe_height(ME)) p.state = ZERO_HEIGHT;
}

static void state_zero_height(SELF) {
    (void)ME;
    p.state = PIERCE_HEIGHT;
}

/* Takes the offset of the probe back; true when there. */
static int probe_offset_gone(SELF) {
    if(!p.offset_probing) return 1;
    x_offset_counts = move(x_offset_counts, p.probe_x_vel, cut_recovering ? x_offset : 0);
    y_offset_counts = move(y_offset_counts, p.probe_y_vel, cut_recovering ? y_offset : 0);
    return x_offset_counts == (cut_recovering ? x_offset : 0) && y_offset_counts == (cut_recovering ? y_offset : 0);
}

static void state_pierce_height(SELF) {
    int there = probe_offset_gone(ME);
    feed_hold = 1;
    p.probe_required = 0;
    if(!(pierce_height != 0 && cut_height != 0 && (use_auto_volts || cut_volts != 0))) {
        pause_program(ME, "invalid pierce height.\nor invalid cut height.\nor invalid cut volts.", 0);
        return;
    }
    z_offset_counts = move(z_offset_counts, p.setup_vel, p.pierce_target);
    if(!there || !reached(ME, p.pierce_target)) return;
    p.arc_starts = 0;
    p.restart_s = 0;
    p.start_told = 0;
    if(p.probe_testing) {
        p.state = PROBE_TEST;
    } else if(!torch_enable) {
        p.pierce_s = pierce_delay + cut_height_delay;
        p.motion_s = pierce_delay * pierce_motion_delay / 100;
        p.pierce_travel = 0;
        p.state = PIERCE_DELAY;
    } else if(p.tool == TOOL_CUTTING || p.tool == TOOL_SPOTTING) {
        p.state = TORCH_ON;
    }
}

/* ---- Starting the arc ------------------------------------------------------ */

static void give_up_starting(SELF) {
    if(!p.start_told) {
        p.start_told = 1;
        rtapi_print_msg(RTAPI_MSG_ERR, "no arc detected after %d start attempts\n%s\n", (int)arc_max_starts,
                        program_is_idle ? "manual cut is stopped." : "program is paused.");
    }
    if(program_is_idle) {
        cutting_stop = 1;
        p.state = MAX_HEIGHT;
    } else {
        program_pause = 1;
    }
}

static void state_torch_on(SELF) {
    int i;
    feed_hold = 1;
    if(p.arc_starts >= arc_max_starts) {
        give_up_starting(ME);
        return;
    }
    if(p.restart_s > 0) {
        p.restart_s -= p.dt;
        return;
    }
    p.arc_fail_s = arc_fail_delay;
    p.spotting = 0;
    if(torch_enable) {
        torch_on = 1;
        pierce_count++;
    }
    for(i = 0; i < SAMPLES; i++) p.ring[i] = 0;
    p.state = ARC_OK;
}

static void begin_pierce(SELF) {
    p.pierce_s = pierce_delay + cut_height_delay;
    p.motion_s = pierce_delay * pierce_motion_delay / 100;
    p.puddle_s = puddle_jump_delay;
    p.pierce_travel = 0;
    p.state = PIERCE_DELAY;
}

static void watch_spot(SELF) {
    if(!p.spotting && p.volts >= spotting_threshold) {
        p.spotting = 1;
        p.spot_s = spotting_time / 1000;
    } else if(p.spotting) {
        p.spot_s -= p.dt;
        if(p.spot_s <= 0) {
            torch_on = 0;
            p.stop = STOP_WAIT;
            p.state = SAFE_HEIGHT;
        }
    }
}

static void state_arc_ok(SELF) {
    if(p.tool == TOOL_SPOTTING) {
        watch_spot(ME);
        if(p.state != ARC_OK) return;
    } else if(arc_ok_out || ignoring_arc(ME)) {
        begin_pierce(ME);
        return;
    }
    if(p.spotting) return;
    p.arc_fail_s -= p.dt;
    if(p.arc_fail_s <= 0) {
        torch_on = 0;
        p.restart_s = restart_delay;
        p.arc_starts++;
        p.state = TORCH_ON;
    }
}

/* Speed and height of a ramp pierce. */
static void ramp_pierce(SELF) {
    double left = pierce_delay * (1 - pierce_motion_delay / 100);
    p.pierce_travel += current_velocity * p.dt;
    if(p.pierce_travel < gouge_speed_distance)
        adaptive_feed = cut_feed_rate > 0 ? gouge_speed / cut_feed_rate : 1;
    else if(p.pierce_travel < gouge_speed_distance + creep_speed_distance)
        adaptive_feed = cut_feed_rate > 0 ? creep_speed / cut_feed_rate : 1;
    else
        adaptive_feed = 1;
    if(p.motion_s > 0) {
        p.motion_s -= p.dt;
    } else if(left > 0) {
        double v = (pierce_height - pierce_end_height) / left * 60 * p.vs;
        z_offset_counts = move(z_offset_counts, whole(fabs(v)), p.pierce_end_target);
    }
}

static void state_pierce_delay(SELF) {
    feed_hold = pierce_type == 0;
    if(pierce_type == 2 && p.pierce_s > cut_height_delay) ramp_pierce(ME);
    if(p.pierce_s > 0) {
        p.pierce_s -= p.dt;
        return;
    }
    if(tube_cut) {
        p.cut_target = p.datum = 0;
        feed_hold = 0;
        p.thc_delay_s = thc_delay;
        p.state = CUT_MODE_01;
    } else if((puddle_jump_delay != 0 || p.puddle_percent != 100) && !cut_recovering) {
        p.state = PUDDLE_JUMP;
    } else {
        p.state = CUT_HEIGHT;
    }
}

static void state_puddle_jump(SELF) {
    feed_hold = 0;
    z_offset_counts = move(z_offset_counts, p.setup_vel, p.puddle_target);
    if(!reached(ME, p.puddle_target)) return;
    if(p.puddle_s > 0) p.puddle_s -= p.dt;
    else p.state = CUT_HEIGHT;
}

static void state_cut_height(SELF) {
    z_offset_counts = move(z_offset_counts, p.setup_vel, p.cut_target);
    if(!reached(ME, p.cut_target)) return;
    target_volts = 0;
    p.thc_delay_s = thc_delay;
    p.averaged = 0;
    p.volts_sum = 0;
    p.counts_to_move = 0;
    p.last_override = height_override;
    if(cut_recovering) {
        split_velocity(whole(cut_feed_rate * p.vs), x_offset_counts, y_offset_counts, &p.recovery_x, &p.recovery_y);
        p.state = CUT_RECOVERY_OFF;
    } else {
        feed_hold = 0;
        p.state = mode < 2 ? CUT_MODE_01 : CUT_MODE_2;
    }
}

/* ---- Cutting --------------------------------------------------------------- */

static void set_feed(SELF) {
    double feed = feed_upm != 0 ? (adaptive_feed != 0 ? feed_upm / adaptive_feed : feed_upm)
        : cut_feed_rate * feed_override;
    if(gcode_scale != 1 && gcode_scale != 0) feed /= gcode_scale;
    requested_feed_rate = feed;
}

/* The torch moved by height control: move the safe height with it. */
static void track_safe_height(SELF) {
    int margin = counts_of(ME, units_per_mm == 1 ? 13 : 0.5);
    if(z_offset_counts <= p.datum) return;
    p.safe_target += z_offset_counts - p.datum;
    p.datum = z_offset_counts;
    if(p.safe_target <= p.offset_max) return;
    p.safe_target = p.offset_max;
    if(z_offset_counts > p.offset_max - margin && !p.cap_told) {
        p.cap_told = 1;
        safe_height_is_limited = 1;
        rtapi_print_msg(RTAPI_MSG_ERR, "safe traverse height has been reduced to less than %s\n",
                        units_per_mm == 1 ? "13mm." : "0.5in.");
    }
}

static void follow_cut(SELF) {
    cut_length += current_velocity * p.dt;
    cut_time += p.dt;
    p.last_cut_counts = z_offset_counts;
}

/* Moves z by n counts within the limits; pauses at them. */
static void move_thc(SELF, int n) {
    led_down = n < 0 ? 1 : n == 0 ? 0 : led_down;
    led_up = n > 0 ? 1 : n == 0 ? 0 : led_up;
    if(n < 0 && z_offset_counts + n <= p.offset_min) {
        pause_program(ME, "bottom limit reached while THC moving down.", 0);
    } else if(n > 0 && z_offset_counts + n >= p.offset_max) {
        pause_program(ME, "top limit reached while THC moving up.", 0);
    } else {
        z_offset_counts += n;
        track_safe_height(ME);
    }
}

static double average_of_ring(int n) {
    double sum = 0;
    int i, at = p.ring_at;
    for(i = 0; i < n; i++) {
        at = at == 0 ? SAMPLES - 1 : at - 1;
        sum += p.ring[at];
    }
    return sum / n;
}

/* Finds the voltage to keep, once the cut runs at its speed. */
static void find_target(SELF) {
    cornerlock_is_locked = 1;
    if(!(current_velocity * 60 > 0.999 * requested_feed_rate || laser_mode)) return;
    if(thc_auto && use_auto_volts) {
        if(samples_agree(p.thc_samples, p.volts, thc_sample_threshold, 1))
            target_volts = average_of_ring(p.thc_samples);
    } else if(p.thc_delay_s > 0) {
        p.thc_delay_s -= p.dt;
    } else if(use_auto_volts) {
        p.volts_sum += p.volts;
        if(++p.averaged >= target_samples) target_volts = p.volts_sum / p.averaged;
    } else {
        target_volts = cut_volts;
    }
    if(target_volts != 0) {
        cornerlock_is_locked = 0;
        p.last_volts = p.volts;
        p.thc_error = 0;
    }
}

static void lock_corners(SELF) {
    double feed = current_velocity * 60;
    if(!cornerlock_enable) cornerlock_is_locked = 0;
    else if(feed < requested_feed_rate * cornerlock_threshold / 100) cornerlock_is_locked = 1;
    else if(feed > requested_feed_rate * 0.99) cornerlock_is_locked = 0;
}

static void lock_voids(SELF) {
    double most = voidlock_slope * voidlock_on_cycles * p.dt;
    if(!voidlock_enable) {
        voidlock_is_locked = 0;
        p.steep = 0;
    } else if(fabs(p.volts - p.last_volts) > most) {
        p.quiet = 0;
        if(++p.steep > voidlock_on_cycles) voidlock_is_locked = 1;
    } else {
        p.steep = 0;
        if(++p.quiet >= voidlock_off_cycles) voidlock_is_locked = 0;
    }
    p.last_volts = p.volts;
}

static void control_height(SELF) {
    double e, out;
    lock_corners(ME);
    lock_voids(ME);
    if(cornerlock_is_locked || voidlock_is_locked) {
        led_down = 0;
        led_up = 0;
        return;
    }
    e = (target_volts + height_override - p.volts) * 0.1;
    if(fabs(e) < fabs(thc_threshold * 0.1)) e = 0;
    out = e * pid_p_gain * p.res + e * pid_i_gain * p.res * p.dt
        + (e - p.thc_error) * pid_d_gain * p.res / p.dt;
    p.thc_error = e;
    move_thc(ME, clamp_int(whole(out), -p.thc_vel, p.thc_vel));
}

/* A changed height override moves the torch at once. */
static int override_height(SELF) {
    double change = height_override - p.last_override;
    if(fabs(change) > 0.005) {
        p.counts_to_move -= counts_of(ME, change * height_per_volt);
        p.last_override = height_override;
    }
    if(p.counts_to_move == 0) return 0;
    if(p.counts_to_move > p.setup_vel) {
        z_offset_counts += p.setup_vel;
        p.counts_to_move -= p.setup_vel;
    } else {
        z_offset_counts += p.counts_to_move;
        p.counts_to_move = 0;
    }
    return 1;
}

static void state_idle(SELF);

static void state_cut_mode_01(SELF) {
    if(program_is_idle && p.tool != TOOL_CUTTING) {
        p.state = IDLE;
        state_idle(ME);
        return;
    }
    set_feed(ME);
    if((torch_on || laser_mode) && !ignoring_arc(ME)) {
        if(target_volts == 0) find_target(ME);
        else if(!override_height(ME) && thc_enabled) control_height(ME);
    } else {
        led_down = 0;
        led_up = 0;
    }
    if(p.state == CUT_MODE_01) follow_cut(ME);
}

static void state_cut_mode_2(SELF) {
    if(program_is_idle && p.tool != TOOL_CUTTING) {
        p.state = IDLE;
        state_idle(ME);
        return;
    }
    set_feed(ME);
    if((torch_on || laser_mode) && !ignoring_arc(ME)) {
        if(p.thc_delay_s > 0) {
            p.thc_delay_s -= p.dt;
        } else if(thc_enabled) {
            lock_corners(ME);
            move_thc(ME, cornerlock_is_locked ? 0 : (move_up ? p.thc_vel : 0) - (move_down ? p.thc_vel : 0));
        }
    }
    if(p.state == CUT_MODE_2) follow_cut(ME);
}

/* ---- Ending a cut ---------------------------------------------------------- */

static void state_pause_at_end(SELF) {
    feed_hold = 1;
    if(p.end_s > 0) {
        p.end_s -= p.dt;
        return;
    }
    torch_on = 0;
    p.state = program_is_idle ? MAX_HEIGHT : SAFE_HEIGHT;
}

static void state_safe_height(SELF) {
    feed_hold = 1;
    torch_on = 0;
    cornerlock_is_locked = 0;
    z_offset_counts = move(z_offset_counts, p.setup_vel, p.safe_target);
    if(!reached(ME, p.safe_target)) return;
    if(p.stop == STOP_WAIT) feed_hold = 0;
    p.first_cut_finished = 1;
    p.probe_start_target = p.safe_target;
    p.state = END_CUT;
}

/* Takes XY offsets of probing back; true when they are gone. */
static int xy_offsets_gone(SELF) {
    if(cut_recovering || consumable_changing) return 1;
    x_offset_counts = move(x_offset_counts, p.offset_vel > 0 ? p.offset_vel : p.setup_vel, 0);
    y_offset_counts = move(y_offset_counts, p.offset_vel > 0 ? p.offset_vel : p.setup_vel, 0);
    return x_offset_counts == 0 && y_offset_counts == 0;
}

static void state_max_height(SELF) {
    feed_hold = 1;
    torch_on = 0;
    cornerlock_is_locked = 0;
    z_offset_counts = move(z_offset_counts, p.setup_vel, 0);
    if(!reached(ME, 0)) return;
    if(consumable_change && !consumable_changing) {
        p.change_told = 0;
        p.state = CONSUMABLE_CHANGE_ON;
    } else if(cut_recovery && p.stop != STOP_STOP) {
        p.state = CUT_RECOVERY_ON;
    } else if(xy_offsets_gone(ME)) {
        p.first_cut_finished = 0;
        p.state = END_CUT;
    }
}

static void state_end_cut(SELF) {
    target_volts = 0;
    cornerlock_is_locked = 0;
    voidlock_is_locked = 0;
    led_down = 0;
    led_up = 0;
    ohmic_enable = 0;
    probe_test_error = 0;
    cutting_stop = 0;
    p.probe_testing = 0;
    p.state = program_is_idle ? END_JOB : IDLE;
}

static void state_end_job(SELF) {
    p.auto_cut = 0;
    p.manual_cut = 0;
    p.cut_started = 0;
    p.first_cut_finished = 0;
    p.probe_required = 1;
    p.stop = STOP_NONE;
    torch_on = 0;
    adaptive_feed = 1;
    z_offset_counts = move(z_offset_counts, p.setup_vel, 0);
    if(z_offset_counts != 0 || offsets_active) return;
    feed_hold = 0;
    p.zero_target = 0;
    safe_height_is_limited = 0;
    xy_offset_enable = 0;
    z_offset_enable = 0;
    p.state = consumable_changing ? CONSUMABLE_CHANGE_OFF : cut_recovering ? CUT_RECOVERY_OFF : IDLE;
}

/* ---- Tests, scribe, pulses ------------------------------------------------- */

static void state_torchpulse(SELF) {
    if(torch_pulse_abort || !torch_enable) {
        torch_on = 0;
        p.state = cut_recovering ? CUT_RECOVERY_ON : IDLE;
        return;
    }
    if(!p.pulse_on) {
        p.pulse_on = 1;
        p.pulse_s = torch_pulse_time;
        torch_on = 1;
        return;
    }
    p.pulse_s -= p.dt;
    if(p.pulse_s > 0 || torch_pulse_hold) return;
    torch_on = 0;
    p.pulse_on = 0;
    p.state = cut_recovering ? CUT_RECOVERY_ON : IDLE;
}

static void state_paused_motion(SELF) {
    if(paused_motion_speed != 0) {
        paused_motion = 1;
        adaptive_feed = paused_motion_speed;
        program_resume = 1;
        feed_hold = 0;
        return;
    }
    if(program_is_running && !program_is_paused) {
        program_pause = 1;
        feed_hold = 1;
        adaptive_feed = 1;
    }
    if(program_is_paused && feed_hold) {
        paused_motion = 0;
        p.state = CUT_RECOVERY_ON;
    }
}

static void state_ohmic_test(SELF) {
    if(ohmic_test) return;
    ohmic_enable = 0;
    p.state = cut_recovering ? CUT_RECOVERY_ON : IDLE;
}

static void state_probe_test(SELF) {
    if(probe_test) return;
    ohmic_enable = 0;
    z_offset_counts = move(z_offset_counts, p.setup_vel, 0);
    x_offset_counts = move(x_offset_counts, p.offset_vel > 0 ? p.offset_vel : p.setup_vel, 0);
    y_offset_counts = move(y_offset_counts, p.offset_vel > 0 ? p.offset_vel : p.setup_vel, 0);
    if(z_offset_counts || x_offset_counts || y_offset_counts || !reached(ME, 0)) return;
    p.state = END_CUT;
}

static void state_scribing(SELF) {
    if(p.tool == TOOL_NONE) {
        scribe_arm = 0;
        scribe_on = 0;
        p.scribe_armed = 0;
        p.state = IDLE;
        return;
    }
    if(program_is_paused) {
        scribe_arm = 0;
        scribe_on = 0;
        feed_hold = 1;
        p.scribe_arm_s = scribe_arm_delay;
        p.scribe_on_s = scribe_on_delay;
        return;
    }
    scribe_arm = 1;
    if(p.scribe_arm_s > 0) {
        p.scribe_arm_s -= p.dt;
        return;
    }
    scribe_on = 1;
    if(p.scribe_on_s > 0) {
        p.scribe_on_s -= p.dt;
        return;
    }
    feed_hold = 0;
}

/* ---- Consumable change and cut recovery ------------------------------------ */

/* Moves X and Y to the given counts at velocity v along the line; true when there. */
static int move_xy(SELF, int x, int y, double v) {
    int vx, vy;
    split_velocity(v, x - x_offset_counts, y - y_offset_counts, &vx, &vy);
    x_offset_counts = move(x_offset_counts, vx, x);
    y_offset_counts = move(y_offset_counts, vy, y);
    return x_offset_counts == x && y_offset_counts == y;
}

static int blocked_by_sensor(SELF) {
    if(!any_sensor(ME)) {
        p.change_told = 0;
        return 0;
    }
    if(!p.change_told) {
        p.change_told = 1;
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "breakaway, float, or ohmic activated during consumable change, motion paused.\n"
                        "WARNING: motion will resume when the sensor is released.\n");
    }
    return 1;
}

static void state_consumable_change_on(SELF) {
    xy_offset_enable = 1;
    consumable_changing = 1;
    if(blocked_by_sensor(ME)) return;
    if(move_xy(ME, x_offset, y_offset, xy_feed_rate * p.vs)) p.state = IDLE;
}

static void state_consumable_change_off(SELF) {
    if(blocked_by_sensor(ME)) return;
    if(!move_xy(ME, 0, 0, xy_feed_rate * p.vs)) return;
    if(offsets_active && (x_offset_current != 0 || y_offset_current != 0)) return;
    consumable_changing = 0;
    xy_offset_enable = 0;
    feed_hold = 0;
    p.state = IDLE;
}

static void recover_with_laser(SELF) {
    int x = x_offset + laser_x_offset, y = y_offset + laser_y_offset;
    if(laser_recovery_state == LASER_SET) laser_recovery_state = LASER_SETTING;
    if(move_xy(ME, x, y, cut_feed_rate * p.vs)) laser_recovery_state = LASER_ON;
}

static void state_cut_recovery_on(SELF) {
    if(program_is_running && !program_is_paused) {
        p.state = IDLE;
        return;
    }
    if(!cut_recovering) {
        cut_recovering = 1;
        if(puddle_jump_delay != 0 || p.puddle_percent != 100)
            rtapi_print_msg(RTAPI_MSG_ERR, "Puddle Jump is disabled during Cut Recovery.\n");
    }
    xy_offset_enable = 1;
    if(torch_pulse_start && torch_enable && !any_sensor(ME)) {
        begin_torch_pulse(ME);
    } else if(ohmic_test && ohmic_probe_enable) {
        begin_ohmic_test(ME);
    } else if(laser_recovery_start && laser_recovery_state == LASER_OFF) {
        laser_recovery_state = LASER_SET;
    } else if(laser_recovery_state == LASER_SET || laser_recovery_state == LASER_SETTING) {
        recover_with_laser(ME);
    } else if(!cut_recovery) {
        p.state = CUT_RECOVERY_OFF;
    } else if(paused_motion_speed != 0) {
        p.state = PAUSED_MOTION;
    } else {
        int laser = laser_recovery_state >= LASER_SETTING, v = whole(p.recovery_vel);
        x_offset_counts = move(x_offset_counts, v, x_offset + (laser ? laser_x_offset : 0));
        y_offset_counts = move(y_offset_counts, v, y_offset + (laser ? laser_y_offset : 0));
    }
}

static void state_cut_recovery_off(SELF) {
    double v = program_is_running ? cut_feed_rate * p.vs : p.recovery_vel;
    if(!move_xy(ME, 0, 0, v)) return;
    laser_recovery_state = LASER_OFF;
    cut_recovering = 0;
    xy_offset_enable = 0;
    if(cut_recovery && p.cut_started && torch_on) {
        feed_hold = 0;
        p.state = mode < 2 ? CUT_MODE_01 : CUT_MODE_2;
    } else {
        p.state = IDLE;
    }
}

/* ---- The cycle ------------------------------------------------------------- */

static void run_state(SELF) {
    static void (*const run[STATES])(SELF) = {
        state_idle, state_probe_height, state_probe_down, state_probe_up, state_zero_height, state_pierce_height,
        state_torch_on, state_arc_ok, state_pierce_delay, state_puddle_jump, state_cut_height, state_cut_mode_01,
        state_cut_mode_2, state_pause_at_end, state_safe_height, state_max_height, state_end_cut, state_end_job,
        state_torchpulse, state_paused_motion, state_ohmic_test, state_probe_test, state_scribing,
        state_consumable_change_on, state_consumable_change_off, state_cut_recovery_on, state_cut_recovery_off,
        state_idle
    };
    run[p.state](ME);
}

/* A voltage that is not a number: said once a second; true if so. */
static int bad_voltage(SELF) {
    if(isfinite(arc_voltage_in)) return 0;
    p.bad_voltage_s += p.dt;
    if(p.bad_voltage_s >= 1) {
        p.bad_voltage_s = 0;
        rtapi_print_msg(RTAPI_MSG_ERR, "invalid arc-voltage-in\n");
    }
    return 1;
}

FUNCTION(_) {
    p.dt = fperiod;
    rtapi_set_msg_level(debug_print ? RTAPI_MSG_INFO : RTAPI_MSG_ERR);
    p.ok_samples = mode == 0 ? clamp_int(ok_sample_counts, 1, SAMPLES) : 1;
    p.thc_samples = mode < 2 ? clamp_int(thc_sample_counts, 1, SAMPLES) : 1;
    if(bad_voltage(ME)) return;
    set_scales(ME);
    choose_tool(ME);
    sensor_active = any_sensor(ME);
    probe_out = float_switch && tube_cut && p.state == IDLE;
    check_offset_limits(ME);
    z_height = p.zero_target != 0 ? z_offset_current - p.zero_target * offset_scale
        : axis_z_position - axis_z_min_limit;
    current_feed_rate = current_velocity * 60;
    set_velocities(ME);
    if(torch_off) torch_on = 0;
    update_thc_flags(ME);
    p.ohmic_detected = ohmic_probe && ohmic_probe_enable;
    if(p.state != PAUSED_MOTION)
        adaptive_feed = is_cutting() && feed_reduction > 0 && feed_reduction < 100 ? feed_reduction / 100 : 1;
    if(p.tool == TOOL_CUTTING && !p.auto_cut) p.manual_cut = 1;
    check_aborts(ME);
    filter_voltage(ME);
    debounce_ohmic_sense(ME);
    deploy_offset_probe(ME);
    supervise_arc(ME);
    follow_program(ME);
    p.puddle_percent = puddle_jump_height == 0 ? 100 : whole(puddle_jump_height);
    jog_inhibit = sensor_active && program_is_idle
        && !(override_jog || p.state == PROBE_DOWN || p.state == PROBE_UP);
    set_offset_tools(ME);
    if(machine_is_on) run_state(ME);
    else set_machine_off(ME);
    state_out = p.state;
    stop_type_out = p.stop;
    if(debug_print && p.state != p.shown_state)
        rtapi_print_msg(RTAPI_MSG_INFO, "plasmac: %s\n", state_names[p.state]);
    p.shown_state = p.state;
}
