// SPDX-License-Identifier: GPL-2.0-or-later
//
// motion_link.hh - task's end of the wire to the motion controller: commands out, status in.
//
// Every function that gives a command returns 0 or a negative EMCMOT_COMM_* code (motion's
// own reason reaches the operator through read_error). Units: machine units, degrees, s, rpm.
// [task]
#ifndef KERF_MOTION_LINK_HH
#define KERF_MOTION_LINK_HH

#include <string>

#include "inifile.hh"
#include "messages.hh"
#include "motion.h"
#include "task_canon.hh" // AxisLimits

class MotionLink {
public:
    explicit MotionLink(EMC_STAT &stat) : stat_(stat) {}
    ~MotionLink();
    MotionLink(const MotionLink &) = delete;

    // Attaches to the segment of [EMCMOT]SHMEM_KEY. False: motion is not there yet.
    bool attach(const linuxcnc::IniFile &ini);
    // True once something answers at the other end (a servo cycle was seen).
    bool alive();

    int stop_causes() const { return stop_causes_; } // EMCMOT_STOP_*: what switched motion off
    unsigned stalls() const { return status_->stalls; } // how often motion was held since the computer stood still
    double stall_time() const { return status_->stall_time; } // s, the last time
    int stall_ended() const { return status_->stall_ended; } // STALL_...

    // Sends a command with the id of the line under way.
    int send(emcmot_command_t &c);
    int send(cmd_code_t code);
    void set_id(int line) { id_ = line; }

    // ---- configuration, joints and axes by number ----
    struct Joint { double max_velocity = 0, max_acceleration = 0, min_limit = 0, max_limit = 0; };
    AxisLimits limits;                    // as canon uses them: the planner's share
    struct Axis { double min_limit = 0, max_limit = 0, max_velocity = 0; };
    Axis axis[EMCMOT_MAX_AXIS];
    Joint joint[EMCMOT_MAX_JOINTS];
    double max_traj_acceleration = 1e99;  // kept here, never sent

    int set_joints(int n);
    int set_spindles(int n);
    int set_velocity(double v, double ini_maxvel);
    int set_max_velocity(double v);
    int set_acceleration(double a);
    int set_jerk(double j);
    int set_planner_type(int type);
    int set_scurve_peak_scale(double scale);
    int set_home(const EmcPose &home);
    int set_max_feed_override(double scale);
    /// feed, rapid: PROBE_CONTACT_...; filter in seconds.
    int set_probe_errors(bool inhibit_jog, bool inhibit_home, int feed, int rapid, double filter);
    int set_arc_blends(bool enable, bool fallback, int depth, int gap_cycles, double ramp_freq, double kink_ratio);
    int set_joint_backlash(int j, double v);
    int set_joint_min_limit(int j, double v);
    int set_joint_max_limit(int j, double v);
    int set_joint_ferror(int j, double v);
    int set_joint_min_ferror(int j, double v);
    int set_joint_max_velocity(int j, double v);
    int set_joint_max_acceleration(int j, double v);
    int set_joint_max_jerk(int j, double v);
    int set_joint_motor_offset(int j, double v);
    int set_homing_params(const EMC_JOINT_SET_HOMING_PARAMS &p);
    int update_homing_params(int j, double home, double offset, int sequence);
    int activate_joint(int j);
    int load_comp(int j, const char *file, int type);
    int set_axis_min_limit(int a, double v);
    int set_axis_max_limit(int a, double v);
    int set_axis_max_velocity(int a, double v, double ext_offset);
    int set_axis_max_acceleration(int a, double v, double ext_offset);
    int set_axis_max_jerk(int a, double v);
    int set_axis_locking_joint(int a, int j);
    int set_spindle_params(int s, double max_forward, double min_forward, double max_reverse, double min_reverse,
                           double home_search, double home, int sequence, double increment);

    // ---- machine ----
    int abort();  // stops all jogs and the trajectory
    int traj_abort() { return send(EMCMOT_ABORT); }
    int enable() { return send(EMCMOT_ENABLE); }
    int disable() { return send(EMCMOT_DISABLE); }
    int set_mode(int traj_mode); // EMC_TRAJ_MODE_*
    int home(int j);
    int unhome(int j);
    int jog_cont(int nr, double vel, int jjogmode);
    int jog_incr(int nr, double incr, double vel, int jjogmode);
    int jog_abs(int nr, double pos, double vel, int jjogmode);
    int jog_stop(int nr, int jjogmode);
    int override_limits(int j);
    int set_debug(unsigned mask);
    int spindle_off(int spindle, int wait = 0);

    // ---- moves and what goes with them ----
    int linear_move(const EMC_TRAJ_LINEAR_MOVE &m);
    int circular_move(const EMC_TRAJ_CIRCULAR_MOVE &m);
    int probe(const EMC_TRAJ_PROBE &m);
    int rigid_tap(const EMC_TRAJ_RIGID_TAP &m);
    int set_term_cond(int cond, double tolerance);
    int set_spindlesync(int spindle, double feed_per_revolution, bool velocity_mode);
    int set_offset(const EmcPose &p);
    int scale(cmd_code_t code, double scale, int spindle = 0);
    int enable_flag(cmd_code_t code, int on, int spindle = 0);
    int set_dout(int index, int start, int end, int now);
    int set_aout(int index, double start, double end, int now);
    /* An order for this speed (rpm, signed) and surface speed factor would change nothing. */
    bool spindle_runs_at(int spindle, double speed, double factor) const;
    int spindle_on(int spindle, double speed, double factor, double xoffset, int wait);
    // Surface speed that the spindle was last ordered to keep, in place of the speed of *on and in its direction.
    void keep_surface_speed(EMC_SPINDLE_ON *on) const;
    int spindle_speed(int spindle, double speed, double factor, double xoffset);
    int spindle_command(cmd_code_t code, int spindle);
    int spindle_orient(int spindle, double orientation, int mode);

    // ---- status ----
    // Copies motion's status into stat; at most one error text goes to *error (else empty).
    void update(std::string *error);
    const emcmot_status_t &raw() const { return *status_; }
    EmcPose external_offsets() const { return status_->eoffset_pose; }
    bool external_offsets_applied() const { return status_->external_offsets_applied != 0; }

    // Positions of all joints to and from [TRAJ]POSITION_FILE.
    int load_positions(const std::string &file);
    int save_positions(const std::string &file);

private:
    emcmot_command_t command(cmd_code_t code) const;
    emcmot_command_t joint_command(cmd_code_t code, int j) const;
    emcmot_command_t axis_command(cmd_code_t code, int a) const;
    int send_move(emcmot_command_t &c);
    void started(int spindle, int on); // -1 all
    int spindle_order(int spindle, double speed, double factor, double xoffset);
    EMC_STAT &stat_;
    emcmot_status_t statuses_[2] = {};
    emcmot_status_t *status_ = &statuses_[0],
                    *next_status_ = &statuses_[1]; // the last whole one; the other is read into
    emcmot_config_t config_{};
    int id_ = 0, config_num_ = -1;
    bool attached_ = false;
    int stop_causes_ = 0;
    bool settling_ = false;          // a move was given that the status does not show yet
    uint64_t settle_from_ = 0;
    bool joint_error_shown_[EMCMOT_MAX_JOINTS] = {};
    int started_[EMCMOT_MAX_SPINDLES] = {}; // by an order to start, not stopped or oriented since
    struct SpindleOrder { double speed = 0, factor = 0, xoffset = 0; };
    SpindleOrder ordered_[EMCMOT_MAX_SPINDLES]; // last one of each
    int last_wait_ = 0;                     // an S word sends it again
};

#endif
