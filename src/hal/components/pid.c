/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pid.c - PID controller with feed forward and automatic tuning.
 *
 * In:     command and feedback (units), their derivatives (units/s), gains, limits
 * Out:    control output, error (units)
 * Thread: N.do-pid-calcs [servo], constant cost
 * Method: parallel form; integral held while the output is limited in the direction
 *         of the error. Tuning: relay method of Astrom and Hagglund 1984, gains by
 *         Ziegler and Nichols 1942.
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <stddef.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("PID controller with automatic tuning");

#define MAX_CHAN 16

static int num_chan;
RTAPI_MP_INT(num_chan, "number of controllers");
static char *names[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(names, MAX_CHAN, "names of the controllers");
static int debug;
RTAPI_MP_INT(debug, "1: pins that show the terms of the sum");

enum state { STATE_PID, STATE_TUNE_IDLE, STATE_TUNE_START, STATE_TUNE_POS, STATE_TUNE_NEG, STATE_TUNE_ABORT };

struct pid {
    hal_bool_t enable, index_enable, error_previous_target, tune_mode, tune_start, saturated;
    hal_real_t command, feedback, command_deriv, feedback_deriv, error, output, saturated_s;
    hal_real_t deadband, maxerror, maxerror_i, maxerror_d, maxcmd_d, maxcmd_dd, maxcmd_ddd, bias, maxoutput;
    hal_real_t pgain, igain, dgain, ff0, ff1, ff2, ff3, tune_effort;
    hal_sint_t saturated_count;
    hal_uint_t tune_cycles, tune_type;
    hal_real_t error_i, error_d, cmd_d, cmd_dd, cmd_ddd, ultimate_gain, ultimate_period;   /* pins if debug */
    /* Where command-deriv and feedback-deriv have their value while unconnected. */
    hal_real_t own_command_deriv, own_feedback_deriv;

    double prev_cmd, prev_fb;
    int prev_index_enable;
    int limit_state;                    /* +1, -1: output limited there */

    enum state state;
    unsigned half_cycles;
    rtapi_u64 cycle_ns;
    double amplitude, average_amplitude, total_s;
};

static int comp_id, controllers;
static struct pid *pids;

static double limited(double x, double limit)
{
    if(limit == 0) return x;
    return x > limit ? limit : x < -limit ? -limit : x;
}

/* 0 in place of what is not a number: nothing of it may stay in the state. */
static double number(double x)
{
    return isfinite(x) ? x : 0;
}

/* An input, or what it was before when it is not a number. */
static double input(hal_real_t pin, double before)
{
    double x = hal_get_real(pin);
    return isfinite(x) ? x : before;
}

static void clear_saturation(struct pid *p)
{
    hal_set_bool(p->saturated, 0);
    hal_set_real(p->saturated_s, 0);
    hal_set_si32(p->saturated_count, 0);
}

static void report_saturation(struct pid *p, double dt)
{
    rtapi_s32 count = hal_get_si32(p->saturated_count);
    if(!p->limit_state) {
        clear_saturation(p);
        return;
    }
    hal_set_bool(p->saturated, 1);
    hal_set_real(p->saturated_s, hal_get_real(p->saturated_s) + dt);
    if(count != RTAPI_INT32_MAX) hal_set_si32(p->saturated_count, count + 1);
}

/* Error as the proportional and integral terms see it. */
static double shaped_error(const struct pid *p, double error)
{
    double band = hal_get_real(p->deadband);
    error = limited(error, hal_get_real(p->maxerror));
    return error > band ? error - band : error < -band ? error + band : 0;
}

static void integrate(struct pid *p, double error, int enable, double dt)
{
    double sum = hal_get_real(p->error_i);
    if(!enable) {
        sum = 0;
    } else {
        if(error * p->limit_state <= 0) sum += error * dt;
        sum = limited(sum, hal_get_real(p->maxerror_i));
    }
    hal_set_real(p->error_i, number(sum));
}

/* The derivatives of command and feedback, and those of the command's derivative. */
static void differentiate(struct pid *p, double command, double feedback, int idx_reset, double dt)
{
    double old_d = hal_get_real(p->cmd_d), old_dd = hal_get_real(p->cmd_dd), d, dd;
    if(!idx_reset) {
        hal_set_real(p->own_command_deriv, (command - p->prev_cmd) / dt);
        hal_set_real(p->own_feedback_deriv, (feedback - p->prev_fb) / dt);
    }
    hal_set_real(p->error_d, number(limited(hal_get_real(p->command_deriv) - hal_get_real(p->feedback_deriv),
                                            hal_get_real(p->maxerror_d))));
    d = number(limited(hal_get_real(p->command_deriv), hal_get_real(p->maxcmd_d)));
    hal_set_real(p->cmd_d, d);
    dd = number(limited((d - old_d) / dt, hal_get_real(p->maxcmd_dd)));
    hal_set_real(p->cmd_dd, dd);
    hal_set_real(p->cmd_ddd, number(limited((dd - old_dd) / dt, hal_get_real(p->maxcmd_ddd))));
    p->prev_index_enable = hal_get_bool(p->index_enable);
    p->prev_cmd = command;
    p->prev_fb = feedback;
}

/* The sum of all terms within the output limit; sets limit_state. */
static double control_output(struct pid *p, double error, double command)
{
    double max = hal_get_real(p->maxoutput);
    double out = hal_get_real(p->bias)
        + hal_get_real(p->pgain) * error
        + hal_get_real(p->igain) * hal_get_real(p->error_i)
        + hal_get_real(p->dgain) * hal_get_real(p->error_d)
        + command * hal_get_real(p->ff0)
        + hal_get_real(p->cmd_d) * hal_get_real(p->ff1)
        + hal_get_real(p->cmd_dd) * hal_get_real(p->ff2)
        + hal_get_real(p->cmd_ddd) * hal_get_real(p->ff3);
    out = number(out);
    if(max == 0) return out;
    p->limit_state = out > max ? 1 : out < -max ? -1 : 0;
    return limited(out, max);
}

static void enter_tune_mode(struct pid *p)
{
    hal_set_real(p->error_i, 0);
    hal_set_real(p->error_d, 0);
    hal_set_real(p->cmd_d, 0);
    hal_set_real(p->cmd_dd, 0);
    p->prev_cmd = 0;
    p->limit_state = 0;
    hal_set_real(p->output, 0);
    p->state = STATE_TUNE_IDLE;
}

static void control(struct pid *p, double dt)
{
    double command = input(p->command, p->prev_cmd), feedback = input(p->feedback, p->prev_fb), error;
    int enable = hal_get_bool(p->enable);
    int idx_reset = p->prev_index_enable && !hal_get_bool(p->index_enable);
    error = (hal_get_bool(p->error_previous_target) && !idx_reset ? p->prev_cmd : command) - feedback;
    hal_set_real(p->error, error);
    if(hal_get_bool(p->tune_mode)) {
        enter_tune_mode(p);
        return;
    }
    error = shaped_error(p, error);
    integrate(p, error, enable, dt);
    differentiate(p, command, feedback, idx_reset, dt);
    if(enable) {
        hal_set_real(p->output, control_output(p, error, command));
    } else {
        hal_set_real(p->output, 0);
        p->limit_state = 0;
    }
    report_saturation(p, dt);
}

/* ---- Tuning: the output switches between two levels with the sign of the error,
 * amplitude and period of the oscillation give the gains. ------------------- */

static double effort(const struct pid *p)
{
    return fabs(hal_get_real(p->tune_effort));
}

static void set_gains(struct pid *p)
{
    double ku = 4 * effort(p) / (3.141592653589 * p->average_amplitude);
    double pu = 2 * p->total_s / hal_get_ui32(p->tune_cycles);
    hal_set_real(p->ultimate_gain, ku);
    hal_set_real(p->ultimate_period, pu);
    hal_set_real(p->ff0, 0);
    hal_set_real(p->ff2, 0);
    if(hal_get_ui32(p->tune_type) == 0) {
        hal_set_real(p->pgain, 0.6 * ku);
        hal_set_real(p->igain, 1.2 * ku / pu);
        hal_set_real(p->dgain, 3.0 / 40.0 * ku * pu);
        hal_set_real(p->ff1, 0);
    } else {
        hal_set_real(p->pgain, 0.45 * ku);
        hal_set_real(p->igain, 0.54 * ku / pu);
        hal_set_real(p->dgain, 0);
        hal_set_real(p->ff1, 1);
    }
}

static void end_tuning(struct pid *p)
{
    hal_set_real(p->output, hal_get_real(p->bias));
    hal_set_bool(p->tune_start, 0);
    p->state = hal_get_bool(p->tune_mode) ? STATE_TUNE_IDLE : STATE_PID;
}

static void end_half_cycle(struct pid *p)
{
    rtapi_u32 wanted = hal_get_ui32(p->tune_cycles);
    p->half_cycles++;
    p->average_amplitude += p->amplitude / wanted;
    p->amplitude = 0;
    p->total_s += p->cycle_ns * 1e-9;
    p->cycle_ns = 0;
    if(p->half_cycles >= wanted) {
        set_gains(p);
        end_tuning(p);
    }
}

static void oscillate(struct pid *p, double error, long period)
{
    double bias = hal_get_real(p->bias);
    p->cycle_ns += (rtapi_u64)period;
    if(error < 0) {
        p->amplitude = fmax(p->amplitude, -error);
        hal_set_real(p->output, bias - effort(p));
        if(p->state == STATE_TUNE_POS) {
            p->state = STATE_TUNE_NEG;
            end_half_cycle(p);
        }
    } else {
        p->amplitude = fmax(p->amplitude, error);
        hal_set_real(p->output, bias + effort(p));
        if(p->state == STATE_TUNE_NEG) {
            p->state = STATE_TUNE_POS;
            end_half_cycle(p);
        }
    }
}

static void tune(struct pid *p, long period)
{
    double error = hal_get_real(p->command) - hal_get_real(p->feedback);
    hal_set_real(p->error, error);
    if(!hal_get_bool(p->enable) || !hal_get_bool(p->tune_mode)) p->state = STATE_TUNE_ABORT;
    switch(p->state) {
    case STATE_TUNE_IDLE:
        if(hal_get_bool(p->tune_start)) p->state = STATE_TUNE_START;
        break;
    case STATE_TUNE_START:
        p->half_cycles = 0;
        p->cycle_ns = 0;
        p->amplitude = p->average_amplitude = p->total_s = 0;
        hal_set_real(p->ultimate_gain, 0);
        hal_set_real(p->ultimate_period, 0);
        hal_set_real(p->output, hal_get_real(p->bias) + effort(p));
        p->state = STATE_TUNE_POS;
        break;
    case STATE_TUNE_POS:
    case STATE_TUNE_NEG:
        oscillate(p, error, period);
        break;
    case STATE_TUNE_ABORT:
    default:
        end_tuning(p);
    }
}

/* HAL function pid.N.do-pid-calcs. [servo] */
static void do_pid_calcs(void *arg, long period)
{
    struct pid *p = arg;
    if(p->state == STATE_PID) control(p, period * 1e-9);
    else tune(p, period);
}

/* ---- [init] -------------------------------------------------------------- */

struct real_pin {
    const char *name;
    hal_pdir_t dir;
    size_t offset;
    double start;
};

#define REAL(name, dir, member, start) { name, dir, offsetof(struct pid, member), start }
static const struct real_pin real_pins[] = {
    REAL("command", HAL_IN, command, 0), REAL("feedback", HAL_IN, feedback, 0),
    REAL("command-deriv", HAL_IN, command_deriv, 0), REAL("feedback-deriv", HAL_IN, feedback_deriv, 0),
    REAL("error", HAL_OUT, error, 0), REAL("output", HAL_OUT, output, 0),
    REAL("saturated-s", HAL_OUT, saturated_s, 0), REAL("Pgain", HAL_IN, pgain, 1),
    REAL("Igain", HAL_IN, igain, 0), REAL("Dgain", HAL_IN, dgain, 0),
    REAL("FF0", HAL_IN, ff0, 0), REAL("FF1", HAL_IN, ff1, 0),
    REAL("FF2", HAL_IN, ff2, 0), REAL("FF3", HAL_IN, ff3, 0),
    REAL("deadband", HAL_IN, deadband, 0), REAL("maxerror", HAL_IN, maxerror, 0),
    REAL("maxerrorI", HAL_IN, maxerror_i, 0), REAL("maxerrorD", HAL_IN, maxerror_d, 0),
    REAL("maxcmdD", HAL_IN, maxcmd_d, 0), REAL("maxcmdDD", HAL_IN, maxcmd_dd, 0),
    REAL("maxcmdDDD", HAL_IN, maxcmd_ddd, 0), REAL("bias", HAL_IN, bias, 0),
    REAL("maxoutput", HAL_IN, maxoutput, 0), REAL("tune-effort", HAL_IO, tune_effort, 0.5),
};
static const struct real_pin debug_pins[] = {
    REAL("errorI", HAL_OUT, error_i, 0), REAL("errorD", HAL_OUT, error_d, 0),
    REAL("commandD", HAL_OUT, cmd_d, 0), REAL("commandDD", HAL_OUT, cmd_dd, 0),
    REAL("commandDDD", HAL_OUT, cmd_ddd, 0), REAL("ultimate-gain", HAL_OUT, ultimate_gain, 0),
    REAL("ultimate-period", HAL_OUT, ultimate_period, 0),
};

static int export_real(struct pid *p, const struct real_pin *pin, const char *name)
{
    hal_real_t *ref = (hal_real_t *)(void *)((char *)p + pin->offset);
    return hal_pin_new_real(comp_id, pin->dir, ref, pin->start, "%s.%s", name, pin->name);
}

/* Terms without a pin still have a cell, so that the code needs no case. */
static int export_debug(struct pid *p, const char *name)
{
    unsigned i;
    for(i = 0; i < sizeof debug_pins / sizeof debug_pins[0]; i++) {
        if(debug) {
            COMP_TRY(export_real(p, &debug_pins[i], name));
        } else {
            hal_refs_u cell = { 0 };
            COMP_TRY(hal_param_new_fake(comp_id, &cell));
            *(hal_real_t *)(void *)((char *)p + debug_pins[i].offset) = cell.r;
        }
    }
    return 0;
}

static int export_pid(struct pid *p, const char *name)
{
    unsigned i;
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->enable, 0, "%s.enable", name));
    for(i = 0; i < sizeof real_pins / sizeof real_pins[0]; i++) COMP_TRY(export_real(p, &real_pins[i], name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &p->saturated, 0, "%s.saturated", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &p->saturated_count, 0, "%s.saturated-count", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->index_enable, 0, "%s.index-enable", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->error_previous_target, 1, "%s.error-previous-target", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &p->tune_cycles, 50, "%s.tune-cycles", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &p->tune_type, 0, "%s.tune-type", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->tune_mode, 0, "%s.tune-mode", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &p->tune_start, 0, "%s.tune-start", name));
    COMP_TRY(export_debug(p, name));
    p->own_command_deriv = p->command_deriv;
    p->own_feedback_deriv = p->feedback_deriv;
    return hal_export_functf(do_pid_calcs, p, 1, 0, comp_id, "%s.do-pid-calcs", name);
}

static int export_all(void)
{
    int i;
    pids = hal_malloc((long)sizeof *pids * controllers);
    if(!pids) return -ENOMEM;
    for(i = 0; i < controllers; i++) {
        char name[HAL_NAME_LEN + 1];
        if(names[i] && names[i][0]) rtapi_snprintf(name, sizeof name, "%s", names[i]);
        else rtapi_snprintf(name, sizeof name, "pid.%d", i);
        COMP_TRY(export_pid(&pids[i], name));
    }
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    COMP_TRY(controllers = comp_instances("PID", num_chan, names, MAX_CHAN, 3));
    comp_id = hal_init("pid");
    if(comp_id < 0) return comp_id;
    r = export_all();
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
