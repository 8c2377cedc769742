#!/bin/bash
# Command lines of halsampler and halstreamer: every error, its text and status; modules that
# have nothing to do do not load and leave nothing.
say() { "$@" 2>&1; echo "=> $?"; }
for program in halsampler halstreamer; do
    say $program -c 8
    say $program -c x
    say $program -z
    say $program a b
    say $program -c 3
done
say halsampler -n -1
say halsampler -n 1x
say halsampler -n
say halstreamer -n 1
set +x; exec 2>&1
realtime="$EMC2_HOME/scripts/realtime"
trap '$realtime stop >/dev/null 2>&1' EXIT
$realtime start >host.txt 2>&1
say rtapi_app load sampler
say rtapi_app load sampler depth=0 cfg=f
say rtapi_app load streamer depth=5 cfg=q
say rtapi_app load sampler depth=5,5 cfg=f,fffffffffffffffffffffff
say rtapi_app load streamer depth=5 cfg=f
say rtapi_app load threads name1=a period1=1000000 name2=b period2=500000
halcmd list comp | sed 's/halcmd[0-9]*/halcmd/'
halcmd list pin
printf '1\n2\n3' | halstreamer missing-file; echo "=> $?"
printf '1\n2\n3' | halstreamer; echo "=> $?"
halcmd list thread
grep -v -e '^Note: ' -e '^  Process cap' -e '^  Falling back' -e '^  Fix: ' -e '^  Override' -e '^No isolated CPU' host.txt
rm host.txt
