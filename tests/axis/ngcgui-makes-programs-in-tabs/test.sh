#!/bin/bash
# [DISPLAY]TKPKG = Ngcgui 1.0: a tab for each subfile and a Custom one; features of all tabs become one program that AXIS opens.
. "$TEST_DIR/../lib/machine.sh"
export PYTHONPATH="$top/tests/lib:$PYTHONPATH"
mkdir subs scratch; export TMPDIR=$PWD/scratch
printf '(info: a line)\no<line> sub\n#<x> = #1 (=10 to X)\nG1 X#<x> F600\no<line> endsub\n' > subs/line.ngc
printf 'o<hop> sub\n#<z> = #1 (=20)\nG0 Z#<z>\no<hop> endsub\n' > subs/hop.ngc
mkdir more; mv subs/hop.ngc more/
printf 'G53 G0 Z0\nM9\nM2\n' > more/post.ngc
ini_edit="s|^DISPLAY = .*|&\nTKPKG = Ngcgui 1.0\nTKPKG = NoSuch 1.0\nNGCGUI_SUBFILE = line.ngc\nNGCGUI_SUBFILE = hop.ngc\nNGCGUI_SUBFILE = \"\"\nNGCGUI_PREAMBLE = :G21 G90 G54\nNGCGUI_POSTAMBLE = post.ngc\nNGCGUI_FONT = {DejaVu Serif} -14 italic\nNGCGUI_OPTIONS = nonew noauto nom2\nNGCGUI_SUBFILE_PATH = $PWD/none:$PWD/more|; s|^PARAMETER_FILE.*|&\nSUBROUTINE_PATH = $PWD/subs:$PWD/more|"
screen_test mill script.py
sed "s|$PWD|.|g" machine/transcript
grep -v -E '^(Note|task:)' screen.err | grep -i -A20 -E 'traceback|error'; grep -A30 Traceback screen.log
rm -rf machine home subs more scratch screen.log screen.err
