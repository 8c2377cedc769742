#!/bin/bash
# emccalib: values of a running machine are tried, taken back, kept and written into the INI file, where
# nothing else changes: comments, blanks, line ends, included files.
export HOME=$PWD INI_FILE_NAME= HALLIB_DIR= KERF_CLOCK=virtual
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
cp machine.ini.in kept.ini; ln -s kept.ini machine.ini; chmod 640 kept.ini; [ "$(id -u)" != 0 ] || chown nobody kept.ini
mine() { stat -c '%a %U' kept.ini | sed "s/$(id -un)$/nobody/"; }
sed 's/$/\r/' joints.inc.in > joints.inc
realtime start 2> /dev/null
halcmd loadrt pid num_chan=2; halcmd loadrt and2 count=1
for s in "0.Pgain 10" "0.deadband 0.000015" "1.Pgain 2.5" "1.FF1 2.5" "1.FF2 0.25"; do halcmd setp pid.$s; done
LC_ALL=C.UTF-8 timeout 60 "$TEST_DIR/../../lib/with-display" /usr/bin/python3 clicks.py
mine
echo "== changed"; diff machine.ini.in machine.ini; diff <(sed 's/$/\r/' joints.inc.in) joints.inc | sed 's/\r/<CR>/'
test -L machine.ini && diff machine.ini.in kept.ini.bak > /dev/null && echo "the backup is the old file"
printf '[KINS]\nJOINTS=1\n[HAL]\nHALFILE = none.hal\n' > none.ini
"$TEST_DIR/../../lib/with-display" bash -c 'PATH=$EMC2_HOME/tcl/bin:$PATH; emccalib.tcl -- -ini none.ini 2>&1 & pid=$!
    for i in $(seq 100); do xdotool search --name "LinuxCNC Calibration" > /dev/null 2>&1 && break; sleep 0.1; done; sleep 0.3
    for i in $(seq 50); do xdotool key Return; kill -0 $pid 2> /dev/null || break; sleep 0.1; done; wait $pid; echo "status $?"'
realtime stop 2> /dev/null
rm -f machine.ini kept.ini kept.ini.bak joints.inc joints.inc.bak none.ini
