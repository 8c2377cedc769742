#!/bin/bash
# FP-188: the screen's process crashes at cycle start (a fault of a library, as the kernel tells it), and so do those that come after
# it: the third is the last, nothing runs, and the session ends. The next start tells the operator, and the report has the stack,
# the configuration's hash and what was done before. An end as it should be leaves nothing.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG1 X20 F600\nM2\n' > part.ngc
cp -r "$top/configs/sim/mill" machine; mkdir home tmp; export TMPDIR=$PWD/tmp
for run in crash look look; do
    RUN=$run HOME=$PWD/home "$top/tests/lib/with-display" 1024x768 linuxcnc -r -D "$PWD/crash.py $PWD/part.ngc" machine/mill.ini > screen.log 2> screen.err < /dev/null
    echo "status $?"
    grep -h "DISPLAY program" screen.err | sed 's|program [^ ]*/|program |'
    ls tmp
    cat machine/transcript
    rm -f machine/transcript
done
ls home/.axis_reports | wc -l
report=$(grep -l " task_run" home/.axis_reports/*)
grep -c "^Fatal Python error: Segmentation fault" "$report"
grep -c "crash.py.* in script" "$report"
grep -c "sha256 $(sha256sum < machine/mill.ini | cut -d' ' -f1)" "$report"
[ $(wc -l < "$report") -lt 2100 ] && echo "no longer than that"
grep -o " task_run" "$report"
rm -rf machine home tmp part.ngc screen.log screen.err
