#!/bin/bash
# runtests on folders as others write them: what a test, its judge, its helpers and an interrupted run may do, how results
# come out as XML, and that tests side by side do not meet.
rm -rf work; mkdir work; trap 'cd ..; chmod -R u+w work; rm -rf work' EXIT
cd work
unset RUNTESTS_MARK
make_test() { # folder, text of test.sh, text of expected
    mkdir -p "$1"; printf '%s\n' "$2" > "$1/test.sh"; [ $# -lt 3 ] || printf '%s\n' "$3" > "$1/expected"
}
script() { mkdir -p "${1%/*}"; printf '#!/bin/sh\n%s\n' "$2" > "$1"; chmod +x "$1"; }
run() { "$RUNTESTS" "$@" 2>&1 | sed -E "s,$PWD/,,g; s/[0-9.]+ s\b/N s/"; echo "status ${PIPESTATUS[0]}"; }
gone() { pgrep -f "$1" > /dev/null && echo "still there: $1" || echo "ended"; }

echo "== a folder with two tests, names with blanks, bytes that are no text"
make_test "a/two tests" 'echo shell' ""; : > "a/two tests/expected"
printf 'loadrt and2\n' > "a/two tests/test.hal"
script "a/by tes/test" 'printf "\377\000\001\n"'; printf '\377\000\001\n' > "a/by tes/expected"
run -j 2 --junit two.xml a | sort
python3 -c 'import xml.etree.ElementTree as ET; print(sorted(c.get("name") for c in ET.parse("two.xml").getroot()))'
echo "== a file that is no test; options behind the folder"
run a/two\ tests/expected
make_test b/good 'echo x' x
run b/good -n; ls b/good
echo "== -v shows both streams, and keeps them for the judge"
make_test v/both 'echo out; echo err >&2; setsid sleep 7721 & sleep 0.1; kill $!'; script v/both/checkresult 'grep -q out $1 && grep -q err ${1%/*}/stderr'
run -v v/both | grep -v '^+' | sort
echo "== output that comes late, of a process without this environment"
make_test y/late 'env -i sh -c "sleep 1; echo late" & echo x' "$(printf 'x\nlate')"
run y
echo "== what -c removes below a folder"
mkdir -p c/deep/er; touch c/deep/er/a.var c/deep/result c/stderr c/kept
run -c c; find c -type f
echo "== a restriction that is indented"
make_test d/sudo 'echo x' x; printf 'Author: me\n Restrictions: net, sudo\n' > d/sudo/control
run -u d
echo "== a judge and a skip that hang, and one that leaves a process which holds its output"
make_test h/judge 'echo x'; script h/judge/checkresult 'sleep 7722'
make_test h/skip 'echo x'; script h/skip/skip 'sleep 7723'
run --timeout 1 h
make_test k/leaves 'echo x'; script k/leaves/checkresult 'sleep 7724 &'
run k; run --strict k | tail -n 1
gone 'sleep 772[1-4]'
echo "== a folder in which nothing can be written"
make_test w/ro 'echo x' x; mkdir w/ro/result
run w
echo "== what is no XML comes out as XML"
script x/strange/checkresult 'printf "\033[31m\000<&>\377\n"; exit 1'; make_test x/strange 'printf "a\001b\n"; echo "]]>" >&2'
run --junit out.xml x | tail -n 1; run --junit no/such/folder.xml x
python3 - <<'E'
import xml.etree.ElementTree as ET
case, = ET.parse("out.xml").getroot()
print(ascii(case.find("failure").text), ascii(case.find("system-out").text), "]]>" in case.find("system-err").text)
E
echo "== tests side by side may use one port"
if [ "$(id -u)" = 0 ] && unshare -n true 2> /dev/null; then
    for n in 1 2; do make_test p/t$n "python3 -c 'import socket, time; s = socket.create_server((\"127.0.0.1\", 7725)); time.sleep(0.7)'" ""; : > p/t$n/expected; done
    run -j 2 p | tail -n 2
else
    printf 'Runtest: 2 tests run, 2 successful, 0 failed + 0 expected, 0 skipped, 0 shmem errors\nstatus 0\n'    # an ordinary user may not
fi
echo "== an interrupted run ends what it started"
make_test i/1 'touch ../started; sleep 7726 & sleep 7727' x; make_test i/2 'touch ../second' x
for signal in INT TERM; do
    rm -f i/started
    env --default-signal=INT "$RUNTESTS" i > text 2>&1 & pid=$!
    until [ -e i/started ]; do sleep 0.05; done
    kill -$signal $pid; wait $pid; echo "status $?"
    grep -v -e '^[+-]' text
    gone 'sleep 772[67]'; ls i
done
