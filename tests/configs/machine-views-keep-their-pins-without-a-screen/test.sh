#!/bin/bash
# Each machine view makes its documented pins at once where no display is, also in virtual time, where time
# does not stand for a program that never joins the clock.
unset DISPLAY
export KERF_CLOCK=virtual
views="5axisgui hbmgui hexagui lineardelta rotarydelta maho600gui max5gui melfagui millturngui puma560gui pumagui scaragui
xyzab-tdr-gui xyzac-trt-gui xyzbc-trt-gui"
{
    for v in $views; do echo "loadusr -W $v"; done
    echo "show pin"
    } > views.hal
halrun -f views.hal 2> errors.tmp | awk 'NF == 5 && $3 ~ /IN|OUT/ { print $2, $3, $5 }'
printf 'loadusr -W 5axisgui pivot_len=120.5\ngetp 5axisgui.pivot_len\n' > views.hal
halrun -f views.hal 2>> errors.tmp
grep -c "has not joined" errors.tmp
rm -f views.hal errors.tmp
