#!/bin/bash
# Version 1.0: spindle pins. Before: axes become joints and axes. The old files are kept.
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
printf '[EMC]\nVERSION = 1.0\n[HAL]\nHALFILE = a.hal\n' > "$out/a.ini"
printf 'net s motion.spindle-speed-out => pid.command\nnet f halui.spindle.forward\nnet o halui.spindle.override.value\n' > "$out/a.hal"
echo y | (cd "$out" && update_ini a.ini) | sed "s|$out|DIR|"
cat "$out/a.ini" "$out/a.hal"; ls "$out/a.old"
printf '[EMC]\nVERSION = $Revision$\n[TRAJ]\nAXES = 2\nCOORDINATES = X Z\nMAX_VELOCITY = 3\n[RS274NGC]\nFEATURES = 12\n[HAL]\nHALFILE = b.hal\n[AXIS_0]\nMIN_LIMIT = -1\nMAX_VELOCITY = 2\nHOME_SEQUENCE = -1\n[AXIS_2]\nMIN_LIMIT = -2\n[MINE]\nA = 1\n' > "$out/b.ini"
printf 'loadrt trivkins\nloadrt motmod num_joints=[TRAJ]AXES\nnet x axis.0.motor-pos-cmd\nnet z axis.2.joint-pos-cmd\nsetp axis.2.jog-scale 1\nnet w axis.0.jog-counts <= mpg.counts\nsetp pid.maxout [AXIS_2](MAX_OUTPUT)\nsetp scale.0.gain [TRAJ]MAX_VELOCITY\nnet j halui.jog.2.plus halui.joint.2.select halui.jog.selected.minus\nnet s halui.jog-speed halui.axis.0.pos-feedback\n' > "$out/b.hal"
(cd "$out" && update_ini -f b.ini); ls "$out"
sed "s/created .* by/created DATE by/" "$out/b.ini"; cat "$out/b.hal"
(cd "$out" && update_ini b.ini)
echo "status $?"
printf '[EMC]\nVERSION = 1.0\n' > "$out/c.ini"
echo n | (cd "$out" && update_ini c.ini > /dev/null; echo "status $?"); cat "$out/c.ini"
(cd "$out" && update_ini nowhere.ini 2>&1 | sed "s|$out|DIR|"; echo "status ${PIPESTATUS[0]}")
# Bytes that are no UTF-8 stay; no answer means no; what can't be done is told, and nothing has changed.
printf '# Gr\xfc\xdfe\n[EMC]\nVERSION = 1.0\n[HAL]\nHALFILE = d.hal\n' > "$out/d.ini"; printf '# Gr\xfc\xdfe\nnet f halui.spindle.forward\n' > "$out/d.hal"
set +x
(cd "$out"; update_ini d.ini < /dev/null > /dev/null; echo "status $?"; env -u DISPLAY update_ini -d d.ini 2>&1; echo "status $?"
LC_ALL=C.UTF-8 update_ini -f d.ini; cat -v d.ini d.hal; ls | grep '^d'
printf '[EMC]\nVERSION = 1.0\n' > d.ini; (ulimit -f 0; update_ini -f d.ini; echo "status $?"); cat d.ini
) 2>&1 | sed "s|$out|DIR|g"
