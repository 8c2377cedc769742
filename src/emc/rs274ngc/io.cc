/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * io.cc - inputs and outputs, coolant, overrides, user M codes.
 *
 * Thread: [task]
 * Source: M-codes sheet, sections 6, 7, 8 and 10
 */
#include "stages.hh"

namespace ngc
{
namespace
{

enum { DIGITAL_INPUTS = 64, ANALOG_INPUTS = 64 };

int wait_input(Setup &s)
{
    const Block &b = s.block;
    const int l = b.has('l') ? int(b['l']) : -1;
    const double q = b.value('q', -1);
    CHECK(b.has('p') && b.has('e'), "Invalid to select both a digital and an analog input with M66");
    CHECK(l > 0 && q <= 0, "Zero timeout with wait type != immediate return");
    CHECK(l > WAIT_MODE_LOW,
          "Wait type of M66 is none of 0 to 4 (L word)"); // it would wait for nothing, to the time-out
    CHECK(b.has('e') && l > 0, "Can't select analog input with wait type != immediate return");
    CHECK((b.has('p') && rint(b['p']) < 0) || (b.has('e') && rint(b['e']) < 0) || (!b.has('p') && !b.has('e')),
          "Need to have either a valid P or a valid E word with M66");
    const double timeout = q > 0 ? q : 0;
    const bool digital = b.has('p');
    const double index = rint(b[digital ? 'p' : 'e']);
    CHECK(s.comp_on(), digital ? "Cannot wait for digital input with cutter radius compensation on"
                               : "Cannot wait for analog input with cutter radius compensation on");
    CHECK(digital && index >= DIGITAL_INPUTS, "Digital input selected out of bounds");
    CHECK(!digital && index >= ANALOG_INPUTS, "Analog input selected out of bounds");
    if (s.canon.WAIT(int(index), digital ? DIGITAL_INPUT : ANALOG_INPUT, CANON_WAIT(l > 0 ? l : 0), timeout) == 0) {
        s.input_flag = true;
        s.input_index = int(index);
        s.input_digital = digital;
    }
    return INTERP_OK;
}

} // namespace

int convert_io(Setup &s, int m)
{
    const Block &b = s.block;
    if (m >= 62 && m <= 65) {
        CHECK(s.comp_on(), "Cannot set %s with cutter radius compensation on",
              m == 62 ? "motion output" : m == 63 ? "motion digital output" : "auxiliary digital output");
        CHECK(!b.has('p'), "No valid P word with M%d", m);
        const int index = saturated(rint(b['p']));
        switch (m) {
        case 62: s.canon.SET_MOTION_OUTPUT_BIT(index); break;
        case 63: s.canon.CLEAR_MOTION_OUTPUT_BIT(index); break;
        case 64: s.canon.SET_AUX_OUTPUT_BIT(index); break;
        case 65: s.canon.CLEAR_AUX_OUTPUT_BIT(index); break;
        }
        return INTERP_OK;
    }
    if (m == 66) return wait_input(s);
    CHECK(s.comp_on(), "Cannot set %s analog output with cutter radius compensation on",
          m == 67 ? "motion" : "auxiliary");
    const int index = saturated(rint(b.value('e', -1)));
    CHECK(index < 0, "Invalid analog index with M%d", m);
    const double value = b.value('q', -1);
    if (m == 67)
        s.canon.SET_MOTION_OUTPUT_VALUE(index, value);
    else
        s.canon.SET_AUX_OUTPUT_VALUE(index, value);
    return INTERP_OK;
}

int convert_coolant(Setup &s, int m)
{
    if (m == 7 || m == 9) {
        enqueue_coolant(s, true, m == 7);
        s.mist = m == 7;
    }
    if (m == 8 || m == 9) {
        enqueue_coolant(s, false, m == 8);
        s.flood = m == 8;
    }
    return INTERP_OK;
}

namespace
{

void set_speed_override(Setup &s, int spindle, bool on)
{
    if (on) s.canon.ENABLE_SPEED_OVERRIDE(spindle);
    else s.canon.DISABLE_SPEED_OVERRIDE(spindle);
    s.speed_override[spindle] = on;
}

void set_feed_override(Setup &s, bool on)
{
    if (on) s.canon.ENABLE_FEED_OVERRIDE();
    else s.canon.DISABLE_FEED_OVERRIDE();
    s.feed_override = on;
}

} // namespace

int convert_override(Setup &s, int m)
{
    const Block &b = s.block;
    const bool on = m == 48 || (m != 49 && b.value('p', 1) != 0);
    CHECK(s.comp_on(), "Cannot %s overrides with cutter radius compensation on", on ? "enable" : "disable");
    switch (m) {
    case 48: case 49:
        set_feed_override(s, on);
        for (int i = 0; i < s.num_spindles; ++i) set_speed_override(s, i, on);
        break;
    case 50:
        set_feed_override(s, on);
        break;
    case 51: {
        int first = 0, last = s.num_spindles - 1;
        if (b.has('$')) {
            first = last = int(b['$']);
            CHECK(first <= 0 || first >= s.num_spindles, "Invalid spindle ($) number in M51 command");
        }
        for (int i = first; i <= last; ++i) set_speed_override(s, i, on);
        break;
    }
    case 52:
        if (on) s.canon.ENABLE_ADAPTIVE_FEED();
        else s.canon.DISABLE_ADAPTIVE_FEED();
        s.adaptive_feed = on;
        break;
    case 53:
        if (on) s.canon.ENABLE_FEED_HOLD();
        else s.canon.DISABLE_FEED_HOLD();
        s.feed_hold = on;
        break;
    }
    return INTERP_OK;
}

int convert_user_m(Setup &s)
{
    const Block &b = s.block;
    CHECK(!s.canon.USER_DEFINED_FUNCTION_EXISTS(b.user_m - 100), "Unknown m code used: M%d", b.user_m);
    enqueue_user_m(s, b.user_m - 100, b.value('p', -1), b.value('q', -1));
    return INTERP_OK;
}

} // namespace ngc
