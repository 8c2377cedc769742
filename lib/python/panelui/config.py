# SPDX-License-Identifier: GPL-2.0-or-later
"""_panelui.ini: sections [A], [[b]] in A, [[[c]]] in b, and NAME = VALUE. Mistakes name file and line."""

import re
from dataclasses import dataclass, field

NUMBERS = ("S32", "U32", "FLOAT")
OUTPUTS = (*NUMBERS, "BIT", "NONE", "COMMAND", "ZMQ")
RANGES = {"S32": (-2**31, 2**31 - 1), "U32": (0, 2**32 - 1)}
BUTTON_KEYS = ("KEY", "OUTPUT", "DEFAULT", "GROUP", "GROUP_OUTPUT", "STATUS_PIN", "TRUE_STATE", "FALSE_STATE",
               "TRUE_COMMAND", "FALSE_COMMAND", "TRUE_FUNCTION", "FALSE_FUNCTION")
GROUP_KEYS = ("KEY", "OUTPUT", "DEFAULT", "GROUP", "STATUS_PIN")
SECTIONS = {"HAL_PREFIX": ("NAME",), "ZMQ_SETUP": ("TOPIC", "SOCKET", "ENABLE"),
            "RADIO_BUTTONS": (), "TOGGLE_BUTTONS": (), "MOMENTARY_BUTTONS": ()}
WORDS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}
PIN_NAME = re.compile(r"[A-Za-z0-9_.+-]+")


class ConfigError(Exception):
    """FILE:LINE: what is wrong and what was expected."""


@dataclass
class Section:
    name: str
    line: int
    values: dict = field(default_factory=dict)      # name -> (text, line)
    parts: dict = field(default_factory=dict)       # name -> Section


@dataclass
class Button:
    """kind: radio, toggle or momentary. key: (row, column) or None. states, commands and
    functions: for False, for True."""
    name: str
    kind: str
    key: tuple | None
    output: str
    states: tuple
    commands: tuple = (None, None)      # (name, arguments)
    functions: tuple = (None, None)
    status_pin: bool = False
    group: str = "0"
    group_output: float = 0
    default: bool = False
    metadata: dict = field(default_factory=dict)


@dataclass
class Group:
    """Radio buttons, of which one is pressed."""
    name: str
    output: str
    default: str
    buttons: list


@dataclass
class Config:
    prefix: str = "panelui"
    topic: str = "QTVCP"
    socket: str = "tcp://127.0.0.1:5690"
    zmq: bool = False
    groups: list = field(default_factory=list)
    buttons: list = field(default_factory=list)     # all, those of groups too


def split(text):
    """Comma separated words; quotes keep commas and blanks."""
    words = re.findall(r"""\s*("(?:[^"]*)"|'(?:[^']*)'|[^,]*)\s*(?:,|$)""", text)
    if words and not words[-1] and (len(words) > 1):
        words.pop()
    return [w[1:-1] if len(w) > 1 and w[0] == w[-1] and w[0] in "\"'" else w.strip() for w in words]


def comment_off(line):
    """The line without a comment; # in quotes belongs to the text."""
    return re.match(r"""(?:[^#"']|"[^"]*"|'[^']*'|["'])*""", line).group().strip()


