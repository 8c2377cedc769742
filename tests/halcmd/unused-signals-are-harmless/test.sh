#!/bin/bash
# FP-167: signals that nothing uses, and whatever else may stand in a user's file, neither
# stop nor crash the loader; what the file made is there afterwards.
cat > t.hal <<'HAL'
loadrt and2 count=2
newsig unused-bit bit
newsig unused-float float
newsig unused-port port
net unused-writer and2.0.out
net unused-reader and2.1.in0
newsig never-s64 s64
sets unused-float 1.5
loadrt threads name1=t period1=1000000
addf and2.0 t
start
show sig unused-b unused-f
save sigu
status lock
HAL
halrun t.hal 2>err.txt; echo "=> $?"
grep -v '^Note\|^  \|^No isol' err.txt | sed 's/0x[0-9a-f]*/ADDRESS/'
# A file of random words: halcmd ends by itself with status 0 or 1 for every seed.
cat > words.py <<'PY'
import os
import random
import subprocess
import tempfile
WORDS = ("net newsig linkps linksp unlinkp delsig setp sets getp gets addf initf delf alias unalias show list save status "
         "lock unlock start stop print echo unecho help ptype stype pin param sig comp funct thread all none tune bit "
         "float s32 u32 s64 u64 port and2.0.in0 and2.0.in1 and2.0.out and2.1.in0 and2.1.out and2.0 and2.1 t a b c => <= "
         "<=> = 0 1 -1 2.5 TRUE 0x7f 99999999999999999999 nan '' \"x y\" # $HOME [A]B and2.* -tbit --json").split(" ")
scratch = tempfile.TemporaryDirectory()          # save TYPE FILE writes files
os.chdir(scratch.name)
for seed in range(60):
    r = random.Random(seed)
    lines = ["loadrt and2 count=2", "loadrt threads name1=t period1=1000000"] if seed % 3 == 0 else []
    lines += [" ".join(r.choice(WORDS) for _ in range(r.randint(1, 6))) for _ in range(120)]
    done = subprocess.run(["halcmd", "-kf"], input="\n".join(lines), text=True, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, timeout=60)
    if done.returncode not in (0, 1):
        print(f"seed {seed}: status {done.returncode}")
    if seed % 3 == 0:
        subprocess.run(["halcmd", "-k", "-Q", "-f"], input="unlock all\nstop\ndelsig all\nunload all\n", text=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
print("random files end by themselves")
PY
realtime start > err.txt 2>&1
/usr/bin/python3 words.py
realtime stop
rm -f t.hal words.py err.txt
