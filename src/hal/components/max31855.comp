// SPDX-License-Identifier: GPL-2.0-or-later
component max31855 "Thermocouple converters MAX31855 on bit-banged SPI";
pin in bit data.#.in[15 : personality] "Data out of the converter.";
pin out bit cs.out "Chip select, inverted, common to all.";
pin out bit clk.out "Clock, common to all.";
pin out float temp_celsius.#[15 : personality] "Temperature.";
pin out float temp_fahrenheit.#[15 : personality] "Temperature.";
pin out float temp_kelvin.#[15 : personality] "Temperature.";
pin out bit fault.#[15 : personality] "The converter reports a fault.";
pin out u32 fault_flags.#[15 : personality] "Bit 0: open, bit 1: short to ground, bit 2: short to supply.";
option data converter_state;
option extra_setup;
option period no;
function bitbang_spi "Moves one clock edge; temperatures change after a whole reading.";
description """
The personality is the number of converters, 1 to 15. All are read together, each with a data pin of its own. The
function is called at most at 10 MHz, twice for a bit.

The converter assumes a straight line; the reading is corrected by the ITS-90 polynomials of type K. While a
converter reports a fault its temperatures stay as they are.
""";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
#define CONVERTERS 15
#define FIRST_BIT 32                    /* one before the word, without meaning */
#define PAUSE (2 * FIRST_BIT + 1)       /* calls between readings, as many as a reading takes */

typedef struct {
    int begun, bit, wait;
    rtapi_u32 word[CONVERTERS];
    unsigned char told[CONVERTERS];
} converter_state;

EXTRA_SETUP() {
    if(personality > CONVERTERS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "max31855: %d converters, at most %d\n", personality, CONVERTERS);
        return -EINVAL;
    }
    return 0;
}

static double polynomial(const double *c, int n, double x) {
    double sum = 0;
    while(n-- > 0) sum = sum * x + c[n];
    return sum;
}

#define EVALUATE(c, x) polynomial(c, sizeof(c) / sizeof((c)[0]), x)

/* Voltage in mV of a type K thermocouple at t degrees Celsius (NIST ITS-90). */
static double voltage(double t) {
    static const double below[] = {
        0, 0.394501280250e-01, 0.236223735980e-04, -0.328589067840e-06, -0.499048287770e-08, -0.675090591730e-10,
        -0.574103274280e-12, -0.310888728940e-14, -0.104516093650e-16, -0.198892668780e-19, -0.163226974860e-22,
    };
    static const double above[] = {
        -0.176004136860e-01, 0.389212049750e-01, 0.185587700320e-04, -0.994575928740e-07, 0.318409457190e-09,
        -0.560728448890e-12, 0.560750590590e-15, -0.320207200030e-18, 0.971511471520e-22, -0.121047212750e-25,
    };
    double d = t - 0.126968600000e+03;
    if(t < 0) return EVALUATE(below, t);
    return EVALUATE(above, t) + 0.118597600000e+00 * exp(-0.118343200000e-03 * d * d);
}

/* Temperature in degrees Celsius for e mV; fallback beyond the polynomials. */
static double temperature(double e, double fallback) {
    static const double cold[] = {
        0, 2.5173462e+01, -1.1662878e+00, -1.0833638e+00, -8.9773540e-01, -3.7342377e-01, -8.6632643e-02,
        -1.0450598e-02, -5.1920577e-04,
    };
    static const double warm[] = {
        0, 2.508355e+01, 7.860106e-02, -2.503131e-01, 8.315270e-02, -1.228034e-02, 9.804036e-04, -4.413030e-05,
        1.057734e-06, -1.052755e-08,
    };
    static const double hot[] = {
        -1.318058e+02, 4.830222e+01, -1.646031e+00, 5.464731e-02, -9.650715e-04, 8.802193e-06, -3.110810e-08,
    };
    if(e < 0) return EVALUATE(cold, e);
    if(e < 20.644) return EVALUATE(warm, e);
    if(e < 54.886) return EVALUATE(hot, e);
    return fallback;
}

static void evaluate(struct __comp_state *__comp_inst, int i) {
    rtapi_u32 word = data.word[i];
    double raw = ((rtapi_s32)word >> 18) * 0.25;
    double inside = ((rtapi_s32)(word << 16) >> 20) * 0.0625, celsius;
    fault_flags(i) = word & 7;
    fault(i) = fault_flags(i) != 0;
    if(fault(i)) {
        if(!data.told[i])
            rtapi_print_msg(RTAPI_MSG_ERR, "max31855: sensor %d detected fault %x\n", i, (unsigned)(word & 7));
        data.told[i] = 1;
        return;
    }
    data.told[i] = 0;
    celsius = temperature(0.041276 * (raw - inside) + voltage(inside), raw);
    temp_celsius(i) = celsius;
    temp_fahrenheit(i) = celsius * 9 / 5 + 32;
    temp_kelvin(i) = celsius + 273.15;
}

FUNCTION(bitbang_spi) {
    int i;
    clk_out = !clk_out;
    if(!data.begun) {
        data.begun = 1;
        data.bit = FIRST_BIT;
        return;
    }
    if(cs_out) {
        if(--data.wait <= 0) {
            cs_out = 0;
            data.bit = FIRST_BIT;
        }
        return;
    }
    if(!clk_out) return;
    for(i = 0; i < personality; i++) {
        if(data.bit == FIRST_BIT) data.word[i] = 0;
        else data.word[i] |= (rtapi_u32)(data_in(i) != 0) << data.bit;
    }
    if(data.bit-- > 0) return;
    for(i = 0; i < personality; i++) evaluate(__comp_inst, i);
    cs_out = 1;
    data.wait = PAUSE;
}
