# SPDX-License-Identifier: GPL-2.0-or-later
"""From the syntax tree to a checked model of the component.

Everything the generators need is in `Component`; they make no checks. All
rules about names, counts, options and code are here.
"""

from __future__ import annotations

import os
import re
import sys
from dataclasses import dataclass, field

from .errors import CompError, line_and_column, warn
from .names import c_name
from .nodes import (File, Function, Include, Item, ModParam, Option, Text, Value, Variable)

RESERVED = ("comp_id", "fperiod", "rtapi_app_main", "rtapi_app_exit", "extra_setup",
            "extra_cleanup", "post_export")

COUNTS = ("default_count", "default_personality")

# option -> names of the function that the code must define then, and how it begins
BODIES = {"extra_setup": (("extra_setup", "EXTRA_SETUP"), "EXTRA_SETUP()"),
          "extra_cleanup": (("extra_cleanup", "EXTRA_CLEANUP"), "EXTRA_CLEANUP()"),
          "post_export": (("post_export", "POST_EXPORT"), "POST_EXPORT()"),
          "count_function": (("get_count",), "int get_count(void)"),
          "userspace": (("user_mainloop",), "void user_mainloop(void)"),
          "userinit": (("userinit",), "void userinit(int argc, char **argv)")}

# .comp type -> (type in HAL's function names, new access style)
TYPES = {
    "float": ("float", False), "bit": ("bit", False),
    "signed": ("s32", False), "s32": ("s32", False),
    "unsigned": ("u32", False), "u32": ("u32", False),
    "s64": ("s64", False), "u64": ("u64", False), "port": ("port", False),
    "bool": ("bool", True), "real": ("real", True),
    "sint": ("sint", True), "uint": ("uint", True),
    "si32": ("si32", True), "ui32": ("ui32", True),
}


@dataclass
class Component:
    """A component without mistakes."""
    name: str
    doc: str | None
    pins: list[Item] = field(default_factory=list)
    params: list[Item] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    variables: list[Variable] = field(default_factory=list)
    modparams: list[ModParam] = field(default_factory=list)
    includes: list[Include] = field(default_factory=list)
    texts: dict[str, list[str]] = field(default_factory=dict)
    options: dict[str, object] = field(default_factory=dict)   # int, str or C identifier
    option_offsets: dict[str, int] = field(default_factory=dict)
    declarations: list = field(default_factory=list)           # in order of the file
    filename: str = ""
    text: str = ""                                             # of the whole file
    code: str = ""
    code_line: int = 1
    body_is_function: bool = False                             # code is the body of the one function

    @property
    def items(self) -> list[Item]:
        return self.pins + self.params

    @property
    def uses_personality(self) -> bool:
        return any(i.condition or (i.array and i.array.used) for i in self.items)

    @property
    def userspace(self) -> bool:
        return bool(self.options.get("userspace"))

    @property
    def singleton(self) -> bool:
        return any(self.options.get(o) for o in ("singleton", "homemod", "tpmod"))

    @property
    def takes_period(self) -> bool:
        return bool(self.options.get("period", 1)) or bool(self.options.get("no_convenience_defines"))

    def option(self, name: str, default: object = 0) -> object:
        return self.options.get(name, default)


def option_value(value: Value | None) -> object:
    """What an option's value means; an omitted one is 1."""
    if value is None:
        return 1
    if value.kind == "BOOL":
        return int(value.truth)
    if value.kind == "NUMBER":
        return integer(value)
    if value.kind == "FPNUMBER":
        return float(value.text.rstrip("fF"))
    return value.text


def integer(value: Value) -> int:
    """A NUMBER as Python reads it: a leading zero is not octal, but a mistake."""
    try:
        return int(value.text, 0)
    except ValueError:
        raise CompError(f"Bad number {value.text}: octal is written 0o{value.text.lstrip('0')}",
                        value.offset) from None


def _check_item_name(item: Item) -> None:
    marks = len(re.findall(r"#+", item.name))
    if item.array:
        if marks == 0:
            raise CompError(f"Array name contains no #: '{item.name}'", item.offset)
        if marks > 1:
            raise CompError(f"Array name contains more than one block of #: '{item.name}'", item.offset)
    elif marks:
        raise CompError(f"Non-array name contains #: '{item.name}'", item.offset)


def _check_port(item: Item) -> None:
    if item.type == "port" and item.kind == "param":
        raise CompError("A parameter cannot be a port", item.offset)
    if item.type == "port" and item.direction == "io":
        raise CompError("The direction of a port is in or out", item.offset)


