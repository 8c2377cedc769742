"""Configuration files and log files, without HAL and without a screen."""
import csv
import math
import os
from array import array

from kerf.halscope import configfile, csvlog, settings as st

KNOWN = {("pin", "a.out"): 1, ("pin", "b.pos"): 2, ("sig", "speed"): 2, ("param", "p"): 3, ("pin", "count"): 7}


def resolve(kind, name):
    return KNOWN.get((kind, name), 0)


print([st.scale(i) for i in range(-7, 8)])
s = st.Settings(samples=16000, thread="servo-thread", mult=3, zoom=4, pos=0.25, run_mode=st.SINGLE)
for n, (kind, name, enabled) in {1: ("pin", "a.out", True), 3: ("sig", "speed", True), 4: ("param", "p", False),
                                 16: ("pin", "count", True)}.items():
    c = s.channel(n)
    c.kind, c.name, c.type, c.enabled = kind, name, resolve(kind, name), enabled
s.channel(3).vscale, s.channel(3).vpos, s.channel(3).voff, s.channel(3).ac = -4, 0.75, 1.25, True
s.channel(1).voff = -2
s.selected = 3
s.trigger = st.Trigger(3, 0.4, 0.2, False, False)
configfile.save("t.halscope", s)
print(open("t.halscope").read())
again = st.Settings()
print("warnings", configfile.load("t.halscope", again, resolve), "same", again == s)
configfile.save("t2.halscope", again)
print("same text", open("t.halscope").read() == open("t2.halscope").read())

bad = """# comment
#SAMPLES 5000
maxchan 16
Chan 1
pin a.out
VSCALE 9
vscale 1
vpos 1.5
pin none
CHAN 17
frobnicate 3
HZOOM
HMULT x
hmult 20
VOFF nan_
TSOURCE 2
TPOLAR 2
RMODE 7
""" + "PIN " + "x" * 99 + "\n"
fresh = st.Settings()
for warning in configfile.parse(bad.splitlines(), fresh, resolve):
    print("halscope:", warning)
print(fresh.samples, fresh.mult, fresh.selected, fresh.trigger.source, fresh.channel(1))
print(configfile.parse(["PIN a.out"], st.Settings(), resolve),
      configfile.parse(["SAMPLES 5000", "CHAN 2", "sig speed", "choff"], fresh, resolve),
      fresh.samples, fresh.channel(2).enabled)

# Logs.
channels = [s.channel(1), s.channel(3), s.channel(16)]
values = [array("d", [0, 1, 1]), array("d", [0.1, -2.5e-7, 1 / 3]), array("d", [2**53, -1, 7])]
csvlog.save("t.csv", 1000000, channels, values)
print(open("t.csv").read())
log = csvlog.load("t.csv")
print(log.period, log.names, log.positions, log.scales)
print("the same values", values == log.values)
extreme = [array("d", [5e-324, -1.7976931348623157e308, 1e-9 / 3, math.inf, -0.0])]
csvlog.save("t.csv", 1000, channels[1:2], extreme)
print("extreme ones, too", csvlog.load("t.csv").values == extreme)
csvlog.save("t.csv", 1000000, channels, values)
with open("t.csv", newline="") as f:
    rows = [r for r in csv.reader(f, delimiter=";") if not r[0].startswith("#")]
print("csv module", rows[0], [float(w) for w in rows[3]])
print("other order, no notes:", csvlog.parse(["# Sampling period is 5 ns", "x", "1", "2.5", "", "3e3"]).values)
for lines in ([], ["x;y"], ["# Sampling period is 0 ns", "x"], ["# Sampling period is 5 ns"],
              ["# Sampling period is 5 ns", "x;y", "1;2", "3"],
              ["# Sampling period is 5 ns", "x;y", "1;2", "3;z"], ["# Sampling period is 5 ns", "x;y", "# Scale: 1"],
              ["# Sampling period is 5 ns", "x;y", "# Scale: 1;q"],
              ["# Sampling period is 5 ns", "x;y", "# Position: .5;nan"],
               ["# Sampling period is 5 ns", ";".join("x" * 17)]):
    try:
        print(csvlog.parse(lines))
    except csvlog.LogError as e:
        print("LogError:", e)

# A file that cannot be replaced stays as it is, and nothing else is left.
before = open("t.halscope").read()
os.mkdir("t.halscope.new")
for path in ("none/t.halscope", "t.halscope"):
    try:
        configfile.save(path, st.Settings())
    except OSError as e:
        print(type(e).__name__)
os.rmdir("t.halscope.new")
print("kept", open("t.halscope").read() == before)
for name in ("t.halscope", "t2.halscope", "t.csv"):
    os.unlink(name)
print([n for n in os.listdir(".") if ".halscope" in n or n.endswith(".csv")])
