// SPDX-License-Identifier: GPL-2.0-or-later
//
// emc_tcl.hh - adds the commands that drive the controller to a Tcl interpreter. [init]
#ifndef KERF_EMC_TCL_HH
#define KERF_EMC_TCL_HH

#include <tcl.h>

int emc_tcl_init(Tcl_Interp *interp);

#endif
