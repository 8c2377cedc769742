# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in HAL as a tree: names grouped at their dots."""

import re
from dataclasses import dataclass

from hal import query

from ..language import _, N_

ROOTS = {"comp": N_("Components"), "pin": N_("Pins"), "param": N_("Parameters"), "sig": N_("Signals"),
         "funct": N_("Functions"), "thread": N_("Threads")}
MERGED = N_("Pins & Parameters")
GROUPED = ("pin", "param", "sig")


@dataclass(frozen=True)
class Node:
    """id: "ROOT+NAME"; kind: that of a leaf, or "" for a branch; name: full name or beginning of names."""
    id: str
    parent: str
    text: str
    kind: str
    name: str


def names():
    """Sorted names by kind."""
    return {"comp": sorted(query.comps()), "pin": sorted(query.pins()), "param": sorted(query.params()),
            "sig": sorted(query.signals()), "funct": sorted(query.functs()), "thread": list(query.threads())}


def nodes(found, separate):
    """Roots first, parents before children. found: as of names()."""
    tree, seen = [], set()

    def put(*fields):
        if fields[0] not in seen:
            seen.add(fields[0])
            tree.append(Node(*fields))
    for kind, title in ROOTS.items():
        if kind == "param" and not separate:
            continue
        put(kind, "", _(MERGED if kind == "pin" and not separate else title), "", "")
        items = [(name, kind) for name in found[kind]]
        if kind == "pin" and not separate:
            items = sorted(items + [(name, "param") for name in found["param"]])
        for name, leaf in items:
            if kind not in GROUPED:
                put(f"{kind}+{name}", kind, name, leaf, name)
                continue
            parent, parts = kind, name.split(".")
            for depth in range(1, len(parts)):
                beginning = ".".join(parts[:depth])
                put(f"{kind}+{beginning}.", parent, parts[depth - 1], "", beginning + ".")
                parent = f"{kind}+{beginning}."
            put(f"{kind}+{leaf}+{name}", parent, parts[-1], leaf, name)
    return tree


def matching(tree, pattern, whole):
    """Ids of nodes that the regular expression finds, in one part of a name or in whole names. re.error."""
    expression = re.compile(pattern)
    found = []
    for node in tree:
        if not node.name:
            continue
        if expression.search(node.name) if whole and node.kind else not whole and expression.search(node.text):
            found.append(node.id)
    return found


def leaves(tree, id_):
    """(kind, name) of a node, or of all leaves below it."""
    children = {}
    for node in tree:
        children.setdefault(node.parent, []).append(node)
    own = [node for node in tree if node.id == id_]
    found, waiting = [], own
    while waiting:
        node = waiting.pop(0)
        if node.kind:
            found.append((node.kind, node.name))
        waiting = children.get(node.id, []) + waiting
    return found
