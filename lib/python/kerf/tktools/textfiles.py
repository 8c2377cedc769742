# SPDX-License-Identifier: GPL-2.0-or-later
"""Subroutine files of text: what a tracing program ([DISPLAY]TTT, truetype-tracer) writes becomes a form of ngcgui.

The program writes G-code to standard output. Settings at its head, `#1=0.1 (safe height)` in order from #1 or
`#<depth>=-0.5 (depth)`, become the parameters of the subroutine; other numbers up to #30 become names, the end (M2,
M30, %) goes.
"""

import re
import shlex
import subprocess
import tempfile
from pathlib import Path

from .. import files
from ..language import _
from .ngcfiles import MOST, bare, comments, is_value, note

DEFAULT = "truetype-tracer"
MADE = "made of text: may be written anew"
SETTING = re.compile(r"^#(\d+|<[^>]+>)=([-+.\d]+)$")
NUMBER = re.compile(r"#(\d+)")
ENDINGS = ("m2", "m02", "m30", "%")


class Failed(Exception):
    """Why there is no G-code, in a sentence."""


def word_of(text, fallback):
    """A name of a parameter or a file."""
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")[:40].strip("_") or fallback


def command_of(program, font, scale, text, more=""):
    """The command line. ValueError: quotes that do not end."""
    words = shlex.split(program or DEFAULT) + shlex.split(more)
    return words + (["-f", font] if font else []) + (["-s", scale] if scale else []) + [text]


class Tracing:
    """The program at work. poll() is None until there is a result, then its G-code; Failed says why there is none."""

    def __init__(self, command):
        self.name, self.out, self.trouble = command[0], tempfile.TemporaryFile(), tempfile.TemporaryFile()
        try:
            self.child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=self.out, stderr=self.trouble,
                                          start_new_session=True)
        except OSError as error:
            missing = isinstance(error, FileNotFoundError)
            raise Failed(_("%s is not installed: install it, or name another program in [DISPLAY]TTT") % self.name
                         if missing else f"{self.name}: {error.strerror}") from None

    def poll(self):
        status = self.child.poll()
        if status is None:
            return None
        texts = []
        for stream in (self.out, self.trouble):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
            stream.close()
        code, trouble = texts
        if status or not any(bare(line) for line in code.splitlines()):
            why = trouble.strip().splitlines()[:1] or [_("status %d") % status if status else _("it wrote nothing")]
            raise Failed(f"{self.name}: {why[0]}")
        return code

    def end(self):
        if self.child.poll() is None:
            self.child.kill()
            self.child.wait()


def subroutine(name, code, info):
    """The text of the file NAME.ngc, from the program's G-code."""
    parameters, body, head, named = [], [], True, set()
    for line in code.splitlines():
        plain = bare(line)
        setting = SETTING.match(plain)
        if plain in ENDINGS:
            continue
        head = head and (not plain or setting is not None)
        if head and setting and is_value(setting[2]) and len(parameters) < MOST:
            number, label = len(parameters) + 1, " ".join(comments(line)).strip(" =")
            if setting[1].startswith("<") or setting[1] == str(number):
                word = setting[1][1:-1] if setting[1].startswith("<") else word_of(label, f"p{number}")
                while word in named:
                    word += "_"
                named.add(word)
                parameters.append(f"#<{word}> = #{number} (={setting[2]} {note(label)[1:-1]})")
                continue
        body.append(line.rstrip())
    body = [NUMBER.sub(lambda m: m[0] if not len(parameters) < int(m[1]) <= MOST else f"#<n{m[1]}>", line)
            for line in body]
    return "\n".join([note("info: " + info), note(MADE), f"o<{name}> sub", *parameters, *body, f"o<{name}> endsub", ""])


def write(path, text):
    """The file, unless one is there that was not made here. Failed, OSError."""
    path = Path(path)
    if path.exists() and note(MADE) not in path.read_text(errors="replace").splitlines()[:2]:
        raise Failed(_("%s is there and was not made of text: choose another name") % path.name)
    files.replace(path, text)
