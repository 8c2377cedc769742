// SPDX-License-Identifier: GPL-2.0-or-later
component bldc "Commutation of brushless motors";
modparam dummy cfg "Tags of each instance, see below; at most 8 instances.";
pin in bit hall1 if personality & 0x01 "Hall sensor 1.";
pin in bit hall2 if personality & 0x01 "Hall sensor 2.";
pin in bit hall3 if personality & 0x01 "Hall sensor 3.";
pin out bit hall_error if personality & 0x01 "The hall code made an impossible step.";
pin in bit C1 if personality & 0x10 "Fanuc code, bit 0.";
pin in bit C2 if personality & 0x10 "Fanuc code, bit 1.";
pin in bit C4 if personality & 0x10 "Fanuc code, bit 2.";
pin in bit C8 if personality & 0x10 "Fanuc code, bit 3.";
pin in float value "Amplitude of the drive.";
pin in float lead_angle = 90 if personality & 0x06 "Angle between rotor and field in degrees.";
pin in bit rev "Reverse the motor.";
pin in float frequency if (personality & 0x0F) == 0 "Frequency of an open loop motor in Hz.";
pin in float initvalue = 0.2 if personality & 0x04 "Amplitude while looking for the rotor's place.";
pin in signed rawcounts if personality & 0x06 "Counts of the encoder.";
pin io bit index_enable if personality & 0x08 "To the encoder's index-enable.";
pin in bit init if (personality & 0x05) == 0x04 "Rising: looks for the rotor's place.";
pin out bit init_done if (personality & 0x05) == 0x04 "The rotor's place is known.";
pin out float A_value if (personality & 0xF00) == 0 "Amplitude of phase A.";
pin out float B_value if (personality & 0xF00) == 0 "Amplitude of phase B.";
pin out float C_value if (personality & 0xF00) == 0 "Amplitude of phase C.";
pin out bit A_on if (personality & 0xF00) == 0x100 "Phase A.";
pin out bit B_on if (personality & 0xF00) == 0x100 "Phase B.";
pin out bit C_on if (personality & 0xF00) == 0x100 "Phase C.";
pin out float A_high if (personality & 0xF00) == 0x200 "Upper switch of phase A.";
pin out float B_high if (personality & 0xF00) == 0x200 "Upper switch of phase B.";
pin out float C_high if (personality & 0xF00) == 0x200 "Upper switch of phase C.";
pin out float A_low if (personality & 0xF00) == 0x200 "Lower switch of phase A.";
pin out float B_low if (personality & 0xF00) == 0x200 "Lower switch of phase B.";
pin out float C_low if (personality & 0xF00) == 0x200 "Lower switch of phase C.";
pin out bit A_high_on if (personality & 0xF00) == 0x300 "Upper switch of phase A.";
pin out bit B_high_on if (personality & 0xF00) == 0x300 "Upper switch of phase B.";
pin out bit C_high_on if (personality & 0xF00) == 0x300 "Upper switch of phase C.";
pin out bit A_low_on if (personality & 0xF00) == 0x300 "Lower switch of phase A.";
pin out bit B_low_on if (personality & 0xF00) == 0x300 "Lower switch of phase B.";
pin out bit C_low_on if (personality & 0xF00) == 0x300 "Lower switch of phase C.";
pin out bit hall1_out if personality & 0x400 "Hall sensor 1 as a drive wants it.";
pin out bit hall2_out if personality & 0x400 "Hall sensor 2 as a drive wants it.";
pin out bit hall3_out if personality & 0x400 "Hall sensor 3 as a drive wants it.";
pin out bit C1_out if personality & 0x800 "Fanuc code, bit 0.";
pin out bit C2_out if personality & 0x800 "Fanuc code, bit 1.";
pin out bit C4_out if personality & 0x800 "Fanuc code, bit 2.";
pin out bit C8_out if personality & 0x800 "Fanuc code, bit 3.";
pin out float phase_angle "Angle of the field, 0 to 1.";
pin out float rotor_angle "Angle of the rotor, 0 to 1.";
pin out float out "Amplitude with its sign.";
pin out bit out_dir "The amplitude is negative.";
pin out float out_abs "Amplitude without its sign.";
param r signed in_type = -1 "State of the input: -1 begin, -2 error, 2 found.";
param r signed out_type = -1 "Kind of output.";
param rw signed scale = 512 if personality & 0x06 "Counts per revolution.";
param rw signed poles = 4 if personality & 0x06 "Poles of the motor.";
param rw signed encoder_offset if personality & 0x0A "Counts from index or zero to the rotor's zero.";
param r signed offset_measured if personality & 0x04 "Counts found while looking for the rotor's place.";
param rw float drive_offset "Angle that a drive adds, in degrees.";
param rw unsigned output_pattern = 25 if personality & 0x400 "Hall pattern of the output, 0 to 47.";
param rw unsigned pattern = 25 if personality & 0x01 "Hall pattern of the input, 0 to 47.";
variable rtapi_s64 counts;
variable rtapi_s64 change;
variable int last_rawcounts;
variable int old_init;
variable unsigned phases;
variable unsigned old_phases;
variable unsigned old_pattern;
variable int old_code;
variable double counter;
variable double init_angle;
function _ "Updates the outputs.";
option count_function;
option extra_setup;
description """
The tags of *cfg* are letters that say what the motor has and what the drive needs.

Input: n none (open loop), h hall sensors, a absolute encoder, q quadrature encoder, i encoder with index,
f Fanuc code.

Output: none of the following: three amplitudes; B three bits; 6 six amplitudes; B6 six bits; H hall code;
F Fanuc code. T: trapezoidal drive.
""";
examples """
----
loadrt bldc cfg=qi6,aH
----
""";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
#define MAX_INSTANCES 8
#define MAX_TAGS 8
#define PATTERNS 48
#define INIT_SECONDS 2.4

