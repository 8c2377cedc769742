// SPDX-License-Identifier: GPL-2.0-or-later
//
// rcs.hh - the classic names, for client programs that were written with them: also emc.hh,
// emc_nml.hh and nml_oi.hh. Link with -llinuxcnc -lnml. [any]
//
//     RCS_CMD_CHANNEL command(emcFormat, "emcCommand", "xemc", "linuxcnc.nml");
//     EMC_TASK_SET_STATE m;
//     m.state = EMC_TASK_STATE_ESTOP_RESET;
//     command.write(&m);
#ifndef KERF_RCS_HH
#define KERF_RCS_HH

#include "linklist.hh"
#include "messages.hh"
#include "nml.hh"
#include "rcs_print.hh"
#include "sem.hh"
#include "shm.hh"
#include "timer.hh"

using RCS_CMD_CHANNEL = NML;
using RCS_STAT_CHANNEL = NML;
// What a channel may carry: first argument of its constructor.
inline const nml::MessageSet &emcFormat = emc_messages(), &nmlErrorFormat = emc_messages();

#endif
