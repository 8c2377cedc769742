#!/usr/bin/env python3
# parts that came out of a CAD program
import os
from vismach import *
import hal
here = os.path.dirname(os.path.abspath(sys.argv[0]))
c = hal.component("m05")
c.newpin("z", hal.HAL_FLOAT, hal.HAL_IN)
c.ready()
corners = [(0, 0, 0), (20, 0, 0), (0, 20, 0), (0, 0, 20)]
faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
lines = ["solid part"]
for f in faces:
    lines += ([" facet normal 0 0 0", "  outer loop"] + ["   vertex %f %f %f" % corners[i] for i in f]
              + ["  endloop", " endfacet"])
lines.append("endsolid part")
with open("part.stl", "w") as f:
    f.write("\n".join(lines) + "\n")
obj = ["v %f %f %f" % p for p in corners] + ["f %d %d %d" % tuple(i + 1 for i in f) for f in faces]
work, tooltip = Capture(), Capture()
stl = AsciiSTL(filename="part.stl")
text = AsciiSTL(data="\n".join(lines))
mesh = AsciiOBJ(data="\n".join(obj))
model = Collection([work, Color([.6, .6, .6, 1], [stl]), Translate([mesh], 40, 0, 0),
                    HalTranslate([Translate([Collection([tooltip, text])], 0, 0, 40)], c, "z", 0, 0, 1)])
main(model, tooltip, work, 120)
