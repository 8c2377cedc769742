// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc.hh - a classic name of what rcs.hh has.
#include "rcs.hh"
