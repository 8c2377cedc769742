#!/bin/bash
# The part of the quickstart: no joint beyond a limit, back at the end position, a picture drawn.
unset KERF_CLOCK
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
kerf-run --picture "$out/p.png" --json "$out/r.json" > "$out/text" || { cat "$out/text"; exit 1; }
cat "$out/text" >&2
/usr/bin/python3 - "$out" <<'END'
import json, sys
out = sys.argv[1]
r = json.load(open(out + "/r.json"))
text = open(out + "/text").read()
print("violations", r["violations"])
print("minutes", 2 < r["cycle_time"] / 60 < 20)
print("distances", r["distance"]["feed"] > 3000, r["distance"]["rapid"] > 300)
print("close to limits", all(rows[1][1] > 0.5 * rows[1][2] for rows in r["joints"]))
print("position", [round(x, 4) + 0 for x in r["position"][:2]])
print("picture", open(out + "/p.png", "rb").read(8) == b"\x89PNG\r\n\x1a\n")
print("words", all(w in text for w in ("Cycle time", "Wall time", "Distance", "Joint 2", "Final position", "Picture")))
END
