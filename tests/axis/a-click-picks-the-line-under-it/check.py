#!/usr/bin/python3
# Points of 20 seeded programs from three sides: the line that is picked there is the nearest one of all (within a
# pixel), and the vertices that the line shows are its own.
import random
import tempfile

import numpy as np
import programs

SIZE = 800, 600
composer = programs.composer()
picked, wrong = 0, []
with tempfile.TemporaryDirectory() as folder:
    for seed in range(20):
        r = random.Random(seed)
        path = f"{folder}/{seed}.ngc"
        with open(path, "w") as file:
            file.write(programs.program(r))
        programs.load(path, path + ".var", composer)
        drawing = composer.drawings[0]
        vertices, kinds, lines = (np.array(a) for a in (drawing.vertices, drawing.kinds, drawing.lines))
        drawn = kinds[1:] <= 2
        for view in ("z", "y", "p"):
            composer.camera.set_view(view)
            composer.camera.fit(*composer.shown_box())
            matrix = composer.camera.matrix(*SIZE)
            clip = np.hstack([vertices, np.ones((len(vertices), 1))]) @ np.reshape(matrix, (4, 4)).T
            pixels = np.column_stack([SIZE[0] / 2 * (1 + clip[:, 0] / clip[:, 3]),
                                      SIZE[1] / 2 * (1 - clip[:, 1] / clip[:, 3])])
            start, way = pixels[:-1], np.diff(pixels, axis=0)
            for piece in r.choices(np.flatnonzero(drawn), k=20):
                at = start[piece] + r.random() * way[piece]
                along = np.clip(((at - start) * way).sum(1) / np.maximum((way * way).sum(1), 1e-12), 0, 1)
                distance = np.where(drawn, np.hypot(*(start + way * along[:, None] - at).T), 1e9)
                near = set(lines[1:][distance < distance.min() + 1].tolist())
                found = drawing.pick(matrix, *SIZE, *map(float, at), 5.0, 7)
                picked += 1
                if found not in near:
                    wrong.append(f"{seed}, view {view}: line {found} at {at}, there are {near}")
        for line in sorted(set(lines[kinds <= 2].tolist())):
            spans = drawing.spans(line)
            if not spans or any(lines[n] != line for first, last in spans for n in range(first + 1, last)):
                wrong.append(f"{seed}: line {line} shows {spans}")
print("picked:", picked, "wrong:", len(wrong), *wrong[:5], sep="\n")
