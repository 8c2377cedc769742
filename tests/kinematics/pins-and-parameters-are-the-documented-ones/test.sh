#!/bin/bash
# Type, direction, initial value and name of every pin and parameter of every kinematics module.
trap 'rm -f kins.tmp.hal' EXIT
for module in trivkins corexykins rotatekins maxkins rosekins tripodkins lineardeltakins rotarydeltakins scorbot-kins \
    5axiskins xyzac-trt-kins xyzbc-trt-kins xyzab_tdr_kins xyzacb_trsrn xyzbca_trsrn millturn userkins matrixkins scarakins \
    pumakins three21kins genserkins genhexkins pentakins; do
    echo "== $module"
    # some make their pins when motmod asks for their type
    printf '%s\n' "loadrt $module" "loadrt tpmod" "loadrt homemod" "loadrt motmod num_joints=9" "show pin" "show param" "show funct" > kins.tmp.hal
    halrun -s -f kins.tmp.hal 2>/dev/null | grep -vE ' (joint|axis|spindle|motion|iocontrol)[.-]' |
        sed -E 's/^[0-9]+ +//; s/ +/ /g; s/ [0-9a-f]{8,}//g; s/^ //' | grep -E 'kins|userk|skgui|millturn|trsrn|tdr' | grep -v '\.time$\|tmax' | sort
done
