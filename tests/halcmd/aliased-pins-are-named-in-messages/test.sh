#!/bin/bash
# Messages about a pin with an alias: `net` names it by its alias, which is its current name;
# the HAL library repeats the name that the command used.
cat > t.hal <<'HAL'
loadrt and2 count=3
loadrt sum2
alias pin and2.0.in0 al.in0
alias pin and2.0.out al.out
alias pin and2.1.out zz.out
alias pin and2.1.in0 al.1.in0
net s1 and2.0.in0
net s2 and2.0.in0
newsig f float
net f and2.0.out
net s1 and2.0.out
net s1 and2.1.out
net s3 sum2.0.in0 and2.1.in0
linkps and2.0.out f
linkps and2.1.in0 f
linkps al.1.in0 f
linkps and2.1.out s1
setp and2.0.out 1
setp al.in0 1
alias pin and2.0.in1 al.in0
alias pin and2.0.in1 and2.0.in0
show alias
show sig
HAL
realtime start 2>/dev/null
halcmd -kf t.hal 2>&1
echo "=> $?"
halcmd unload all
realtime stop
rm -f t.hal
