#!/bin/bash
# Three processes link, unlink, create, delete, add and remove functions at random while two
# threads run at full speed and a fourth process loads and unloads modules. No value is torn,
# no function runs twice, the database stays in order.
. ../module-tree.sh
module_tree stress.c
export KERF_CLOCK=real
tree/bin/rtapi_app start 2>/dev/null
halcmd loadrt threads name1=fast period1=50000 name2=slow period2=200000
halcmd loadrt stress
halcmd start
(while :; do
    tree/bin/rtapi_app load not count=5 || echo "load failed"
    halcmd addf not.3 slow || echo "addf failed"
    tree/bin/rtapi_app unload not || echo "unload failed"
    [ ! -e done ] || break
done) &
"$EMC2_HOME/objects/test/hal-robust" threads 3 "${CHANGES:-40000}" 1
touch done
wait
rm done
halcmd unloadrt stress
halcmd unloadrt threads
halcmd list pin
halcmd list funct
