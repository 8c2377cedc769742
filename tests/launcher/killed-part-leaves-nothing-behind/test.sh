#!/bin/bash
# kill -9 of each process of a running machine in turn: the launcher says which one died, ends with
# a status that is not 0, and no process, shared memory or lock file of the session is left.
unset KERF_CLOCK
export KERF_INSTANCE=${KERF_INSTANCE:-killed}
top=$(cd ../../.. && pwd)
lock=/tmp/linuxcnc.lock.$KERF_INSTANCE
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
cp -r "$top/configs/sim/mill" "$out/machine"
printf '#!/bin/sh\ntouch %s/ready\nexec sleep 60\n' "$out" > "$out/display"; chmod +x "$out/display"

# Processes of this instance whose name begins with $1 ("" = all), this shell and its helpers aside.
mine() {
    local d
    for d in $(grep -lzx "KERF_INSTANCE=$KERF_INSTANCE" /proc/[0-9]*/environ 2>/dev/null); do
        d=${d%/environ}
        grep -qz '^LINUXCNC_SESSION=' "$d/environ" 2>/dev/null || continue
        case $(cat "$d/comm" 2>/dev/null) in "$1"*) echo "${d#/proc/}" ;; esac
    done
}
left_over() {
    local found="" key
    [ -e "$lock" ] && found="$found lock"
    [ -n "$(mine '')" ] && found="$found processes:$(for p in $(mine ''); do cat /proc/$p/comm; done | tr '\n' ',')"
    for key in $(/usr/bin/python3 -c 'from kerf import instance
for k in (0x64, 0x48414C32, 0x48484C34, 0x90280A48, 1001, 1002, 1003): print(instance.key(k))'); do
        awk -v k="$key" '$1 + 0 == k || $1 + 4294967296 == k { e = 1 } END { exit !e }' /proc/sysvipc/shm && found="$found segment:$key"
    done
    echo "${found:- nothing}"
}
for victim in rtapi_app milltask linuxcncsvr display session guard; do
    rm -f "$out/ready"
    linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/log" 2>&1 < /dev/null &
    guard=$!
    for _ in $(seq 500); do [ -e "$out/ready" ] && break; sleep 0.02; done
    [ -e "$out/ready" ] || { echo "$victim: machine did not start"; cat "$out/log"; }
    case $victim in
    guard) pid=$guard ;;
    session) pid=$(pgrep -P "$guard" | head -n 1) ;;
    display) pid=$(mine sleep) ;;
    *) pid=$(mine "$victim") ;;
    esac
    kill -9 $pid
    # Without the server of remote clients the machine goes on: end it as a user would.
    [ $victim = linuxcncsvr ] && kill $(mine sleep)
    wait "$guard"; status=$?
    for _ in $(seq 250); do [ "$(left_over)" = " nothing" ] && break; sleep 0.02; done
    echo "$victim: status $([ $status -ne 0 ] && echo not 0 || echo 0), left over:$(left_over)"
    [ "$(left_over)" = " nothing" ] || { cat "$out/log" >&2; realtime stop; }
done
