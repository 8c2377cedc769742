#!/bin/bash
# TWOPASS: what is wrong is told with the file; the exit status is 1; other files are executed.
run() { # title; HALFILE lines are made of the files named
    echo "# $1"
    shift
    printf '[HAL]\nTWOPASS = on\n' > t.ini
    for f in "$@"; do echo "HALFILE = $f" >> t.ini; done
    realtime start > log.txt 2>&1
    ${BEFORE:-true}
    halcmd_twopass t.ini > out.txt 2>&1 < /dev/null
    echo "=> $?"
    grep -v '^ *(\|^ *while\|^ *invoked' out.txt | sed 's/halcmd[0-9]*/halcmdPID/; s|[^ ]*/rtapi_app|rtapi_app|'
    halcmd -Q unload all
    realtime stop
}
echo 'loadrt and2 count=1' > count.hal
echo 'loadrt and2 names=x' > names.hal
echo 'gets some' > gets.hal
printf 'loadrt or2\nnonsense\n' > bad.hal
printf 'setp or2.0.in0 1\nputs "after: [hal getp or2.0.in0]"\n' > good.tcl
printf 'error "on purpose [::tp::passnumber]"\n' > err.tcl
printf '# NoTwoPass\nnewsig alone bit\n' > alone.hal
halcmd_twopass; echo "=> $?"
run 'count and names are mixed' count.hal names.hal
BEFORE='halcmd loadrt and2' run 'loaded before' count.hal
run 'missing file' count.hal none.hal
run 'gets' gets.hal
run 'unknown command, the next file is still executed' bad.hal good.tcl
run 'error in a Tcl file' err.tcl bad.hal
echo 'loadrt no-such-module' > module.hal
run 'a module that cannot be loaded' module.hal
run 'no parameters' LIB:none.hal
echo "# halrun without TWOPASS"; printf '[HAL]\nHALFILE = bad.hal\n' > t.ini; halrun t.ini 2>/dev/null; echo "=> $?"
rm -f *.hal *.tcl t.ini log.txt out.txt
