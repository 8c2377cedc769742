#!/bin/bash
# Without realtime scheduling, and more programs that compute than CPUs: cycles that are late are made up for.
set +x
spinners=()
trap 'kill "${spinners[@]}" 2>/dev/null; halrun -U >/dev/null 2>&1' EXIT
halcmd_quiet() { halcmd "$@" 2>/dev/null; }
realtime start 2>/dev/null
halcmd_quiet loadrt threads name1=t period1=1000000
halcmd_quiet loadrt threadtest
halcmd_quiet addf threadtest.0.increment t
for _ in $(seq $(($(nproc) * 4))); do (while :; do :; done) & spinners+=($!); done
halcmd_quiet start
begin=$(date +%s%N)
sleep 1.5
end=$(date +%s%N)
count=$(halcmd_quiet getp threadtest.0.count)
echo "$count of $(((end - begin) / 1000000)) cycles" >&2
[ "$count" -ge $(((end - begin) / 2000000)) ] && echo "keeps up"