def parse(path, text):
    """The tree of sections. Raises ConfigError."""
    root = Section("", 0)
    open_sections = [root]
    for number, raw in enumerate(text.splitlines(), 1):
        line = comment_off(raw)
        if not line:
            continue
        if line.startswith("["):
            head = re.fullmatch(r"(\[+)\s*([^\[\]]+?)\s*(\]+)", line)
            if not head or len(head[1]) != len(head[3]):
                raise ConfigError(f"{path}:{number}: {line}: [SECTION], [[name]] or [[[name]]] is expected")
            depth = len(head[1])
            if depth > len(open_sections):
                raise ConfigError(f"{path}:{number}: {line}: stands in no section of {depth - 1} brackets")
            del open_sections[depth:]
            name = head[2].strip("\"'")
            if name in open_sections[-1].parts:
                raise ConfigError(f"{path}:{number}: {line}: the name is there twice "
                                  f"(line {open_sections[-1].parts[name].line})")
            section = open_sections[-1].parts[name] = Section(name, number)
            open_sections.append(section)
            continue
        name, sign, value = line.partition("=")
        name, value = name.strip(), value.strip()
        if not sign or not name:
            raise ConfigError(f"{path}:{number}: {line}: NAME = VALUE or [SECTION] is expected")
        if name in open_sections[-1].values:
            raise ConfigError(f"{path}:{number}: {name}: is there twice (line {open_sections[-1].values[name][1]})")
        open_sections[-1].values[name] = (value, number)
    return root


