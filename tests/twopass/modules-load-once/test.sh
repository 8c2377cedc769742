#!/bin/bash
# TWOPASS: several files load parts of one module; each module is loaded once with the sum.
# Continued lines, comments, INI references, Tcl files with arguments, list and source work.
mkdir -p lib
cat > t.ini <<'INI'
[NAMES]
SECOND = and2 count=1
[VALUES]
GAIN = 2.5
[HAL]
TWOPASS = on, verbose
HALFILE = one.hal
HALFILE = two.tcl 17 x
HALFILE = lib/three.hal
INI
printf '\xef\xbb\xbf' > one.hal # a byte order mark, as editors for Windows put it in front
cat >> one.hal <<'HAL'
# first file
loadrt threads name1=t \
  period1=1000000   # continued
loadrt and2 count=2
loadrt mux2 names=a.m
loadrt [NAMES](SECOND)
loadusr -w no-such-program-for-twopass
loadusr -w true
addf and2.0 t
addf and2.1 t   ; # trailing
net n1 and2.0.out => and2.1.in0
setp a.m.in0 [VALUES]GAIN
HAL
sed -i 's/   ; # trailing/   # trailing/' one.hal
cat > two.tcl <<'TCL'
if {[::tp::passnumber] == 0} { ::tp::no_puts } else { puts "pass 1: args $::argv" }
puts "pass [::tp::passnumber]"
loadrt and2 count=$::argc
loadrt mux2 names=b.m,c.m
loadrt pid num_chan=1 debug=1
addf a.m t
addf b.m t
setp b.m.in1 $::VALUES(GAIN)*2
TCL
cat > lib/three.hal <<'HAL'
loadrt pid num_chan=2 debug=2
source lib/four.hal
list funct a.m
HAL
cat > lib/four.hal <<'HAL'
addf c.m t 1
net n2 c.m.out => pid.0.command
HAL
cat > check.hal <<'HAL'
save comp
save netla
save thread
getp a.m.in0
getp b.m.in1
list funct pid
HAL
realtime start > log.txt 2>&1
halcmd_twopass t.ini 2>&1
echo "=> $?"
halcmd -f check.hal
halcmd unload all
realtime stop
ls /tmp/tmp_one.hal* /tmp/tmp_three.hal* 2>/dev/null | grep "${KERF_INSTANCE:-hal}\$"
rm -rf lib t.ini one.hal two.tcl check.hal log.txt
