#!/bin/bash
# Names given to inputs and outputs, numbers of the rest, functions and threads.
list() { # MOTMOD-PARAMETERS: what a kinematics with these parameters shows
    cat > machine.tmp.hal <<END
loadrt trivkins coordinates=xyz
loadrt tpmod
loadrt homemod
loadrt motmod num_joints=1 $1
show pin
show funct
show thread
END
    halrun -s -f machine.tmp.hal 2>/dev/null | sed -E 's/ (0x)?[0-9a-f]{9,}//g; s/ +/ /g; s/^ //' | sort
}
trap 'rm -f machine.tmp.hal' EXIT
for names in "names_dout=a,b names_din=x,y,z num_aio=1" "names_ain=volt names_aout=p,q,r names_misc_errors=oil,air"; do
    echo "== $names"
    list "$names" | grep -oE 'motion\.(ain|aout|analog|err|misc|din|dout|digital).*$' | sort -V
done
echo "== functions and threads"
list "base_period_nsec=30000 servo_period_nsec=1000000" | grep -E '[0-9] YES .*thread|YES [0-9] motion-'
