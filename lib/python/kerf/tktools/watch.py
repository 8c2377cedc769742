# SPDX-License-Identifier: GPL-2.0-or-later
"""Watch lists of halshow: pins, parameters and signals with their values, and the files they are kept in."""

import contextlib
import time
import tkinter
from pathlib import Path

import hal
from hal import query

from ..language import _
from ..numbertext import plain, with_point

KINDS = ("pin", "param", "sig")
BACKUP = ".halshow_watchlist_backup"
GONE = "----"
HEADER = "# halshow watchlist created "


def split(word):
    """("pin", "NAME") of a word "pin+NAME". ValueError: it is none."""
    kind, plus, name = word.partition("+")
    if not plus or kind not in KINDS or not name:
        raise ValueError(_("%s: not one of pin+NAME, param+NAME, sig+NAME") % word)
    return kind, name


def find(kind, name):
    """What HAL says of an item, or None."""
    return {"pin": query.pin, "param": query.param, "sig": query.signal}[kind](name)


@contextlib.contextmanager
def quiet():
    """Without messages of the HAL library: a port that has no buffer yet gives one at every look."""
    level = hal.get_msg_level()
    hal.set_msg_level(hal.MSG_NONE)
    try:
        yield
    finally:
        hal.set_msg_level(level)


class Item:
    """One line of a watch list. Values are read from HAL when asked for."""

    def __init__(self, kind, name):
        self.kind, self.name, self.info = kind, name, None
        self.refresh()

    @property
    def word(self):
        return f"{self.kind}+{self.name}"

    def refresh(self):
        """Type, direction and connection again."""
        try:
            with quiet():
                self.info = find(self.kind, self.name)
        except RuntimeError:
            self.info = None
        return self.info

    @property
    def type(self):
        """Name of the HAL type in small letters: bit, float, s32, u32, s64, u64, port; "" when the item is gone."""
        if not self.info:
            return ""
        return {"BOOL": "bit", "REAL": "float", "SINT": "s64", "UINT": "u64"}.get(self.info["type"].name, self.info["type"].name.lower())

    @property
    def access(self):
        """"write"; "linked": a pin that could be written were it free; "read"."""
        if not self.info or self.type == "port":
            return "read"
        if self.kind == "sig":
            return "read" if self.info["writers"] else "write"
        if self.kind == "param":
            return "write" if self.info["dir"] == hal.HAL_RW else "read"
        if self.info["dir"] == hal.HAL_OUT:
            return "read"
        return "linked" if self.info["signal"] else "write"

    def value(self):
        """The value now, or None when the item is gone."""
        try:
            with quiet():
                return hal.get_s(self.name) if self.kind == "sig" else hal.get_p(self.name)
        except RuntimeError:
            return None

    def set(self, text):
        """RuntimeError, ValueError: why not."""
        (hal.set_s if self.kind == "sig" else hal.set_p)(self.name, convert(self.type, text))


def convert(type_, text):
    """A typed text as a value of this HAL type. ValueError: says what is needed."""
    text = str(text).strip()
    if type_ == "bit":
        word = text.lower()
        if word in ("1", "true", "on", "yes"):
            return True
        if word in ("0", "false", "off", "no"):
            return False
        raise ValueError(_("'%s' is no bit: 1, 0, true or false") % text)
    if type_ == "float":
        try:
            return float(with_point(plain(text)))
        except ValueError:
            raise ValueError(_("'%s' is no number") % text) from None
    bits = int(type_[1:])
    low, high = (-2 ** (bits - 1), 2 ** (bits - 1) - 1) if type_[0] == "s" else (0, 2 ** bits - 1)
    try:
        value = int(plain(text), 16 if "x" in text.lower() else 10)
    except ValueError:
        raise ValueError(_("'%s' is no whole number") % text) from None
    if not low <= value <= high:
        raise ValueError(_("%s is out of range: %s to %s") % (text, low, high))
    return value


class Formats:
    """Texts of values; the formats are Tcl's (empty: as halcmd shows them)."""

    def __init__(self, real="", integer=""):
        self.tcl = tkinter.Tcl()
        self.real, self.integer = real, integer

    def check(self, real, integer):
        """ValueError: what is wrong with one of them."""
        for text, value in ((real, 1.5), (integer, 1)):
            if text:
                try:
                    self.tcl.call("format", text, value)
                except tkinter.TclError as error:
                    raise ValueError(f"format '{text}': {error}") from None

    def text(self, type_, value):
        if value is None:
            return GONE
        if type_ == "bit":
            return "TRUE" if value else "FALSE"
        form = self.real if type_ == "float" else self.integer if type_ in ("s32", "u32") else ""
        if form:
            try:
                return str(self.tcl.call("format", form, value))
            except tkinter.TclError:
                pass
        return f"{value:.7g}" if type_ == "float" else str(value)


# -- lists of words and their files -------------------------------------------------------


def read_file(path):
    """Words of a watch list file, of either form. Raises OSError."""
    lines = Path(path).read_text(errors="replace").splitlines()
    return [word for line in lines if not line.startswith("#") for word in line.split()]


def file_text(words, multiline):
    if not multiline:
        return " ".join(words) + "\n"
    return f"{HEADER}{time.strftime('%a %b %d %H:%M:%S %Z %Y')}\n\n" + "".join(w + "\n" for w in words)


def from_hal_text(text):
    """Words for lines of a HAL file: net SIG PIN..., setp PARAM VALUE, or names of pins."""
    words = []
    for line in text.splitlines():
        parts = line.split("#")[0].replace("<=>", " ").replace("=>", " ").replace("<=", " ").split()
        if not parts:
            continue
        if parts[0] == "net":
            words += ["sig+" + n for n in parts[1:2]] + ["pin+" + n for n in parts[2:]]
        elif parts[0] == "setp":
            words += [("pin+" if is_pin(n) else "param+") + n for n in parts[1:2]]
        else:
            words += ["pin+" + n for n in parts]
    return list(dict.fromkeys(words))


def is_pin(name):
    try:
        return query.pin(name) is not None
    except RuntimeError:
        return False
