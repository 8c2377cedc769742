#!/bin/bash
# runtests on folders of every kind: what runs, what is skipped, how each is judged, what each option does,
# and what a test may not leave behind.
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work
unset RUNTESTS_MARK
make_test() { # folder, text of test.sh, text of expected
    mkdir -p "$1"; printf '%s\n' "$2" > "$1/test.sh"; [ $# -lt 3 ] || printf '%s\n' "$3" > "$1/expected"
}
run() { "$RUNTESTS" "$@" 2>&1 | sed -E "s,$PWD/,,g; s/[0-9.]+ s\b/N s/"; echo "status ${PIPESTATUS[0]}"; }

make_test a/good 'echo $TEST_DIR | sed s,.*/work/,,; echo $LC_ALL $LANGUAGES $DISPLAY; [ -d $HEADERS ] && [ -d $LIBDIR ] && [ -x $RUNTESTS ] && echo set' "$(printf 'a/good\nC\nset')"
make_test a/differs 'echo one; echo two; touch a.var' one
make_test a/long 'seq 100' "$(seq 2 100 | tac)"
make_test a/status 'echo x; exit 3' x
make_test a/nothing 'echo x'
make_test a/checked 'echo 5' 6; printf '#!/bin/sh\ngrep -q 5 "$1"\n' > a/checked/checkresult; chmod +x a/checked/checkresult
make_test a/check-fails 'echo 5'; printf '#!/bin/sh\necho why; exit 2\n' > a/check-fails/checkresult; chmod +x a/check-fails/checkresult
make_test a/x-known 'exit 1' x; touch a/x-known/xfail
make_test a/x-better 'echo x' x; touch a/x-better/xfail
make_test a/skip-always 'echo x' x; touch a/skip-always/skip
make_test a/skip-decides 'echo x' x; printf '#!/bin/sh\necho no such hardware; exit 1\n' > a/skip-decides/skip; chmod +x a/skip-decides/skip
make_test a/skip-runs 'echo x' x; printf '#!/bin/sh\nexit 0\n' > a/skip-runs/skip; chmod +x a/skip-runs/skip
make_test a/musthave 'echo x' x; echo NO_SUCH_THING > a/musthave/musthave
make_test a/musthave-there 'echo x' x; echo STDIO > a/musthave-there/musthave
make_test a/control 'echo x' x; echo 'Restrictions: sudo' > a/control/control
mkdir a/program; cp /bin/echo a/program/test; echo > a/program/expected
mkdir a/hal; printf 'loadrt and2\nshow funct\n' > a/hal/test.hal; printf '#!/bin/sh\ngrep -q and2.0 "$1"\n' > a/hal/checkresult; chmod +x a/hal/checkresult
make_test a/check-plain 'echo 5'; printf 'grep -q 5 "$1" && [[ -n $TEST_DIR ]]\n' > a/check-plain/checkresult; chmod +x a/check-plain/checkresult
make_test a/check-unset 'echo 5'; printf 'exit 0\n' > a/check-unset/checkresult
echo "== all"; run -u a; ls a/differs a/good
echo "== -n keeps"; run -n a/good; ls a/good
echo "== -c removes, in all folders given"; touch a/differs/b.var.bak; run -c a/good a/differs; ls a/good a/differs
echo "== -s stops"; run -s a/differs a/good
echo "== -p shows"; run -p a/differs | grep -c '^--- last lines'
echo "== -v shows it while it runs"; run -v a/good | grep -v '^+'
echo "== without arguments"; (cd a/good && run)
echo "== an unknown option"; run --nonsense | head -n 1
echo "== overruns are run again, ten times"
mkdir -p o/once o/always
printf 'loadusr -w sh ./once.sh\n' > o/once/test.hal; echo fine > o/once/expected
printf '[ -f ran ] && rm ran && echo fine || { touch ran; echo overrun; }\n' > o/once/once.sh
printf 'loadusr -w echo overrun\n' > o/always/test.hal; echo fine > o/always/expected
run o | uniq -c | sed 's/^ *//'
echo "== what it leaves is ended and named"
make_test l/process 'sleep 7711 < /dev/null > /dev/null 2>&1 & echo x' x
make_test l/memory 'python3 -c "
import ctypes
from kerf import instance
ctypes.CDLL(None).shmget(ctypes.c_int(instance.key(0x64)), 4096, 0o1666)"; echo x' x
run --strict l | sed 's/0x[0-9a-f]*/KEY/'
pgrep -f 'sleep 7711' > /dev/null && echo "still there" || echo "ended"
echo "== a time limit ends a test with all it started"
make_test t/hangs 'sleep 7712 & sleep 7713' x
run --timeout 1 t
pgrep -f 'sleep 771[23]' > /dev/null && echo "still there" || echo "ended"
echo "== side by side, in virtual time, JUnit"
for n in 1 2 3 4; do make_test j/t$n 'echo $KERF_CLOCK; halrun -f x.hal' "$(printf 'virtual\n7')"; printf 'loadrt scale\nsetp scale.0.gain 7\ngetp scale.0.gain\n' > j/t$n/x.hal; done
make_test j/t5 'echo "<&>"' virtual
run -j 3 --virtual --junit out.xml j | grep -v Running | sort | grep -E 'Runtest|XFAIL|status'
python3 - <<'END'
import xml.etree.ElementTree as ET
s = ET.parse("out.xml").getroot()
print(s.tag, s.get("tests"), s.get("failures"), s.get("skipped"), sorted(c.get("name") for c in s))
print([c.find("failure").get("message") for c in s if c.find("failure") is not None], "<&>" in s[4][0].text)
END
echo "== once more, alone"
make_test r/flaky '[ -f ran ] && echo x; touch ran' x
run --retries 1 r
echo "== below nohup, signals reach a test's programs"
make_test h/hangup 'sleep 7714 & kill -HUP $!; wait $!; echo $?' 129
(trap '' HUP; run h)