def _check_c_names(component: Component) -> None:
    """Different names may be the same in C."""
    names: dict[str, str] = {}
    for node in component.items + component.variables:
        name = c_name(node.name)
        if name in names:
            raise CompError(f"'{names[name]}' and '{node.name}' are both {name} in C", node.offset)
        names[name] = node.name


def _add_option(component: Component, option: Option) -> None:
    if option.name in component.options:
        raise CompError(f"Duplicate option name {option.name}", option.offset)
    if option.name in COUNTS and option.value and option.value.kind == "STRING":
        raise CompError(f"Option {option.name} must be a number", option.value.offset)
    component.options[option.name] = option_value(option.value)
    component.option_offsets[option.name] = option.offset


def _check_code(component: Component) -> None:
    """Decides whether the code is a function's body."""
    if not component.functions or "FUNCTION" in component.code:
        return
    if len(component.functions) > 1:
        raise CompError("Must use FUNCTION() when more than one function is defined")
    component.body_is_function = True


def check_bodies(component: Component) -> None:
    """What is declared must be defined: such a module would be built, but never load.
    Nothing is said where a macro or a header of the user's may define it."""
    code = component.code
    headers = re.findall(r'^\s*#\s*include\s*["<]([^">\n]+)', code, re.M) + [i.header[1:-1] for i in component.includes]
    folder = os.path.dirname(component.filename)
    if "##" in code or any(os.path.exists(os.path.join(folder, header)) for header in headers):
        return
    wanted = [((c_name(f.name),), f"FUNCTION({f.name})", f.offset)
              for f in component.functions if not component.body_is_function]
    wanted += [(words, text, component.option_offsets[option]) for option, (words, text) in BODIES.items()
               if component.option(option) and (component.userspace or option != "userinit")]
    for words, text, offset in wanted:
        if not re.search(rf"\b(?:{'|'.join(words)})\b", code):
            raise CompError(f"Missing after the line \";;\": {text} {{ ... }}", offset)


def check(tree: File, expected_name: str | None = None,
          extra_options: dict[str, str] | None = None) -> Component:
    """Checks a tree. expected_name: base name of the file that is written, which
    the component's name must equal. extra_options: as if declared."""
    declared = tree.component
    if expected_name is not None and declared.name != expected_name:
        raise CompError(f"Component name ({declared.name}) does not match filename ({expected_name})",
                        declared.offset)
    component = Component(declared.name, declared.doc, declarations=tree.declarations,
                          filename=tree.name, text=tree.text, code=tree.code, code_line=tree.code_line)
    component.options.update(extra_options or {})
    names: set[str] = set()

    def claim(name: str, offset: int) -> None:
        if name in RESERVED:
            raise CompError(f"Variable name {name} is reserved", offset)
        if name in names:
            raise CompError(f"Duplicate item name {name}", offset)
        names.add(name)

    for node in tree.declarations:
        match node:
            case Item():
                _check_item_name(node)
                _check_port(node)
                claim(node.name, node.offset)
                (component.pins if node.kind == "pin" else component.params).append(node)
            case Function():
                claim(node.name, node.offset)
                if node.fp:
                    line, _ = line_and_column(tree.text, node.offset)
                    warn(tree.name, line,
                         f"'{node.fp}' is no longer supported and will be removed in a future version. "
                         "All threads are now floating point capable. "
                         f"Please remove '{node.fp}' from the function declaration.")
                component.functions.append(node)
            case Variable():
                claim(node.name, node.offset)
                if node.value and node.value.kind == "NUMBER":
                    integer(node.value)
                component.variables.append(node)
            case ModParam():
                claim(node.name, node.offset)
                component.modparams.append(node)
            case Option():
                _add_option(component, node)
            case Include():
                component.includes.append(node)
            case Text():
                component.texts.setdefault(node.section, []).append(node.text)

    if "license" not in component.texts:
        raise CompError("License not specified")
    if not component.pins:
        raise CompError("Component must have at least one pin")
    if component.userspace:
        if component.functions:
            raise CompError("Userspace components may not have functions", component.functions[0].offset)
        for param in component.modparams:
            if param.type == "int":
                raise CompError("Userspace components may not have parameters of modules: read argv", param.offset)
    elif component.option("userinit"):
        print(f"Warning: comp '{tree.name}' sets 'userinit' without 'userspace', ignoring", file=sys.stderr)
    _check_c_names(component)
    _check_code(component)
    return component
