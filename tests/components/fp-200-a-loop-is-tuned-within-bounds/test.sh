#!/bin/bash
# FP-200: simulated axes behind two first-order lags and an integrator. speed: a drive that takes a speed; current: one that
# takes a torque; wrong: its feedback has the wrong sign; linked: a signal drives a gain.
export KERF_CLOCK=virtual
trap 'rm -f t.hal' EXIT
axes="speed current wrong linked"
{
    echo 'loadrt threads name1=servo period1=1000000'
    echo "loadrt pid names=${axes// /,}"
    echo "loadrt lowpass names=$(printf '%s.a,%s.b,' $(printf '%s %s ' speed speed current current wrong wrong linked linked))"
    echo "loadrt integ names=$(printf ',%s.x' $axes | cut -c2-)"
    for axis in $axes; do
        printf "addf $axis.%s servo\n" a b x do-pid-calcs
        printf "net $axis.%s $axis.%s $axis.%s\n" 1 output a.in 2 a.out b.in 3 b.out x.in 4 x.out feedback
        printf "setp $axis.%s\n" 'Pgain 20' 'FF1 1' 'enable 1' 'a.gain 0.2' 'b.gain 0.1' 'x.gain 1'
    done
    printf "setp %s\n" 'current.a.gain 0.3' 'current.b.gain 0.02' 'wrong.x.gain -1'
    echo 'net gain linked.Pgain'
    echo 'start'
    echo 'loadusr -w bash tunes.sh'
} | sed 's/,$//' > t.hal
halrun -f t.hal 2>&1
