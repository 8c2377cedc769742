#!/bin/bash
# AXIS is closed from outside, or ended by a signal, while it asks something (here: tells a mistake in the program): it ends, and with it the machine.
# A machine whose axes the demonstration does not have begins without one.
. "$TEST_DIR/../lib/machine.sh"
cat > closing.sh <<'SH'
HOME=$PWD/home linuxcnc -r machine/mill.ini "$PWD/bad.ngc" > screen.log 2> screen.err < /dev/null & machine=$!
timeout 30 xdotool search --sync --onlyvisible --class '^Dialog$' > /dev/null || echo "no question"
case $1 in quit) axis-remote --quit ;; *) kill -s $1 $(pgrep -f "axis -ini $PWD/machine/mill.ini") ;; esac
timeout 30 tail --pid=$machine -f /dev/null || { echo "it goes on"; kill $machine; }
wait $machine; echo "closed by $1: $?"
SH
echo 'G1 Q' > bad.ngc
cp -r "$top/configs/sim/mill" machine; mkdir home
for way in quit TERM; do
    [ $way = quit ] || export KERF_CLOCK=
    "$top/tests/lib/with-display" bash closing.sh $way
    grep -i -A8 'traceback\|started again' screen.log screen.err
done
export KERF_CLOCK=virtual
ls home/.axis_reports 2> /dev/null
# A window that ends in Tcl, while Python still wants something of it, is no crash: the machine ends with it.
cat > home/.axisrc <<'RC'
def end():
    root_window.tk.call("destroy", ".")
    root_window.winfo_width()


root_window.after(500, end)
RC
HOME=$PWD/home "$top/tests/lib/with-display" linuxcnc -r machine/mill.ini > screen.log 2> screen.err < /dev/null
echo "ended in Tcl: $?"
grep -i -A8 'traceback\|started again' screen.log screen.err
screen_test mill script.py
cat machine/transcript
rm -rf machine home bad.ngc closing.sh screen.log screen.err
