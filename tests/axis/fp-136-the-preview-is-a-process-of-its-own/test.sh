#!/bin/bash
# FP-130, FP-136: the preview's process may hang, crash or want more memory than it gets, be cancelled or stopped by the clock: the screen
# goes on, tells it once, and the limits are checked all the same. It ends with the screen, like filters.
# What is shown is what task opened, also when somebody edits the file meanwhile.
. "$TEST_DIR/../lib/machine.sh"
printf 'o1 while [1]\nG1 X1 F100\nG1 X0\no1 endwhile\nM2\n' > endless.ngc
printf 'G21 G90\nG0 X0 Y0 Z0\nG1 X5 F3000\nG1 X0\nG4 P2\nM2\n' > part.ngc
{ printf 'G21 G90\nG0 X0 Y0 Z0\no1 repeat [300000]\nG1 X5 F3000\nG1 X0\no1 endrepeat\nG1 X4000\nM2\n'; } > beyond.ngc


printf 'G21 G90\nG0 X0 Y0 Z0\nG1 X[10*#<_hal[joint.0.homed]>] F3000\nM2\n' > pins.ngc
printf 'M400\nM2\n' > fork-hangs.ngc; printf 'M401\nM2\n' > fork-crashes.ngc
cat > toplevel.py <<'PY'
import remap
PY
cat > remap.py <<'PY'
import os, signal, time


def fork():
    child = os.fork()
    if child == 0:
        time.sleep(60)
        open(os.path.dirname(__file__) + "/forked-ended", "w").close()
        os._exit(0)
    with open(os.path.dirname(__file__) + "/forked", "w") as f:
        f.write(str(child))


def hangs(self, **words):
    fork()
    time.sleep(60)


def crashes(self, **words):
    fork()
    os.kill(os.getpid(), signal.SIGSEGV)
    time.sleep(60)
PY
ini_edit="s|^\[RS274NGC\]|[PYTHON]\nTOPLEVEL = $PWD/toplevel.py\nPATH_PREPEND = $PWD\n\n&\nREMAP = M400 modalgroup=10 python=hangs\nREMAP = M401 modalgroup=10 python=crashes|"
screen_test mill operator_script.py
cat machine/transcript
echo "told in the log:"; grep -h '^axis: ' screen.err screen.log | sed 's#/.*/##' | sort | uniq -c
/usr/bin/python3 "$TEST_DIR/killed.py" "$PWD"
rm -rf machine home forked* remap.py toplevel.py __pycache__ ./*.ngc var* screen.log screen.err
