#!/bin/bash
# Tcl package Hal: results, errors, commands as Tcl commands. No realtime process.
cat > t.tcl <<'TCL'
proc try {script} {
    set status [catch {uplevel 1 $script} result]
    puts "$script -> [expr {$status ? "ERROR " : ""}]<$result>"
}
puts "argv <$argv>"
try {hal newsig a bit}
try {newsig f float}
try {sets f 6.28/360*2}
try {set x 4; sets f $x*2}
try {hal gets f}
try {sets a TRUE}
try {hal gets a}
try {sets a yess}
try {stype f}
try {hal list sig}
try {show sig f}
try {hal show sig f}
try {hal lock tune}
try {hal newsig b bit}
try {unlock}
try {print hello}
try {delsig a}
try {hal getp none}
try {net s none}
try {nonsense}
try {hal nonsense}
try {hal quit}
try {hal}
try {setp}
try {hal save sig}
try {list x y}
try {llength [hal --commands]}
try {lsort [info commands unlinkp*]}
try {pin_exists x}
puts "package [package present Hal] [package present Linuxcnc]"
foreach name {HOME BIN_DIR TCL_DIR HELP_DIR RTLIB_DIR NCFILES_DIR REALTIME RUN_IN_PLACE} {
    puts "$name [expr {[set linuxcnc::$name] ne ""}]"
}
TCL
haltcl t.tcl one 'two words' 2>&1 | sed 's/^show sig f -> .*/&/'
echo "=> ${PIPESTATUS[0]}"
echo 'error "went wrong"' > bad.tcl
haltcl bad.tcl 2>&1 | head -1; echo "=> ${PIPESTATUS[0]}"
printf 'newsig q bit\nhal list sig\n' | haltcl | tr -d '\r' | grep -v '^$'; echo "=> ${PIPESTATUS[1]}"
rm -f t.tcl bad.tcl
