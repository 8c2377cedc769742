#!/bin/bash
# hal_stream reads what a sampler wrote; every misuse is told.
cat > t.tcl <<'TCL'
proc try {script} {
    set status [catch {uplevel 1 $script} result]
    puts "$script -> [expr {$status ? "ERROR " : ""}]<$result>"
}
hal loadrt threads name1=t period1=1000000
hal loadrt sampler depth=20 cfg=bfsulk
hal addf sampler.0 t
foreach {pin value} {0 1 1 2.5 2 -7 3 4000000000 4 -5000000000 5 9000000000000000000} { hal setp sampler.0.pin.$pin $value }
try {hal_stream}
try {hal_stream attach}
try {hal_stream attach zz b}
try {hal_stream attach 0x48534130 f}
try {hal_stream attach 0x48534130 bfsulk}
try {hal_stream attach 0x48534130 BFSULK}
try {hal_stream maxdepth 0}
try {hal_stream readable 0}
try {hal_stream read 0}
try {hal_stream depth 0}
hal start
while {[hal_stream depth 0] < 3} { hal --sleep 1 }
hal stop
hal --sleep 5
try {hal_stream readable 0}
try {hal_stream read 0}
set rest [hal_stream drain 0]
puts "rest: [expr {[llength $rest] >= 12 && [llength $rest] % 6 == 0}] [lrange $rest 0 5]"
try {hal_stream depth 0}
try {hal_stream depth}
try {hal_stream frob 0}
try {hal_stream frob 7}
try {hal_stream read x}
for {set i 2} {$i < 16} {incr i} { hal_stream attach 0x48534130 "" }
TCL
sed -i '$d' t.tcl
cat >> t.tcl <<'TCL'
for {set i 2} {$i < 16} {incr i} { hal_stream attach 0x48534130 bfsulk }
try {hal_stream attach 0x48534130 bfsulk}
try {hal_stream detach 5}
try {hal_stream depth 5}
try {hal_stream attach 0x48534130 bfsulk}
TCL
halrun t.tcl 2>&1 | grep -v '^Note\|^  \|^No isol'
echo "=> ${PIPESTATUS[0]}"
rm -f t.tcl
