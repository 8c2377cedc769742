#!/bin/bash
# The latency tools state what they measured on, flag runs that say nothing, accept a servo
# thread alone and as many bins as anybody asks for; their maxima never go down; the worst
# jitter ever is kept. In virtual time: every interval is exact.
export KERF_CLOCK=virtual HOME=$PWD/home
mkdir -p home
run() { echo "# $*"; timeout 50 "$@" 2>&1 | grep -v -e '^Note:' -e '^$' -e '^Waiting for component' | sed '/^usage: /d; /^  *\[--/d; /no realtime scheduling/d; s/^realtime: .*; governor: [^;]*; isolcpus: .*/realtime: R; governor: G; isolcpus: I/; /governor is/d; /no processor is isolated/d'; echo "=> ${PIPESTATUS[0]}"; }
run latency-histogram --nox --seconds 2 --bbins 1000 --sbins 1000
run latency-histogram --nox --nobase --seconds 1
run latency-histogram --nox --base 4999
run latency-histogram --nox --bbinsize 15
run latency-plot --nox --points 1 -s 1000000 -b 50000
run latency-test --nox --seconds 1 1ms
run latency-test --nox --seconds 1 1ms 50us
run latency-test --nox --seconds 1 100us 100000
run latency-test 1h
echo 4711 > home/.latency
run latency-test --nox --seconds 1 -
run latency-test --nox --seconds 1 - 2ms | tail -2
cat home/.latency
echo "# ended by a signal"
rm home/.latency
for tool in "latency-test --nox 1ms" "latency-histogram --nox" "latency-plot --nox"; do
    : > ended       # not what the one before wrote
    $tool > ended 2>&1 & pid=$!
    until grep -q "interval\|sdev\|last" ended; do sleep 0.1; done
    kill -HUP $pid
    wait $pid; echo "${tool%% *} => $?"
    realtime status > /dev/null || echo "no session is left"
done
cat home/.latency
echo "# the components go"
for tool in "latency-histogram --nox" "latency-plot --nox"; do
    : > ended       # not what the one before wrote
    $tool > ended 2>&1 & pid=$!
    until grep -q "sdev\|last" ended; do sleep 0.1; done
    halcmd stop; halcmd unloadrt all
    wait $pid; echo "${tool%% *} => $?"
    sed -n '/Traceback/p; s/ (.*//; /nothing is measured/p' ended
    realtime status > /dev/null || echo "no session is left"
done
echo "# the panel dies"
rm home/.latency
: > ended       # not what the one before wrote
latency-test --nox 1ms > ended 2>&1 & pid=$!
until grep -q interval ended; do sleep 0.1; done
kill -KILL $(halcmd show comp lat | awk '$3 == "lat" {print $4}')
wait $pid
cat home/.latency
realtime status > /dev/null || echo "no session is left"
echo "# while another session runs"
realtime start 2> /dev/null
run latency-test --nox --seconds 1 1ms
run latency-histogram --nox --seconds 1
realtime stop
cat > low.py <<'PY'
import sys, os
sys.path.insert(0, os.environ["EMC2_HOME"] + "/lib/python")
from kerf.haltools.latency import ThreadFigures
t = ThreadFigures("servo", 1000000, 100, 200)
t.update(-50, 700, 100.0, None)
t.update(-10, 20, 1.0, None)
print("extremes stay:", t.minimum, t.maximum)
t.update(9, -9, 0.0, None)  # nothing was measured yet: lowest above highest
print("extremes stay:", t.minimum, t.maximum)
PY
/usr/bin/python3 low.py
rm -rf home low.py ended
