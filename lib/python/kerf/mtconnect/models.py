# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes of the machine's parts: [MTCONNECT]MODEL_*."""

import re
from pathlib import Path

from .settings import LINEAR, warn

BASE, SPINDLE = "BASE", "SPINDLE"
TYPES = {".stl": ("STL", "model/stl"), ".obj": ("OBJ", "model/obj"), ".gltf": ("GLTF", "model/gltf+json"),
         ".glb": ("GLB", "model/gltf-binary"), ".ply": ("PLY", "application/octet-stream"),
         ".step": ("STEP", "model/step"), ".stp": ("STEP", "model/step")}
NO_PARENT = ("BASE", "FRAME", "DEVICE", "ROOT", "NONE")


def media(name):
    return TYPES[Path(name).suffix.lower()][0]


def box(name, size):
    """A box around the origin, `size` in mm, as ASCII STL."""
    half = [s / 2 for s in size]
    lines = [f"solid {name}"]
    for axis in range(3):
        one, two = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1, 1):
            normal = [0, 0, 0]
            normal[axis] = sign
            corner = {}
            for a in (-1, 1):
                for b in (-1, 1):
                    at = [0.0, 0.0, 0.0]
                    at[axis], at[one], at[two] = sign * half[axis], a * half[one], b * half[two]
                    corner[a, b] = at
            ring = [corner[-1, -1], corner[1, -1], corner[1, 1], corner[-1, 1]]
            if sign < 0:
                ring.reverse()
            for triangle in (ring[:3], [ring[0], ring[2], ring[3]]):
                lines.append("facet normal {} {} {}\n outer loop".format(*normal))
                lines += ["  vertex {:g} {:g} {:g}".format(*at) for at in triangle]
                lines.append(" endloop\nendfacet")
    return "\n".join(lines) + f"\nendsolid {name}\n"


class Meshes:
    """Which part has which mesh, and what carries it."""

    def __init__(self, settings, ini):
        self.settings = settings
        find = lambda name: ini.find("MTCONNECT", name)
        letters = lambda text: "".join(letter
                                       for letter in re.sub(r"[^A-Z]", "", (text or "").upper())
                                       if letter in settings.axes)
        self.folder = settings.folder / (find("MODEL_DIR") or "")
        self.inverted = letters(find("MODEL_INVERT"))
        self.chain = letters(find("MODEL_CHAIN")) or settings.axes
        self.parents = {part: (find(f"MODEL_PARENT_{part}") or "").strip().upper()
                        for part in (*settings.axes, SPINDLE)}
        self.paths, self.made = {}, {}
        automatic = ini.getbool("MTCONNECT", "MODEL_AUTO", fallback=False)
        for part in (BASE, *settings.axes, SPINDLE):
            given = find(f"MODEL_{part}") or (find("MODEL_DEVICE") if part == BASE else None)
            self.place(part, given, automatic)

    def place(self, part, given, automatic):
        path = self.folder / given if given else None
        if path and path.suffix.lower() not in TYPES:
            warn(f"[MTCONNECT]MODEL_{part} = {given}: not one of {' '.join(TYPES)}")
            path = None
        if path and path.is_file():
            self.paths[part] = path
        elif automatic:
            self.made[part] = f"{part.lower()}.stl"
        elif path:
            warn(f"[MTCONNECT]MODEL_{part}: there is no file {path}")

    def file(self, part):
        """Name below /models, or None."""
        return self.paths[part].name if part in self.paths else self.made.get(part)

    def parent(self, part):
        """Letter of the axis that carries it, or ''."""
        named = self.parents.get(part, "")
        if named in NO_PARENT:
            return ""
        if named in self.settings.axes and len(named) == 1 and named != part:
            return named
        if part == SPINDLE:
            return self.chain[-1:]
        at = self.chain.find(part)
        return self.chain[at - 1] if at > 0 else ""

    def content(self, name):
        """(content type, bytes) of a mesh, or None. Only files that the INI names are given out."""
        for path in self.paths.values():
            if path.name == name:
                try:
                    return TYPES[path.suffix.lower()][1], path.read_bytes()
                except OSError:
                    return None
        for part, made in self.made.items():
            if made == name:
                return TYPES[".stl"][1], box(part.lower(), self.size(part)).encode()
        return None

    def size(self, part):
        """Of the box that stands for a part: the travel of its axis, and something to see it by."""
        travel = [100.0 if not (limits := self.settings.axis_limits.get(letter)) or None in limits
                  else limits[1] - limits[0] for letter in "XYZ"]
        if part == BASE:
            return [t * 1.2 for t in travel[:2]] + [max(travel) * 0.1]
        if part in LINEAR:
            return [t if "XYZUVW".index(part) % 3 == n else max(travel) * 0.1 for n, t in enumerate(travel)]
        return [max(travel) * 0.1] * 3