static char *cfg[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(cfg, MAX_INSTANCES, "tags of each instance");

enum {
    HALL = 0x01, ABSOLUTE = 0x02, QUADRATURE = 0x04, INDEX = 0x08, FANUC = 0x10,
    BITS = 0x100, SIX = 0x200, HALL_OUT = 0x400, FANUC_OUT = 0x800, TRAPEZOID = 0x8000
};

/* Switches of the bridge, octal: upper A B C, lower A B C. */
enum { A_UP = 040, B_UP = 020, C_UP = 010, A_DOWN = 004, B_DOWN = 002, C_DOWN = 001 };

/* Excitations in order of the angle, one sixth of a turn apart, from 0 to 7/6. */
static const unsigned char excitation[8] = { 021, 024, 014, 012, 042, 041, 021, 024 };

/* Hall codes for the excitations 024 014 012 042 041 021. */
static const char hall_codes[PATTERNS][7] = {
    "013764", "102675", "023754", "132645", "231546", "320457", "201576", "310467",
    "015762", "104673", "026751", "137640", "237540", "326451", "204573", "315462",
    "045732", "154623", "046731", "157620", "267510", "376401", "264513", "375402",
    "457320", "546231", "467310", "576201", "675102", "764013", "645132", "754023",
    "451326", "540237", "462315", "573204", "673104", "762015", "640137", "751026",
    "401376", "510267", "402375", "513264", "623154", "732045", "620157", "731046",
};
static const unsigned char hall_excitation[6] = { 024, 014, 012, 042, 041, 021 };

/* Excitation for a hall code; 0 for the two codes that are not used. */
static unsigned from_hall(unsigned table, unsigned code) {
    int i;
    for(i = 0; i < 6; i++) if((unsigned)(hall_codes[table][i] - '0') == code) return hall_excitation[i];
    return 0;
}

/* Hall code for an excitation; for none (0) the lower of the two codes that are not used. */
static unsigned to_hall(unsigned table, unsigned ph) {
    unsigned code;
    for(code = 0; code < 8; code++) if(from_hall(table, code) == ph) return code;
    return 0;
}

static double wrapped(double angle) {
    return isfinite(angle) ? angle - floor(angle) : 0;
}

int get_count(void) {
    int n = 0;
    while(n < MAX_INSTANCES && cfg[n] && cfg[n][0]) n++;
    if(n == 0) rtapi_print_msg(RTAPI_MSG_ERR, "bldc: no instances: give their tags with cfg=\n");
    return n;
}

EXTRA_SETUP() {
    static const struct {
        char letter;
        int bit;
    } tags[] = { { 'n', 0 }, { 'h', HALL }, { 'a', ABSOLUTE }, { 'q', QUADRATURE }, { 'i', INDEX },
                 { 'f', FANUC }, { 'B', BITS }, { '6', SIX }, { 'H', HALL_OUT }, { 'F', FANUC_OUT },
                 { 'T', TRAPEZOID } };
    unsigned i, k;
    for(i = 0; i < MAX_TAGS && cfg[extra_arg][i]; i++)
        for(k = 0; k < sizeof tags / sizeof tags[0]; k++)
            if(tags[k].letter == cfg[extra_arg][i]) personality |= tags[k].bit;
    return 0;
}

/* Counts of one electrical revolution (integer, as documented). */
static rtapi_s64 counts_per_turn(struct __comp_state *__comp_inst) {
    return poles ? 2 * (rtapi_s64)scale / poles : 0;
}

static void found(struct __comp_state *__comp_inst, double measured) {
    offset_measured = (rtapi_s32)measured;
    if(!(personality & (HALL | FANUC))) init_done = 1;
    in_type = 2;
}

/* Hall sensors; false when the call must end. */
static int read_halls(struct __comp_state *__comp_inst) {
    int i;
    if(pattern >= PATTERNS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "bldc: hall pattern %u is above %d\n", (unsigned)pattern, PATTERNS - 1);
        pattern = 0;
        return 0;
    }
    phases = from_hall(pattern, 4u * hall1 + 2u * hall2 + hall3);
    for(i = 0; i < 6 && excitation[i] != phases; i++) {}        /* a code that is not used: 1, wrapped to 0 */
    rotor_angle = wrapped(i / 6.0);
    phase_angle = wrapped(rotor_angle + (out_dir ? 0.25 : -0.25));
    if(!(phases & old_phases)) hall_error = 1;
    if(pattern != old_pattern) hall_error = 0;
    if(personality & TRAPEZOID) return 1;
    if(in_type == 5 && old_phases && phases != old_phases) {
        if(phases) rotor_angle = wrapped((i + (excitation[i ? i - 1 : 5] == old_phases ? -0.5 : 0.5)) / 6);
        phase_angle = wrapped(rotor_angle + (out_dir ? -0.25 : 0.25));
        found(__comp_inst, (double)counts - rotor_angle * (double)counts_per_turn(__comp_inst));
    } else if(in_type == (HALL | QUADRATURE | INDEX) && !index_enable) {
        found(__comp_inst, (double)counts);
    }
    old_phases = phases;
    old_pattern = pattern;
    return 1;
}

