#!/bin/bash
# [DISPLAY]TKPKG = Ngcguittt 1.0: a page that makes a subfile of a text with the program [DISPLAY]TTT and opens a page
# with it, whose feature runs; what goes wrong is told in the page. A script stands for truetype-tracer.
. "$TEST_DIR/../lib/machine.sh"
export PYTHONPATH="$top/tests/lib:$PYTHONPATH"
mkdir scratch subs bin; export TMPDIR=$PWD/scratch PATH="$PWD/bin:$PATH"
cat > bin/tracer <<'END'
#!/bin/bash
[ "${*: -1}" != fail ] || { echo "no such glyph" >&2; exit 3; }
[ "${*: -1}" != nothing ] || exit 0
echo "(arguments: $*)"
printf '%s\n' '#1=5 (=Safe height)' '#2=-0.5 (Engraving depth)' '#3=2 (XY scale)' '#7=3' 'G0 Z#1' 'G0 X[#3*1] Y0' 'G1 Z#2 F600' 'G1 X[#3*#7]' 'G0 Z#1' M2 %
END
chmod +x bin/tracer
printf '(mine)\n' > subs/ttt_mine.ngc
printf 'G21 G90 G54\n' > subs/metric.ngc
ini_edit="s|^DISPLAY = .*|&\nTKPKG = Ngcgui 1.0\nTKPKG = Ngcguittt 1.0\nTTT = tracer\nTTT_PREAMBLE = metric.ngc|; s|^PARAMETER_FILE.*|&\nSUBROUTINE_PATH = $PWD/subs|"
screen_test mill script.py
sed "s|$PWD|.|g" machine/transcript
sed 's|/[^ ]*/||g' subs/ttt_a_b.ngc
grep -A30 Traceback screen.log screen.err
rm -rf machine home scratch subs bin screen.log screen.err
