#!/bin/bash
# kill -9 of both processes of the launcher, or of one, while the machine starts or runs: the next start puts things in
# order and runs at once, also when what was left holds simulated time: a display that has not joined the clock.
export KERF_CLOCK=virtual KERF_CLOCK_HANG_S=600 KERF_INSTANCE=${KERF_INSTANCE:-again}
top=$(cd ../../.. && pwd)
unset DISPLAY
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
cp -r "$top/configs/sim/mill" "$out/machine"
printf '#!/bin/sh\necho the display is up\nexec sleep 1000\n' > "$out/display"
printf '#!/bin/sh\necho it runs\n' > "$out/short"
chmod +x "$out/display" "$out/short"
kill_at() {     # words of the output, who
    mkfifo "$out/pipe"
    linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/pipe" 2>&1 < /dev/null &
    local guard=$! session
    while IFS= read -r line; do
        case $line in *"$1"*)
            session=$(pgrep -P $guard | head -n 1)
            case $2 in both) kill -9 $guard $session ;; guard) kill -9 $guard ;; session) kill -9 $session ;; esac
            break ;;
        esac
    done < "$out/pipe"
    cat "$out/pipe" > /dev/null &
    wait $guard 2> /dev/null
    rm "$out/pipe"
    echo "$2 killed at '$1': $(timeout 100 linuxcnc -r -D "$out/short" "$out/machine/mill.ini" 2>&1 < /dev/null | grep -x 'it runs'), status ${PIPESTATUS[0]}"
    kill %2 2> /dev/null; wait
}
kill_at Starting both
kill_at "Found file" both
kill_at "display is up" both
kill_at "display is up" session
kill_at "display is up" guard
