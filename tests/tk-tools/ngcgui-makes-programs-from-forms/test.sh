#!/bin/bash
# ngcgui: forms from subroutine files, what is refused and why, programs of calls and of expanded bodies that the
# interpreter runs alike, files of gcmc, the window by hand.
export HOME=$PWD PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
mkdir subs
cat > subs/pocket.ngc <<'NGC'
(info: a square pocket)
o<pocket> sub
    #<side> = #1 (=10.5 length of a side)
    #<depth> = #2 (=-1)
    #<feed>=#3 (feed, must be given)
    #<times> = #<_remaining_features:>
o<loop> repeat [2]
    G1 X#<side> F#<feed>
    G1 Z[#<depth> * #4]
    G1 X0 Z0
o<loop> endrepeat
o<pocket> endsub
m2
NGC
printf 'o<other> sub\no<other> endsub\n' > subs/wrongname.ngc
printf 'o<text> sub\no<text> endsub\nG0 X1\n' > subs/text.ngc
printf 'o<open> sub\nG0 X1\n' > subs/open.ngc
printf 'o<two> sub\no<two> endsub\no<two> sub\no<two> endsub\n' > subs/two.ngc
printf 'o<hole> sub\n#<a> = #1\n#<b> = #3\no<hole> endsub\n' > subs/hole.ngc
printf 'o<num> sub\no100 repeat [2]\no100 endrepeat\no<num> endsub\n' > subs/num.ngc
printf 'o<many> sub\n#<a> = #31\no<many> endsub\n' > subs/many.ngc
printf '(not_a_subfile)\no<not> sub\no<not> endsub\n' > subs/not.ngc
printf '// ngcgui: info: from gcmc\n//ngcgui: -q\n//ngcgui: width = 3;5, the width\n//ngcgui: width = 4\n//ngcgui: height\n' > subs/shape.gcmc
printf 'G21 G90\nG0 X0 Y0 Z0\n' > pre.ngc
/usr/bin/python3 -c 'from PIL import Image; Image.new("RGB", (800, 400), "#c04020").save("subs/pocket.jpg")'
/usr/bin/python3 forms.py
printf '#!/bin/sh\necho "$@" > gcmc.words\necho "G0 X1" > "$2"\n' > gcmc; chmod +x gcmc; cp subs/pocket.jpg subs/shape.jpg
printf '[DISPLAY]\nGCMC_INCLUDE_PATH = lib:~/own\nNGCGUI_SUBFILE_PATH = subs\nNGCGUI_SUBFILE = shape.gcmc\nNGCGUI_POSTAMBLE = :M9\nNGCGUI_OPTIONS = nom2 noiframe\nNGCGUI_FONT = Helvetica ten\n' > shape.ini
PATH=$PWD:$PATH timeout 60 ../../lib/with-display /usr/bin/python3 settings.py
for f in calls expanded; do rs274 -g $f.ngc -i subs.ini 2>&1 | sed -E 's/^ *[0-9]+ +N[.0-9]+ *//' | grep -E "STRAIGHT_FEED|DWELL|rror" > $f.run; echo "$f: $(grep -c FEED $f.run)"; done
cmp calls.run expanded.run && head -3 calls.run
timeout 60 ../../lib/with-display /usr/bin/python3 clicks.py
cat auto.ngc
rm -rf subs pre.ngc *.run calls.ngc expanded.ngc auto.ngc{,.bak} subs.ini shape.ini gcmc gcmc.words \
    /tmp/ngcgui_bak{,-$UID}/{calls,expanded,auto}.ngc 2>/dev/null || true      # those of another user stay
