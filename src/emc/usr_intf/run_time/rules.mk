# SPDX-License-Identifier: GPL-2.0-or-later
# kerf-time: how long a program will run; the planner of motion on paper.
$(eval $(call program,kerf-time,$(addprefix src/emc/usr_intf/run_time/,kerf_time.cc run_time.cc) \
    $(addprefix src/emc/task/,dry_run.cc task_canon.cc task_canon_curves.cc) $(TP_SOURCES) src/emc/canon/hal_number.cc $(CLIENT_SOURCES) src/emc/nml/emc_args.cc, \
    nml linuxcncini rs274 tooldata linuxcnchal,-Isrc/libnml -Isrc/emc/nml -Isrc/emc/task -Isrc/emc/usr_intf))
