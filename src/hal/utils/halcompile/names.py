# SPDX-License-Identifier: GPL-2.0-or-later
"""Name mangling: what a declared name becomes in HAL, in C and in a manual."""

from __future__ import annotations

import re


def component_prefix(component: str) -> str:
    """The first part of every HAL name of a component."""
    if component.startswith("hal_"):
        component = component[len("hal_"):]
    return component.replace("_", "-").rstrip("-").rstrip(".")


def hal_format(name: str) -> str:
    """The printf format of an item's HAL name; `##` becomes `%02d`."""
    hal = re.sub(r"#+", lambda run: f"%0{len(run.group())}d", name)
    return hal.replace("_", "-").rstrip("-").rstrip(".")


def manual_name(name: str) -> str:
    """The name as a manual shows it: `##` becomes an emphasised MM."""
    shown = name.replace("_", "-")
    return re.sub(r"#+", lambda run: "__" + "M" * len(run.group()) + "__", shown)


def c_name(name: str) -> str:
    """The C identifier: index marks go, dots and dashes become one `_`."""
    flat = re.sub(r"[-._]*#+", "", name)
    return re.sub(r"_+", "_", re.sub(r"[-.]", "_", flat))
