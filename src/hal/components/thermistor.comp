// SPDX-License-Identifier: GPL-2.0-or-later
component thermistor "Temperature from a thermistor in a voltage divider";
pin in float t0_c "Temperature at which the thermistor has *r0*, in degrees Celsius.";
pin in float r0 "Resistance of the thermistor at *t0-c*.";
pin in float beta "Beta of the thermistor.";
pin in float r_other "The other resistor of the divider.";
pin in float v_total "Voltage over both.";
pin in float v_thermistor "Voltage over the thermistor.";
pin out float temperature_c "Temperature in degrees Celsius.";
pin out float temperature_k "Temperature in kelvins; 9999 when it cannot be found.";
pin out float temperature_f "Temperature in degrees Fahrenheit.";
pin out float resistance "Resistance of the thermistor; 0 when it cannot be found.";
option userspace;
include <rtapi_math.h>;
include <kerf_clock.h>;
include <signal.h>;
description """
Ten times a second the temperature is computed with the Beta equation, 1/T = 1/T0 + ln(R/R0) / beta.
""";
examples """
----
loadusr -W thermistor names=bed
setp bed.t0-c 25
setp bed.r0 100000
----
""";
license "GPL";
author "Kerf developers";
;;
#define PERIOD_NS 100000000
#define UNKNOWN 9999.0

static volatile sig_atomic_t ended;

static void end(int signal_number) {
    (void)signal_number;
    ended = 1;
}

/* Resistance in ohms, 0 when the voltages make no sense. */
static double find_resistance(double total, double over, double other) {
    double current = (total - over) / other, r;
    if(!(other > 0) || !(current > 0)) return 0;
    r = over / current;
    return isfinite(r) && r > 0 ? r : 0;
}

/* Kelvins, UNKNOWN when the data make no sense. */
static double find_temperature(double r, double t0, double at_t0, double b) {
    double at_infinity = at_t0 * exp(-b / t0), kelvin;
    if(!(t0 > 0) || !(at_infinity > 0) || !(r > 0)) return UNKNOWN;
    kelvin = b / log(r / at_infinity);
    return isfinite(kelvin) && kelvin >= 0 ? kelvin : UNKNOWN;
}

static void update(struct __comp_state *__comp_inst) {
    double r = find_resistance(v_total, v_thermistor, r_other);
    double kelvin = find_temperature(r, t0_c + 273.15, r0, beta);
    resistance = kelvin == UNKNOWN ? 0 : r;
    temperature_k = kelvin;
    temperature_c = kelvin - 273.15;
    temperature_f = temperature_c * 9 / 5 + 32;
}

void user_mainloop(void) {
    signal(SIGTERM, end);
    signal(SIGINT, end);
    kerf_clock_join("thermistor", KERF_CLOCK_PRIO_USER);
    while(!ended) {
        FOR_ALL_INSTS() update(__comp_inst);
        kerf_clock_sleep_ns(PERIOD_NS);
    }
    kerf_clock_leave();
}
