#!/bin/bash
# FP-168: loadusr -W ends with an error when the program ends, when the name is taken, and
# after HALCMD_WAIT_TIMEOUT seconds; the texts name what was expected and what was found.
cat > comp.py <<'PY'
import signal
import sys
import time
import hal
name, how = sys.argv[1:3]
if how == "late":
    time.sleep(0.3)
c = hal.component(name)
c.newpin("x", hal.HAL_BIT, hal.HAL_OUT)
if how == "dies":
    sys.exit(3)
if how != "never-ready":
    c.ready()
if how == "ends":
    sys.exit(0)
try:
    signal.pause()
except KeyboardInterrupt:
    pass
PY
py=/usr/bin/python3
run() { # title; the file from standard input
    echo "# $1"
    cat > t.hal
    timeout 30 halcmd -k -f t.hal > out.txt 2>&1
    echo "=> $?"
    sed "s|$py|PYTHON|g; s|[^ ]*/rtapi_app|rtapi_app|g" out.txt
}
realtime start > realtime.log 2>&1
run 'ready in time' <<HAL
loadusr -Wn good $py comp.py good late
list comp good
HAL
run 'name is taken' <<HAL
loadusr -Wn good $py comp.py good late
loadusr -W $py
HAL
run 'the program ends too early' <<HAL
loadusr -Wn early $py comp.py early dies
loadusr -Wn none true
loadusr -Wn none no-such-program
list comp early
HAL
mkdir -p bin
printf '#!/bin/sh\nexec %s comp.py my-gui good\n' "$py" > bin/my-gui
chmod +x bin/my-gui
PATH=$PWD/bin:$PATH
run 'a program of the PATH called with .py' <<HAL
loadusr -W my-gui.py
list comp my-gui
loadusr -W no-gui.py
HAL
run 'module that is loaded already' <<HAL
loadrt and2
loadrt and2
HAL
export HALCMD_WAIT_TIMEOUT=0.7
run 'another name than expected' <<HAL
loadusr -Wn expected $py comp.py found good
HAL
run 'never ready' <<HAL
loadusr -Wn slow $py comp.py slow never-ready
HAL
unset HALCMD_WAIT_TIMEOUT
run 'waitusr ends when the program does' <<HAL
unloadusr good
waitusr good
unloadusr all
waitusr found
waitusr slow
list sig
HAL
halcmd unload all
realtime stop
rm -rf out.txt t.hal comp.py realtime.log bin
