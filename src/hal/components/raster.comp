// SPDX-License-Identifier: GPL-2.0-or-later
component raster "Power of a laser from a row of pixels";
pin in float position "Position along the row.";
pin in bit reset "TRUE: clears a fault and the port.";
pin in port program "Rows: offset;bits per pixel;pixels per unit;count;hexadecimal pixels.";
pin in bit run "TRUE: executes the row in the port.";
pin out bit enabled "A row is being executed.";
pin out float output = -1.0 "Power in percent; -1: off.";
pin out bit fault "The row has a mistake.";
pin out signed fault_code "1 offset, 2 bits per pixel, 3 pixels per unit, 4 count, 5 pixels, 6 length.";
pin out signed state "0 idle, 1 running, 2 fault.";
pin out float program_position "Position where the row was started.";
pin out float program_offset "Distance from there to the first pixel; negative: runs backward.";
pin out signed bpp "Bits per pixel, 4 to 32, a multiple of 4.";
pin out float ppu "Pixels per unit of length.";
pin out signed count "Number of pixels.";
pin out float bitmap_position "Position in pixels.";
pin out float current_pixel_value = -1.0 "Value of the pixel ahead.";
pin out float previous_pixel_value = -1.0 "Value of the pixel behind.";
pin out signed current_pixel_index = -1 "Number of the pixel ahead.";
pin out float fraction "Place between both, 0 to 1.";
function _ "Updates the output.";
option period no;
description """
Between two pixels the power is interpolated. A pixel whose bits are all ones is off.
""";
see_also "laserpower(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include <stdlib.h>;
;;
enum { IDLE, RUN, FAULT };
enum { BAD_OFFSET = 1, BAD_BPP, BAD_PPU, BAD_COUNT, BAD_PIXEL, BAD_LENGTH };

static void fail(struct __comp_state *__comp_inst, int code) {
    state = FAULT;
    fault_code = code;
}

/* Takes the text up to the next semicolon, which must come within max
 * characters. Returns 0 if there is none. */
static int take_field(struct __comp_state *__comp_inst, char *text, unsigned max) {
    unsigned n;
    for(n = 0; n < max; n++) {
        if(!hal_port_read(program_ptr, &text[n], 1)) return 0;
        if(text[n] == ';') {
            text[n] = 0;
            return n > 0;
        }
    }
    return 0;
}

static int take_float(struct __comp_state *__comp_inst, double *value) {
    char text[33], *end;
    if(!take_field(__comp_inst, text, 32)) return 0;
    *value = strtod(text, &end);
    return *end == 0 && isfinite(*value);
}

static int take_int(struct __comp_state *__comp_inst, rtapi_s32 *value) {
    char text[11], *end;
    long number;
    if(!take_field(__comp_inst, text, 10)) return 0;
    number = strtol(text, &end, 10);
    *value = (rtapi_s32)number;
    return *end == 0;
}

/* Header of a row; 0 or the code of the mistake. */
static int read_header(struct __comp_state *__comp_inst) {
    double number;
    rtapi_s32 whole;
    if(!take_float(__comp_inst, &number)) return BAD_OFFSET;
    program_offset = number;
    if(!take_int(__comp_inst, &whole) || whole < 4 || whole > 32 || whole % 4) return BAD_BPP;
    bpp = whole;
    if(!take_float(__comp_inst, &number) || !(number > 0)) return BAD_PPU;
    ppu = number;
    if(!take_int(__comp_inst, &whole) || whole < 2) return BAD_COUNT;
    count = whole;
    if(hal_port_readable(program_ptr) != (unsigned)(bpp / 4) * (unsigned)count) return BAD_LENGTH;
    return 0;
}

/* Value of the next pixel in percent, -1 for off; 0 on a mistake. */
static int next_pixel(struct __comp_state *__comp_inst, double *value) {
    char digits[9], *end;
    unsigned n = (unsigned)bpp / 4;
    rtapi_u64 all = ((rtapi_u64)1 << bpp) - 1, number;
    unsigned i;
    if(!hal_port_read(program_ptr, digits, n)) return 0;
    digits[n] = 0;
    for(i = 0; i < n; i++)
        if(!strchr("0123456789abcdefABCDEF", digits[i]) || !digits[i]) return 0;
    number = strtoull(digits, &end, 16);
    *value = number == all ? -1 : 100.0 * (double)number / (double)(all - 1);
    return 1;
}

static void run_row(struct __comp_state *__comp_inst) {
    double at = (position - (program_position + program_offset)) * ppu * (program_offset < 0 ? -1 : 1);
    bitmap_position = at;
    if(!run) {
        state = IDLE;
        hal_port_clear(program_ptr);
        return;
    }
    enabled = 1;
    while(current_pixel_index < count - 1 && current_pixel_index < at) {
        double value;
        current_pixel_index++;
        previous_pixel_value = current_pixel_value;
        if(!next_pixel(__comp_inst, &value)) {
            fail(__comp_inst, BAD_PIXEL);
            return;
        }
        current_pixel_value = value;
    }
    if(fabs(at - current_pixel_index) < 1e-4) {
        output = current_pixel_value;
    } else if(fabs(at - (current_pixel_index - 1)) < 1e-4) {
        output = previous_pixel_value;
    } else if(at > current_pixel_index - 1 && at < current_pixel_index
              && current_pixel_value >= 0 && previous_pixel_value >= 0) {
        fraction = at - (current_pixel_index - 1);
        output = previous_pixel_value + fraction * (current_pixel_value - previous_pixel_value);
    }
}

FUNCTION(_) {
    output = -1;
    enabled = 0;
    if(reset) {
        state = IDLE;
        fault = 0;
        fault_code = 0;
        hal_port_clear(program_ptr);
        return;
    }
    if(state == FAULT) {
        fault = 1;
    } else if(state == IDLE) {
        bitmap_position = 0;
        current_pixel_value = -1;
        previous_pixel_value = -1;
        current_pixel_index = -1;
        if(run) {
            int mistake = read_header(__comp_inst);
            if(mistake) {
                fail(__comp_inst, mistake);
            } else {
                state = RUN;
                program_position = position;
            }
        }
    } else {
        run_row(__comp_inst);
    }
}