static void read_fanuc(struct __comp_state *__comp_inst) {
    int gray = C1 | C2 << 1 | C4 << 2 | C8 << 3, code = gray ^ gray >> 2;
    code ^= code >> 1;
    rotor_angle = code / 16.0 + 0.03125;
    if(!(personality & TRAPEZOID)) {
        if(in_type == (FANUC | QUADRATURE) && old_code && gray != old_code) {
            /* The upper edge, but for the codes that happen to be a drive pattern. */
            int lower = code == 0 || (code <= 8 && excitation[code - 1] == old_code);
            rotor_angle = wrapped((code + !lower) / 16.0);
            found(__comp_inst, (double)counts - rotor_angle * (double)counts_per_turn(__comp_inst));
        } else if(in_type == (FANUC | QUADRATURE | INDEX) && !index_enable) {
            found(__comp_inst, (double)counts);
        }
    }
    phase_angle = wrapped(rotor_angle + (out_dir ? -0.25 : 0.25));
    old_code = gray;
}

/* Pulls the rotor to a known place; false when the call must end. */
static int magnetic_init(struct __comp_state *__comp_inst, double *drive, double dt) {
    static const double at[6] = { 2.4, 2.0, 1.2, 0.8, 0.4, 0 };
    static const double size[6] = { 0, 1, 1, 1, 1, 1 };
    static const double angle[6] = { 0, 0, -0.25, 0.25, 0, 0 };
    double share;
    int i;
    if(!init) return 0;
    if(init_done) return 1;
    if(counter <= 0) {
        found(__comp_inst, (double)counts - phase_angle * (double)counts_per_turn(__comp_inst));
        counter = INIT_SECONDS;
        return 0;
    }
    for(i = 0; i < 4 && counter < at[i + 1]; i++) {}
    share = (at[i] - counter) / (at[i] - at[i + 1]);
    *drive = initvalue * (size[i] + share * (size[i + 1] - size[i]));
    phase_angle = wrapped(angle[i] + share * (angle[i + 1] - angle[i]));
    counter -= dt;
    rotor_angle = wrapped(phase_angle - drive_offset / 360);
    return 1;
}

