#!/bin/bash
# FP-060, FP-061, FP-130, FP-131, FP-134, FP-136, FP-138, FP-139, FP-183 to FP-188: what an operator meets at the screen.
. "$TEST_DIR/../lib/machine.sh"
cat > part.ngc <<'NGC'
G21 G90 G17 G64 P0.01
G0 X0 Y0 Z50
G1 X50 F1000
G4 P2
G1 Y20
o<helper> call
G1 X0 Y0
M2
NGC
printf 'o<helper> sub\n\n\n\n\n\n\n\n\n\nG1 X30 F300\nG1 Y0\no<helper> endsub\nM2\n' > helper.ngc
printf 'G1 X3 Y1 F100\nG2 X5 Z0 R1\nM2\n' > plain.ngc
printf 'o1 while [1]\nG1 X1 F100\nG1 X0\no1 endwhile\nM2\n' > endless.ngc
printf 'G21\nG1 X1 F100\nG1 X Y2\nM2\n' > broken.ngc
ini_edit="s|^DISPLAY = .*|&\nSELECT_MOVED_AXIS = 1|; s|^\[RS274NGC\]|&\nSUBROUTINE_PATH = $PWD|
1i [FILTER]\nwait = $PWD/silent"
printf '#!/bin/bash\nfor n in {1..600}; do [ -e "$GO" ] && exec cat "$1"; sleep 0.05; done\n' > silent; chmod +x silent; cp part.ngc part.wait
screen_test mill operator_script.py "$PWD/part.ngc"
sed "s#/tmp/axis-[^/]*/##; s#$PWD/##g" machine/transcript
ls home/.axis_reports | wc -l
grep -h -o "RuntimeError: on purpose" home/.axis_reports/* | head -1
grep -c -h "jog_plus\|estop_clicked" home/.axis_reports/* | grep -vc '^0'
rm -rf machine home silent part.wait ./*.ngc screen.log screen.err
