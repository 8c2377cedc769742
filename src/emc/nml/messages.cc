// SPDX-License-Identifier: GPL-2.0-or-later
//
// messages.cc - the table of all messages, from messages.def.
#include "messages.hh"

const nml::MessageSet &emc_messages() {
    static const nml::MessageSet set({
#define F(...)
#define S(...)
#define L(...)
#define MSG(NAME, NUMBER, BASE, ...) nml::describe<NAME>(#NAME),
#include "messages.def"
#undef MSG
#undef F
#undef S
#undef L
    });
    return set;
}

const char *emc_symbol_lookup(NMLTYPE type) { return emc_messages().name(type); }
