# SPDX-License-Identifier: GPL-2.0-or-later
CLIENT_SOURCES := src/emc/usr_intf/client.cc src/emc/nml/messages.cc
$(eval $(call pymodule,linuxcnc,$(addprefix src/emc/usr_intf/python/,linuxcncmodule.cc ini.cc positionlogger.cc) $(CLIENT_SOURCES), \
    nml linuxcncini tooldata linuxcnchal,-Isrc/libnml -Isrc/emc/nml -Isrc/emc/task -Isrc/emc/usr_intf -fvisibility=hidden))
$(eval $(call program,halui,src/emc/usr_intf/halui/halui.cc src/emc/nml/emc_args.cc $(CLIENT_SOURCES),nml linuxcncini tooldata linuxcnchal, \
    -Isrc/libnml -Isrc/emc/nml -Isrc/emc/task -Isrc/emc/usr_intf))
$(eval $(call program,linuxcncrsh,$(addprefix src/emc/usr_intf/rsh/,main.cc session.cc arguments.cc subcommands.cc) src/emc/nml/emc_args.cc $(CLIENT_SOURCES),nml linuxcncini linuxcnchal, \
    -Isrc/libnml -Isrc/emc/nml -Isrc/emc/task -Isrc/emc/usr_intf))
$(foreach s,mdi schedrmt linuxcnclcd axis-remote pyvcp pyvcp_demo mtconnect-agent,$(eval $(call script,$(s),src/emc/usr_intf/scripts/$(s))))
$(eval $(call program,tool_watch,src/emc/usr_intf/tool_watch.cc $(CLIENT_SOURCES),nml linuxcncini tooldata linuxcnchal, \
    -Isrc/libnml -Isrc/emc/nml -Isrc/emc/task -Isrc/emc/usr_intf))

.PHONY: bench-axis bench-axis-loading bench-clients bench-preview
bench-axis: all
	bash -c '. scripts/rip-environment && KERF_INSTANCE=axisbench exec /usr/bin/python3 src/emc/usr_intf/bench/axis_bench.py'
bench-axis-loading: all
	bash -c '. scripts/rip-environment && KERF_INSTANCE=axisbench exec /usr/bin/python3 src/emc/usr_intf/bench/axis_load_bench.py'
bench-clients: all
	bash -c '. scripts/rip-environment && exec /usr/bin/python3 src/emc/usr_intf/bench/clients_bench.py'
bench-preview: all
	bash -c '. scripts/rip-environment && exec /usr/bin/python3 src/emc/usr_intf/bench/preview_bench.py'
BENCHES += bench-axis bench-axis-loading bench-clients bench-preview

# A day of the machine (SOAK_HOURS) in virtual time, about an hour: not among the benches of every day. A long run tells its looks in
# SOAK_LOG and ends with a figure after SOAK_WALL_S seconds of wall time.
.PHONY: bench-soak
bench-soak: all
	bash -c '. scripts/rip-environment && cd tests/small-tools/fp-137-programs-that-run-long-keep-their-size && \
	    SOAK_HOURS=$(or $(SOAK_HOURS),24) SOAK_LOG=$(abspath $(or $(SOAK_LOG),objects/soak.log)) MACHINE_TEST_S=36000 KERF_INSTANCE=soak bash test.sh'

# What FP-119, FP-122 and FP-125 ask for in full: ten million commands handed to motion, ten thousand probe moves, a thousand starts.
# A quarter of an hour on a busy machine, so not among the benches of every day.
.PHONY: bench-handover bench-probes
bench-handover: all $(O)/test/motion-handover
	$(O)/test/motion-handover $(or $(COMMANDS),10000000)
bench-probes: all
	bash -c '. scripts/rip-environment && cd tests/task/probes-and-switching-on-never-miss-a-beat && \
	    PROBES=$(or $(PROBES),10000) STARTS=$(or $(STARTS),1000) MACHINE_TEST_S=36000 KERF_INSTANCE=probes bash test.sh'

# The screen with OpenGL and its machine for HOURS of virtual time, memory of every process by the way; ends with status 1 when one grows.
.PHONY: bench-axis-soak
bench-axis-soak: all
	rm -f $(O)/axis-soak.txt
	SOAK_HOURS=$(or $(HOURS),10) SOAK_REPORT=$(abspath $(O))/axis-soak.txt KERF_INSTANCE=axissoak scripts/runtests -p --timeout 36000 tests/axis/memory-does-not-grow; \
	    status=$$?; cat $(O)/axis-soak.txt; exit $$status

# Every tool that has a window or lives long for HOURS of its own time (MINUTES of wall time at most; TOOLS=a,b: only these), what each weighs in
# objects/tools-soak.txt; ends with status 1 when one grows. A day of all takes hours of wall time.
.PHONY: bench-tools-soak
bench-tools-soak: all
	bash -c '. scripts/rip-environment && HOURS=$(or $(HOURS),24) MINUTES=$(or $(MINUTES),600) TOOLS="$(TOOLS)" KERF_INSTANCE=toolsoak \
	    exec /usr/bin/python3 src/emc/usr_intf/bench/tools_soak.py'