/* Turns slowly until the index; false when the call must end. */
static int index_init(struct __comp_state *__comp_inst, double *drive, double dt) {
    if(!init) return 0;
    if(!index_enable) {
        found(__comp_inst, (double)counts);
    } else {
        rotor_angle = wrapped(rotor_angle + (initvalue < 0 ? -dt : dt));
        phase_angle = rotor_angle;
        *drive = fabs(initvalue);
    }
    return 1;
}

static void follow_encoder(struct __comp_state *__comp_inst) {
    double lead = lead_angle / 360;
    rtapi_s64 at = counts + change / 2;
    if(out_dir && !(personality & TRAPEZOID)) lead = -lead;
    if(personality & QUADRATURE) at -= offset_measured;
    if(personality & (ABSOLUTE | INDEX)) at -= encoder_offset;
    rotor_angle = scale ? wrapped((double)(at * poles / 2) / scale) : 0;
    phase_angle = wrapped(rotor_angle + lead);
}

static void bad_input(struct __comp_state *__comp_inst, int next) {
    rtapi_print_msg(RTAPI_MSG_ERR, "bldc: the input tags do not fit together (type %d)\n", (int)in_type);
    in_type = next;
}

/* The input part; false when the call must end. */
static int read_input(struct __comp_state *__comp_inst, double *drive, double dt) {
    switch(in_type) {
    case -1:
        in_type = personality & 0xFF;
        if(personality & INDEX) index_enable = 1;
        counter = INIT_SECONDS;
        out_type = personality & 0x7F00;
        return 0;
    case -2:
        return 0;
    case 0:
        phase_angle = wrapped(phase_angle + frequency * dt);
        rotor_angle = phase_angle;
        return 1;
    case 0x01: case 0x05: case 0x0D:
        return read_halls(__comp_inst);
    case 0x10: case 0x14: case 0x1C:
        read_fanuc(__comp_inst);
        return 1;
    case 0x02:
        follow_encoder(__comp_inst);
        return 1;
    case 0x04:
        return magnetic_init(__comp_inst, drive, dt);
    case 0x0C:
        return index_init(__comp_inst, drive, dt);
    case 0x03: case 0x0B: case 0x0A:
        bad_input(__comp_inst, 2);
        return 0;
    case 0x09:
        bad_input(__comp_inst, 1);
        return 0;
    default:
        bad_input(__comp_inst, -2);
        return 0;
    }
}

/* The same bridge with upper and lower switches exchanged. */
static unsigned reversed(unsigned ph) {
    return (ph & 070) >> 3 | (ph & 007) << 3;
}

static void write_amplitudes(struct __comp_state *__comp_inst, double drive, int trapezoid, double abc[3]) {
    const double c = -0.5, s = 0.8660254037844386;
    double size = fabs(drive), angle = phase_angle * 2 * M_PI;
    int i;
    (void)__comp_inst;
    for(i = 0; i < 3; i++) {
        if(trapezoid) {
            abc[i] = phases & (A_UP >> i) ? drive : phases & (A_DOWN >> i) ? -drive : 0;
        } else {
            abc[i] = size * (i == 0 ? cos(angle) : c * cos(angle) + (i == 1 ? s : -s) * sin(angle));
        }
    }
}

