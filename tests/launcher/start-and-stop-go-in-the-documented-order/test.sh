#!/bin/bash
# The order of starting and stopping as the programs see it, what every option does, what the parts find in
# their environment, search paths of HAL files, applications, logs and the lock.
export KERF_CLOCK=virtual KERF_INSTANCE=${KERF_INSTANCE:-order}
top=$(cd ../../.. && pwd)
rm -rf work; mkdir work; home=$(mktemp -d); trap 'cd ..; rm -rf work "$home"' EXIT
cd work
export HOME=$home; mkdir -p lib2 bin; mkdir -p "$home/hal" "$home/.local/bin"; ln -s "$home" home
unset DISPLAY LINUXCNC_OPENGL_PLATFORM
cp "$top"/configs/sim/mill/* .
ini() { sed "$@" "$top/configs/sim/mill/mill.ini" > m.ini; }
clean() { sed -E "s,$home,HOME,g; s,$PWD,HERE,g; s,$top,TOP,g; s,\.$KERF_INSTANCE,,g"; }
run() { linuxcnc "$@" < /dev/null > out 2>&1; status=$?; grep -v '^Note\|^task:\|warning:' out | clean; echo "status $status"; }
printf '#!/bin/sh\necho "display $*"; halcmd list thread > threads; exit 5\n' > bin/show; chmod +x bin/show

echo "== everything, in order"
echo 'loadusr -w echo tilde' > home/hal/tilde.hal
echo 'loadusr -w echo shutdown' > down.hal
echo 'loadusr -w echo from the library folder' > lib2/extra.hal
printf 'puts "tcl [file tail $argv0] args=$argv unit=$::TRAJ(LINEAR_UNITS)"\n' > own.tcl
printf '#!/bin/sh\necho "application $*" > app.out\n' > app.sh; chmod +x app.sh; echo x > noexec
ini 's,^HALFILE = spindle.hal,&\nHALFILE = ~/hal/tilde.hal\nHALFILE = own.tcl one two\nHALFILE = extra.hal\nHALFILE =\nHALFILE = never.hal\nHALCMD = loadusr -w echo command\nSHUTDOWN = down.hal,
     s,^DISPLAY = axis,DISPLAY = show first second,
     $a [APPLICATIONS]\nAPP = ./app.sh a "b c"\nAPP = nothing-of-that-name\nAPP = noexec'
run -r -H lib2 m.ini third fourth
cat threads; for i in 1 2 3 4 5 6 7 8 9; do [ -s app.out ] || sleep 0.3; done; cat app.out
echo "== the same without -r goes to logs; a failing display leaves them at home"
linuxcnc -H lib2 m.ini < /dev/null 2>&1 | grep -v "warning:\|^Note" | clean; echo "status ${PIPESTATUS[0]}"
grep -v '^task:' home/linuxcnc_print* | clean; ls home | sed "s/$KERF_INSTANCE/INSTANCE/"
echo "== environment of the display"
cat > bin/show <<'END'
#!/bin/sh
for v in INI_FILE_NAME CONFIG_DIR LINUXCNC_HOME LINUXCNC_NCFILES_DIR LINUXCNC_TCL_DIR LINUXCNC_EMCSH REALTIME HALCMD HALLIB_DIR HALLIB_PATH \
    HAL_RTMOD_DIR NMLFILE TRAJ_COORDINATES KINS_KINEMATICS PYOPENGL_PLATFORM GDK_BACKEND QT_QPA_PLATFORM; do
    eval echo $v=\$$v
done
echo "$PATH" | tr : "\n" | head -n 1; echo "$PATH" | tr : "\n" | head -n 5 | grep "/\.local/bin"
[ -n "$LINUXCNCVERSION" ] && echo "version known"
pwd; ls /tmp/linuxcnc.lock* > /dev/null && echo "lock there"
END
ini 's,^DISPLAY = axis,DISPLAY = show,'
run -r m.ini | grep -v "^Starting\|^linuxcnc TP\|^Found\|^Shutting"
LINUXCNC_OPENGL_PLATFORM=egl linuxcnc -r m.ini < /dev/null 2> /dev/null | grep PLATFORM
echo "== options"
run -h | head -n 1; run -z | tail -n 1; run -H nowhere m.ini
run -r -t "tpmod x=1" m.ini | grep -i "tpmod\|status" | head -n 3
run -r -m nohome m.ini | grep -i "nohome\|status" | head -n 5
ini '/^EMCMOT = /d; s,^HALFILE = mill.hal,HALFILE = none.hal,'; run -r m.ini | grep EMCMOT=
ini 's,^HALFILE = mill.hal,&\nHALCMD = setp no.such 1\nHALFILE = bad.hal,; s,^DISPLAY = axis,DISPLAY = true,'
printf 'setp no.such.pin 1\nnet x no.such.pin\nloadusr -w echo after\n' > bad.hal
run -r m.ini; run -r -k m.ini
run -l; run -; printf '[PICKCONFIG]\nLAST_CONFIG = %s/m.ini\n' "$PWD" > home/.linuxcncrc
ini 's,^DISPLAY = axis,DISPLAY = true,'
run -r -l | head -n 1; run -r - | tail -n 1
run -r -n m.ini
echo "== what is missing is named"
ini 's,^DISPLAY = axis,DISPLAY = nothing-here,'; run -r m.ini | tail -n 2
ini 's,^DISPLAY = axis,DISPLAY = true,; s,^HALUI.*,HALUI = nothalui,'; run -r m.ini | tail -n 3
ini 's,^DISPLAY = axis,DISPLAY = true,; s,^HALFILE = mill.hal,HALFILE = LIB:none.hal,'; run -r m.ini | tail -n 3
printf '[A\n' > bad.ini; run -r bad.ini; : > empty.ini; run -r empty.ini; run -r none.ini
ls /tmp/linuxcnc.lock* 2> /dev/null | grep -c "$KERF_INSTANCE" || :
