#!/bin/bash
# A HAL file loads a PyVCP panel: without a screen the panel has its pins all the same, the machine runs, and
# panel and server end with it.
unset DISPLAY
here=$PWD; rm -rf work; trap 'rm -rf "$here/work"' EXIT
cp -r ../../../configs/sim/panel work
cd work
printf 'loadusr -Wn pyvcp pyvcp -c pyvcp panel.xml\nsource panel_postgui.hal\nshow pin pyvcp\n' > load.hal
sed -i 's/^HALFILE = buttons.hal/&\nHALFILE = load.hal/; s/^POSTGUI.*//; s,^PROGRAM_PREFIX.*,PROGRAM_PREFIX = .,' panel.ini
cat > see <<'END'
#!/bin/sh
halcmd show pin pyvcp | grep -c '[<=]=[=>]'
END
chmod +x see
KERF_CLOCK=virtual linuxcnc -r -D ./see panel.ini < /dev/null > log 2> errors; echo "status $?"
grep '^[0-9][0-9]*$' log
grep '^pyvcp' errors
grep -c Traceback errors || :