class Reader:
    """Turns the tree into a Config."""

    def __init__(self, path):
        self.path, self.config = path, Config()
        self.names, self.keys = {}, {}      # pin names and keys in use -> line

    def fail(self, line, text):
        raise ConfigError(f"{self.path}:{line}: {text}")

    def known(self, section, names):
        for name, (_, line) in section.values.items():
            if name not in names:
                self.fail(line, f"{name}: unknown in [{section.name}]; known: {', '.join(names) or 'nothing'}")

    def text(self, section, name, default=None):
        value, _ = section.values.get(name, (default, section.line))
        quoted = isinstance(value, str) and len(value) > 1 and value[0] == value[-1] and value[0] in "\"'"
        return value[1:-1] if quoted else value

    def line(self, section, name):
        return section.values[name][1] if name in section.values else section.line

    def choice(self, section, name, allowed, default):
        value = self.text(section, name, default)
        if value is None:
            self.fail(section.line, f"{section.name}: needs {name} = {' or '.join(allowed)}")
        if value.upper() not in allowed:
            self.fail(self.line(section, name), f"{name} = {value}: {' or '.join(allowed)} is expected")
        return value.upper()

    def flag(self, section, name, default=False):
        value = self.text(section, name)
        if value is None:
            return default
        if value.lower() not in WORDS:
            self.fail(self.line(section, name), f"{name} = {value}: True or False is expected")
        return WORDS[value.lower()]

    def number(self, section, name, output, default):
        """A value of a pin's type."""
        value = self.text(section, name)
        if value is None:
            return default
        line = self.line(section, name)
        if output == "BIT":
            if value.lower() not in WORDS:
                self.fail(line, f"{name} = {value}: True or False is expected (OUTPUT = BIT)")
            return WORDS[value.lower()]
        try:
            number = float(value) if output == "FLOAT" else int(value, 0)
        except ValueError:
            self.fail(line, f"{name} = {value}: a number is expected (OUTPUT = {output})")
        low, high = RANGES.get(output, (-float("inf"), float("inf")))
        if not low <= number <= high:
            self.fail(line, f"{name} = {value}: {low} to {high} fit into OUTPUT = {output}")
        return number

    def key(self, section):
        value = self.text(section, "KEY", "NONE").upper()
        if value == "NONE":
            return None
        found = re.fullmatch(r"R(\d+)C(\d+)", value)
        line = self.line(section, "KEY")
        if not found or int(found[1]) > 7 or int(found[2]) > 7:
            self.fail(line, f"KEY = {value}: R0C0 to R7C7 or NONE is expected")
        key = int(found[1]), int(found[2])
        if key in self.keys:
            self.fail(line, f"KEY = {value}: is taken in line {self.keys[key]}")
        self.keys[key] = line
        return key

    def name(self, section):
        if not PIN_NAME.fullmatch(section.name):
            self.fail(section.line, f"{section.name}: the name becomes a pin: letters, digits and _ . + - are expected")
        if section.name in self.names:
            self.fail(section.line, f"{section.name}: the name is taken in line {self.names[section.name]}")
        self.names[section.name] = section.line
        return section.name

    def action(self, section, name):
        """(name in lower case, arguments) of a command or function, or None."""
        words = split(section.values.get(name, ("NONE", 0))[0])
        if not words or words[0].upper() in ("NONE", "CLEAR", ""):
            return None
        return words[0], words[1:]

    def button(self, section, kind, group=None):
        self.known(section, BUTTON_KEYS)
        for part in section.parts.values():
            self.fail(part.line, f"[{part.name}]: nothing is expected inside a button")
        output = self.choice(section, "OUTPUT", OUTPUTS, "BIT")
        typed = output if output in (*NUMBERS, "BIT") else "BIT"
        default = {"BIT": (False, True)}.get(typed, (0, 1))
        button = Button(
            self.name(section), kind, self.key(section), output,
            tuple(self.number(section, f"{n}_STATE", typed, v) for n, v in zip(("FALSE", "TRUE"), default)),
            tuple(self.action(section, f"{n}_COMMAND") for n in ("FALSE", "TRUE")),
            tuple(self.action(section, f"{n}_FUNCTION") for n in ("FALSE", "TRUE")),
            self.flag(section, "STATUS_PIN"), self.text(section, "GROUP", "0"),
            metadata={name: value for name, (value, _) in section.values.items()})
        if group:
            button.group_output = self.number(section, "GROUP_OUTPUT", group.output, 0)
        elif kind == "toggle":
            button.default = self.flag(section, "DEFAULT")
        self.config.buttons.append(button)
        return button

    def radio(self, section):
        self.known(section, GROUP_KEYS)
        if "DEFAULT" not in section.values:
            self.fail(section.line, f"{section.name}: needs DEFAULT = one of its buttons")
        group = Group(self.name(section), self.choice(section, "OUTPUT", NUMBERS, None),
                      self.text(section, "DEFAULT"), [])
        group.buttons = [self.button(part, "radio", group) for part in section.parts.values()]
        names = [button.name for button in group.buttons]
        if group.default not in names:
            self.fail(self.line(section, "DEFAULT"),
                      f"DEFAULT = {group.default}: one of {', '.join(names) or 'the buttons'} is expected")
        for button in group.buttons:
            button.default = button.name == group.default
        self.config.groups.append(group)

    def read(self, root):
        for name, (_, line) in root.values.items():
            self.fail(line, f"{name}: stands in no section")
        for section in root.parts.values():
            if section.name not in SECTIONS:
                self.fail(section.line, f"[{section.name}]: unknown; known: {', '.join(SECTIONS)}")
            self.known(section, SECTIONS[section.name])
            if section.name == "RADIO_BUTTONS":
                for part in section.parts.values():
                    self.radio(part)
            elif section.name.endswith("_BUTTONS"):
                kind = section.name.partition("_")[0].lower()
                for part in section.parts.values():
                    self.button(part, kind)
            else:
                for part in section.parts.values():
                    self.fail(part.line, f"[[{part.name}]]: not expected in [{section.name}]")
        parts = root.parts
        config = self.config
        if "HAL_PREFIX" in parts:
            config.prefix = self.text(parts["HAL_PREFIX"], "NAME", config.prefix)
            if not PIN_NAME.fullmatch(config.prefix):
                self.fail(self.line(parts["HAL_PREFIX"], "NAME"),
                          f"NAME = {config.prefix}: letters, digits and _ . + - are expected")
        if "ZMQ_SETUP" in parts:
            section = parts["ZMQ_SETUP"]
            config.topic = self.text(section, "TOPIC", config.topic)
            config.socket = self.text(section, "SOCKET", config.socket)
            config.zmq = self.flag(section, "ENABLE")
        return config


def load(path):
    """The Config of a file. Raises ConfigError or OSError."""
    with open(path, encoding="utf-8", errors="replace") as file:
        return Reader(path).read(parse(path, file.read()))
