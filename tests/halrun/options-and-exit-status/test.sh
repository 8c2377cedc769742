#!/bin/bash
# halrun: files, options, refusals and exit status; nothing is left running.
say() { echo "=> $?"; }
run() { echo "\$ halrun $*"; halrun "$@" 2>err.txt </dev/null; say; grep -v '^Note\|^  \|^No isol' err.txt; }
printf 'loadrt and2\nlist funct\n' > good.hal
printf 'loadrt and2\nnonsense\nlist funct\n' > bad.hal
printf 'puts [hal list comp]\nputs "args:$::argv ini:[info exists ::A(B)]"\n' > ok.tcl
printf 'error failed-on-purpose\n' > bad.tcl
printf '[A]\nB = 7\n' > plain.ini
printf '[HAL]\nTWOPASS = on\nHALFILE = good.hal\n' > two.ini
printf 'print [A]B\n' > ini.hal
run good.hal
run -f good.hal
run -k bad.hal
run bad.hal
run -s good.hal
run -i plain.ini ini.hal
run -v good.hal | sed 's|[^ ]*/rtapi_app|rtapi_app|'
run ok.tcl | sed 's/halcmd[0-9]*/halcmdPID/'
run -i plain.ini ok.tcl | sed 's/halcmd[0-9]*/halcmdPID/'
run bad.tcl | grep '^\$\|^=>\|^failed'
run plain.ini
run two.ini
run a.hal b.hal
run -f good.hal bad.hal
run file.txt
run -T -v ok.tcl
run missing.hal
run -Z | sed 's|^[^ ]*halrun: |halrun: |'
halrun -h | grep -c '^Usage'
echo "# commands on standard input"
printf 'loadrt or2\nnonsense\nlist funct\n' | halrun 2>/dev/null; say
echo "# a session within a session is refused"
printf 'loadusr -w ./again\n' > outer.hal
printf '#!/bin/sh\nhalrun good.hal 2>&1\necho "status $?"\nexit 0\n' > again
chmod +x again
run outer.hal
echo "# -U ends what is left"
realtime start > /dev/null 2>&1; halcmd loadrt and2; halrun -U; say
realtime status
rm -f good.hal bad.hal ok.tcl bad.tcl plain.ini two.ini ini.hal outer.hal again err.txt
