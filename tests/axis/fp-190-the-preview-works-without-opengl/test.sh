#!/bin/bash
# FP-189, FP-190: with OpenGL, without it, on a display without GLX, with a driver that crashes or hangs, without the usual
# fonts: the screen starts within a time limit, shows the program and says why there is no OpenGL. Without any font it says so.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90 F1000\nG0 X0 Y0 Z0\nG1 X40\nG1 Y30\nG1 X0\nG1 Y0\nM2\n' > part.ngc
echo "== as the display has it"
screen_test mill look.py "$PWD/part.ngc"
sed 's/OpenGL\|drawn/a picture/' machine/transcript
for why in off crashing hanging; do
    echo "== $why"
    case $why in
        off) KERF_OPENGL=0 screen_test mill look.py "$PWD/part.ngc" ;;
        *) PYTHONPATH="$TEST_DIR/$why:$PYTHONPATH" screen_test mill look.py "$PWD/part.ngc" ;;
    esac
    cat machine/transcript
    grep -h "without OpenGL" screen.log screen.err | sed 's/status -[0-9]*/status -N/'
    grep -i -A8 traceback screen.err
done
echo "== another font"
mkdir font
cp "$(fc-match -f '%{file}' 'DejaVu Sans Mono')" font/
fonts() { printf '<fontconfig><dir>%s</dir><cachedir>%s/cache</cachedir></fontconfig>\n' "$PWD/$1" "$PWD" > fonts.conf; }
fonts font
export FONTCONFIG_FILE=$PWD/fonts.conf
XDG_DATA_DIRS=/none screen_test mill look.py "$PWD/part.ngc"      # where Pillow looks for fonts
sed 's/OpenGL\|drawn/a picture/' machine/transcript
grep -i -A8 traceback screen.err
PATH=/none XDG_DATA_DIRS=/none /usr/bin/python3 -c 'from kerf.gltext import Glyphs; g = Glyphs(13); print("letters of the program itself:", len(g.index) > 90)'
echo "== no font"
fonts none
../../lib/with-display 800x600 axis -ini machine/mill.ini 2>&1 < /dev/null
unset FONTCONFIG_FILE
rm -rf font fonts.conf cache
echo "== no GLX"
XVFB_OPTIONS="-extension GLX" ../../lib/with-display 800x600 /usr/bin/python3 -c 'from kerf import gl; print(gl.Probe().result())'
rm -rf machine home part.ngc screen.log screen.err
