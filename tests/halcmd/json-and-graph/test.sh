#!/bin/bash
# show --json is JSON that says what show says; graph is SVG with every linked pin and value.
cat > t.hal <<'HAL'
loadrt threads name1=t period1=1000000
loadrt and2 count=2
loadrt mux2
loadrt ddt
addf and2.0 t
net bits and2.0.out => and2.1.in0 mux2.0.sel
net loop and2.1.out => and2.0.in0
net real mux2.0.out => ddt.0.in
net lonely ddt.0.out
net open and2.1.in1
newsig free u32
sets free 4000000000
setp mux2.0.in0 2.5
alias pin mux2.0.in1 my.alias
HAL
cat > look.py <<'PY'
import json
import re
import subprocess
import xml.etree.ElementTree as ET


def halcmd(*words):
    return subprocess.run(["halcmd", *words], stdout=subprocess.PIPE, text=True, check=True).stdout


data = json.loads(halcmd("show", "--json"))
print("lists", sorted(data))
pins = {p["name"]: p for p in data["pins"]}
for name in ("and2.0.out", "and2.0.in1", "mux2.0.in0", "my.alias"):
    print("pin", {k: v for k, v in pins[name].items() if k != "component_id"})
for s in data["signals"]:
    print("signal", s)
print("components", [(c["name"], c["type"], c["args"]) for c in data["components"] if c["type"] == "realtime"])
print("threads", [(t["name"], t["period"], t["functions"]) for t in data["threads"]])
print("functions", [(f["name"], f["users"]) for f in data["functions"]])
shown = set(re.findall(r"(?m)\s(\S+)(?: [<=>]+ \S+)?$", halcmd("show", "pin").split("Name\n")[1]))
print("same pins as show:", shown == set(pins))
print("one list, a pattern:", [p["name"] for p in json.loads(halcmd("show", "--json", "pin", "and2.0.in*"))["pins"]])
bad = subprocess.run(["halcmd", "show", "--json", "junk"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
print(bad.returncode, bad.stdout.strip())

subprocess.run(["halcmd", "graph", "all.svg"], check=True)
root = ET.parse("all.svg").getroot()
texts = [t.text for t in root.iter("{http://www.w3.org/2000/svg}text")]
titles = [t.text for t in root.iter("{http://www.w3.org/2000/svg}title")]
linked = [p for p in pins.values() if p["signal"]]
print("boxes:", sorted(t for t in texts if re.fullmatch(r"\w+\.\d", t)))
print("every linked pin:", all(any(p["name"] in t for t in titles) for p in linked))
print("values:", [t for t in ("bits = FALSE", "real = 2.5", "lonely = 0", "open = FALSE") if t in texts])
width, height = float(root.get("width")), float(root.get("height"))
boxes = [[float(r.get(k)) for k in ("x", "y", "width", "height")] for r in root.iter("{http://www.w3.org/2000/svg}rect")
         if r.get("x")]
inside = all(x >= 0 and y >= 0 and x + w <= width and y + h <= height for x, y, w, h in boxes)
apart = all(a == b or a[0] + a[2] <= b[0] or b[0] + b[2] <= a[0] or a[1] + a[3] <= b[1] or b[1] + b[3] <= a[1]
            for a in boxes for b in boxes)
print("boxes are inside and apart:", inside and apart)
some = ET.fromstring(halcmd("graph", "-", "real"))
print("chosen signal only:", sorted(t.text for t in some.iter("{http://www.w3.org/2000/svg}text")))
print(subprocess.run(["halcmd", "graph", "/nonexistent/x.svg"], stderr=subprocess.PIPE, text=True).stderr.strip())
PY
realtime start > log.txt 2>&1
halcmd -f t.hal
halcmd start; halcmd getp mux2.0.out > /dev/null
halcmd addf mux2.0 t; kerf-clock sleep 0.02; halcmd stop
/usr/bin/python3 look.py
halcmd unload all
realtime stop
rm -f t.hal look.py log.txt all.svg
