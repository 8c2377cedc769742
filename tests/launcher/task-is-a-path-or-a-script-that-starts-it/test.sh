#!/bin/bash
# [TASK]TASK by its name, as a path, as a script of the user beside the INI file and one that stays task's parent. When task dies the session
# ends, whatever started it.
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
export KERF_CLOCK=virtual HOME=$out
cp -r "$EMC2_HOME/configs/sim/mill" "$out/machine"; cd "$out/machine"
printf '#!/bin/sh\necho extra > by\nexec milltask "$@"\n' > mytask
printf '#!/bin/sh\nmilltask "$@"\n' > parent
printf '#!/bin/sh\nhalcmd getp ini.0.max_velocity > seen; [ -z "$DIE" ] || pkill -KILL -f "^(.*/)?milltask -ini $PWD/mill.ini"; sleep "${DIE:-0}"\n' > display
chmod +x mytask parent display
for die in "" 20; do
    for task in milltask "$EMC2_HOME/bin/milltask" ./mytask ./parent; do
        sed -i "s|^TASK *=.*|TASK = $task|" mill.ini
        rm -f seen by
        DIE=$die linuxcnc -r -D "$PWD/display" mill.ini > log 2>&1 < /dev/null
        echo "${task##*/} ${die:+killed }status $? $(cat seen by 2> /dev/null | tr '\n' ' ') $(grep -o 'milltask (process.*' log | sed 's/[0-9][0-9]*/N/')"
    done
done
