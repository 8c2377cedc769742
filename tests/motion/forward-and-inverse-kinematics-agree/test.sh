#!/bin/bash
# Every kinematics module: 10,000 random points of its work space go through both
# directions and come back (kinscheck; seeds of iterative solvers are slightly off).
unset KERF_CLOCK
log=$(mktemp); trap 'realtime stop >/dev/null 2>&1; rm -f "$log"' EXIT
# MODULE "COMMANDS;..." kinscheck-parameters
one() {
    local module=$1 commands=$2 line
    shift 2
    realtime start > "$log" 2>&1
    halcmd loadrt $module
    while IFS= read -r -d ';' line; do halcmd $line; done <<< "$commands${commands:+;}"
    halcmd loadrt kinscheck "$@" 2>&1
    realtime stop
    echo "$module: $(sed -n 's/^kinscheck: \(.* bad\).*/\1/p' "$log")"
    grep "first bad" "$log" || :
}
one corexykins "" "ranges=-100:100,-100:100,-100:100,-9:9,-9:9,-9:9,-9:9,-9:9,-9:9"
one rotatekins "" "ranges=-100:100,-100:100,-100:100,-9:9,-9:9,-900:900,-9:9,-9:9,-9:9"
one maxkins "" "ranges=-100:100,-100:100,-100:100,-9:9,-90:90,-900:900,-9:9,-9:9,-9:9"
one maxkins "setp maxkins.conventional-directions 1;setp maxkins.pivot-length 123" "ranges=-100:100,-100:100,-100:100,-9:9,-90:90,-900:900,-9:9,-9:9,-9:9"
one rosekins "" "ranges=1:100,-100:100,-2000:2000"
one tripodkins "setp tripodkins.Bx 100;setp tripodkins.Cx 30;setp tripodkins.Cy 120" by=pose "ranges=-100:100,-100:100,-100:100"
one scorbot-kins "" "ranges=-170:170,10:90,-85:5,-9:9,-9:9"
one lineardeltakins "" by=pose "ranges=-80:80,-80:80,-300:100,-9:9,-9:9,-9:9,-9:9,-9:9,-9:9"
one rotarydeltakins "" by=pose "ranges=-5:5,-5:5,-20:-8,-9:9,-9:9,-9:9,-9:9,-9:9,-9:9"
one 5axiskins "" "ranges=-500:500,-500:500,-500:500,-100:100,-400:400,-50:50"
for c in 0 1; do
one xyzac-trt-kins "setp xyzac-trt-kins.x-rot-point 11;setp xyzac-trt-kins.y-rot-point 7;setp xyzac-trt-kins.z-rot-point -31;setp xyzac-trt-kins.y-offset 20;setp xyzac-trt-kins.z-offset 10;setp xyzac-trt-kins.tool-offset 50;setp xyzac-trt-kins.conventional-directions $c" "ranges=-500:500,-500:500,-500:500,-100:100,-400:400"
one xyzbc-trt-kins "setp xyzbc-trt-kins.x-rot-point 11;setp xyzbc-trt-kins.y-rot-point 7;setp xyzbc-trt-kins.z-rot-point -31;setp xyzbc-trt-kins.x-offset 20;setp xyzbc-trt-kins.z-offset 10;setp xyzbc-trt-kins.tool-offset 50;setp xyzbc-trt-kins.conventional-directions $c" "ranges=-500:500,-500:500,-500:500,-100:100,-400:400"
done
one scarakins "" "ranges=-170:170,-150:150,-100:100,-180:180,-9:9,-9:9"
one pumakins "" "ranges=-170:170,-220:40,-50:220,-110:170,-100:100,-260:260"
one three21kins "" "ranges=-170:170,-220:40,-50:220,-110:170,-100:100,-260:260"
one genserkins "" "ranges=-170:170,-220:40,-50:220,-110:170,10:100,-260:260,-9:9,-9:9,-9:9" perturb=10 joint_tolerance=100000000
one genhexkins "" by=pose "ranges=-5:5,-5:5,20:40,-20:20,-20:20,-20:20" perturb=10000
one genhexkins "setp genhexkins.screw-lead 0.2" by=pose "ranges=-5:5,-5:5,20:40,-20:20,-20:20,-20:20" perturb=10000
one pentakins "" by=pose "ranges=-50:50,-50:50,200:400,-15:15,-15:15" perturb=50
P=xyzab_tdr_kins; one $P "setp $P.tool-offset-z 50;setp $P.z-offset 12;setp $P.x-rot-point 3;setp $P.y-rot-point -7;setp $P.z-rot-point 20" "ranges=-500:500,-500:500,-500:500,-100:100,-400:400" type=1
for t in 1 2; do
P=xyzacb_trsrn_kins; one xyzacb_trsrn "setp $P.tool-offset-z 50;setp $P.x-offset 3;setp $P.y-offset 5;setp $P.z-pivot 150;setp $P.y-pivot 12;setp $P.y-rot-axis 77;setp $P.z-rot-axis -90;setp $P.nut-angle 50;setp $P.pre-rot 0.3;setp $P.primary-angle 33;setp $P.secondary-angle -71" "ranges=-500:500,-500:500,-500:500,-100:100,-400:400,-90:90" type=$t
P=xyzbca_trsrn_kins; one xyzbca_trsrn "setp $P.tool-offset-z 50;setp $P.x-offset 3;setp $P.y-offset 5;setp $P.z-pivot 150;setp $P.x-pivot 12;setp $P.x-rot-axis 77;setp $P.z-rot-axis -90;setp $P.nut-angle 50;setp $P.pre-rot 0.3;setp $P.primary-angle 33;setp $P.secondary-angle -71" "ranges=-500:500,-500:500,-500:500,-100:100,-400:400,-90:90" type=$t
done
one millturn "" "ranges=-500:500,-500:500,-500:500,-100:100" type=1
one matrixkins "setp matrixkins.C_xy 0.01;setp matrixkins.C_zx -0.02" "ranges=-100:100,-100:100,-100:100,-9:9,-9:9,-9:9,-9:9,-9:9,-9:9"
one userkins "" "ranges=-500:500,-500:500,-500:500"
