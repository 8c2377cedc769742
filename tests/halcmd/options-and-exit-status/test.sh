#!/bin/bash
# How halcmd is called, what it returns. No realtime process.
say() { echo "=> $?"; }
halcmd | head -2; say
halcmd -h | grep -c -- '-R'
halcmd -h getp; say
halcmd help help; say
halcmd help nothing; say
halcmd -Z 2>&1; say
halcmd -i x.ini getp a 2>&1; say
halcmd -f missing.hal 2>&1; say
halcmd -f - 2>&1; say
halcmd -f -i missing.ini x.hal 2>/dev/null; say
halcmd frobnicate 2>&1; say
halcmd setp a '' 2>&1; say
halcmd a = 5 2>&1; say
halcmd net 2>&1; say
halcmd print a b 2>&1; say
halcmd newsig s junk 2>&1; say
halcmd quit 2>&1; say
halcmd -q delsig all 2>&1; say
halcmd -Q show nothing; say
halcmd -R; say
printf 'bad\nprint after\n' > t.hal
halcmd -f t.hal 2>&1; say
halcmd -kf t.hal 2>&1; say
halcmd -fk t.hal 2>&1; say
halcmd -f < t.hal 2>&1; say
echo "# success is told with -v"
printf 'newsig a bit\nlock tune\nunlock\ndelsig a\nwaitusr nobody\n' | halcmd -v -f; say
echo "# script mode"
printf 'newsig a bit\nnewsig b float\nsets b 1.5\nnewsig c u32\nsets c 255\nshow sig\nshow comp\n' > t.hal
halcmd -s -f t.hal | sed 's/halcmd[0-9]* */halcmdPID /; s/PID *[0-9]*/PID PID/; s/^ *[0-9]* /ID /'
echo "# completion"
complete() { COMP_LINE="$1" COMP_POINT=${#1} halcmd -C; }
complete 'halcmd sho'
complete 'halcmd -k -s unl'
complete 'halcmd show pa'
complete 'halcmd newsig x f'
complete 'halcmd status '
complete 'halcmd help ne'
complete 'halcmd echo '
rm -f t.hal
