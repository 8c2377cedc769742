// SPDX-License-Identifier: GPL-2.0-or-later
//
// offsets_now.hh - order of the list: from here on these offsets (Interp::OFFSETS parameters)
// are in force. It never leaves task. [task]
#ifndef KERF_OFFSETS_NOW_HH
#define KERF_OFFSETS_NOW_HH

#include "interp.hh"
#include "nml.hh"

struct OffsetsNow : RCS_CMD_MSG {
    static constexpr NMLTYPE NUMBER = 900001;
    OffsetsNow() : RCS_CMD_MSG(NUMBER, sizeof(OffsetsNow)) {}
    double values[Interp::OFFSETS];
};

#endif