static void write_bits(struct __comp_state *__comp_inst, unsigned ph) {
    if(!(ph & 070) || !(ph & 007)) {
        A_on = 0;
        B_on = 0;
        C_on = 0;
        return;
    }
    if(ph & A_UP) A_on = 1;
    else if(ph & A_DOWN) A_on = 0;
    if(ph & B_UP) B_on = 1;
    else if(ph & B_DOWN) B_on = 0;
    if(ph & C_UP) C_on = 1;
    else if(ph & C_DOWN) C_on = 0;
}

static void write_hall(struct __comp_state *__comp_inst) {
    unsigned code = output_pattern < PATTERNS ? to_hall(output_pattern, phases) : 0;
    hall1_out = (code & 4) != 0;
    hall2_out = (code & 2) != 0;
    hall3_out = (code & 1) != 0;
}

static void write_fanuc(struct __comp_state *__comp_inst) {
    int i, gray;
    for(i = 0; i < 15 && i / 16.0 + 0.0625 < rotor_angle; i++) {}
    gray = i ^ (i >> 1);
    C1_out = gray & 1;
    C2_out = (gray >> 1) & 1;
    C4_out = (gray >> 2) & 1;
    C8_out = (gray >> 3) & 1;
}

static void write_output(struct __comp_state *__comp_inst, double drive, int trapezoid) {
    unsigned ph = out_dir ? reversed(phases) : phases;
    double abc[3];
    switch(out_type) {
    case 0:
        write_amplitudes(__comp_inst, drive, trapezoid, abc);
        A_value = abc[0];
        B_value = abc[1];
        C_value = abc[2];
        break;
    case SIX:
        write_amplitudes(__comp_inst, drive, trapezoid, abc);
        A_high = fmax(abc[0], 0);
        B_high = fmax(abc[1], 0);
        C_high = fmax(abc[2], 0);
        A_low = fmax(-abc[0], 0);
        B_low = fmax(-abc[1], 0);
        C_low = fmax(-abc[2], 0);
        break;
    case BITS:
        write_bits(__comp_inst, ph);
        break;
    case BITS | SIX:
        A_high_on = (ph & A_UP) != 0;
        B_high_on = (ph & B_UP) != 0;
        C_high_on = (ph & C_UP) != 0;
        A_low_on = (ph & A_DOWN) != 0;
        B_low_on = (ph & B_DOWN) != 0;
        C_low_on = (ph & C_DOWN) != 0;
        break;
    case HALL_OUT:
        write_hall(__comp_inst);
        break;
    case FANUC_OUT:
        write_fanuc(__comp_inst);
        break;
    default:
        rtapi_print_msg(RTAPI_MSG_ERR, "bldc: the output tags do not fit together (type 0x%X)\n", (unsigned)out_type);
        if(out_type == 0xC00 || (out_type & HALL_OUT && out_type < FANUC_OUT)) out_type = HALL_OUT;
        else if(out_type & FANUC_OUT && out_type < 0xC00) out_type = FANUC_OUT;
        else in_type = -2;
    }
}

FUNCTION(_) {
    double drive = rev ? -value : value;
    int trapezoid;
    out_dir = drive < 0;
    out_abs = fabs(drive);
    if((personality & (HALL | QUADRATURE)) == QUADRATURE) {
        if(init && !old_init && init_done) {
            init_done = 0;
            in_type = -1;
        } else {
            old_init = init;
        }
    }
    if(personality & (ABSOLUTE | QUADRATURE)) {
        change = (rtapi_s32)((rtapi_u32)rawcounts - (rtapi_u32)last_rawcounts);
        last_rawcounts = rawcounts;
        counts += change;
    }
    trapezoid = (personality & TRAPEZOID) || in_type == 0x01 || in_type == 0x05 || in_type == 0x0D;
    if(!read_input(__comp_inst, &drive, fperiod)) return;
    if(!trapezoid || !(personality & HALL)) {
        int i;
        for(i = 0; i < 7 && rotor_angle > i / 6.0 - 1.0 / 12; i++) {}
        phases = excitation[i];
    }
    out = drive;
    out_abs = fabs(drive);
    write_output(__comp_inst, drive, trapezoid);
}
