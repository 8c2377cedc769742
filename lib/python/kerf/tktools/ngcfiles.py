# SPDX-License-Identifier: GPL-2.0-or-later
"""Subroutine files as forms: their parameters, and programs made of calls with the values that were typed.

A file NAME.ngc has one subroutine o<NAME>; its first lines name the parameters:

    #<width> = #1 (=20.5 width of the pocket)

NAME.gcmc files name theirs in comments: //ngcgui: width = 20.5, width of the pocket
"""

import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from .. import files
from ..language import _

MOST = 30                       # parameters of a subroutine, and names of a gcmc file
FEATURE = " FEATURE "           # in a comment: the file was made by this program
BACKUP = Path("/tmp/ngcgui_bak")
PICTURES = (".png", ".gif", ".jpg", ".pgm")
LABEL = re.compile(r"^o(<[^>]*>|\d+)([a-z]+)(.*)$")
NAMED = re.compile(r"^#<([^>]+)>=#(\d+)$")
COMMENT = re.compile(r"\(([^()]*)\)|;(.*)$")
WORDS_ENDING = ("m2", "m30", "%")


class NotUsable(Exception):
    """FILE:LINE: why this file is no form."""


@dataclass
class Parameter:
    """number: of the call, from 1. An empty default must be filled in."""
    number: int
    name: str
    default: str = ""
    label: str = ""


def bare(line):
    """A line as the interpreter sees it: no comments, no blanks, small letters."""
    return re.sub(r"\s+", "", COMMENT.sub("", line)).lower()


def comments(line):
    return [m[1] if m[1] is not None else m[2] for m in COMMENT.finditer(line)]


@dataclass
class Form:
    """What all kinds of files offer."""
    path: Path
    parameters: list = field(default_factory=list)
    info: str = ""
    picture: Path = None

    def find_picture(self):
        self.picture = next((p for p in (self.path.with_suffix(e) for e in PICTURES) if p.is_file()), None)

    def checked(self, values):
        """Texts of numbers for the parameters. ValueError: the first that is none."""
        texts = []
        for parameter, value in zip(self.parameters, values):
            if not is_value(value):
                raise ValueError(_("%s: %r is no number") % (parameter.name, value) if value.strip()
                                 else _("%s: a value is missing") % parameter.name)
            texts.append(value.strip())
        return texts


def is_value(text):
    """A number as G-code has it: without an exponent."""
    return bool(re.fullmatch(r"\s*[+-]?(\d+\.?\d*|\.\d+)\s*", text))


class Subroutine(Form):
    """A file with one subroutine. Raises NotUsable, OSError."""

    def __init__(self, path):
        super().__init__(Path(path))
        self.name = self.path.stem
        self.lines = self.path.read_text(errors="replace").splitlines()
        self.body = []
        named, used, state = {}, set(), "before"
        for count, line in enumerate(self.lines, 1):
            for comment in comments(line):
                if "not_a_subfile" in comment:
                    self.fail(count, _("it says that it is not a subfile"))
                if FEATURE in f" {comment} ":
                    self.fail(count, _("it was made by ngcgui (FEATURE): a subroutine file is needed"))
                if comment.strip().lower().startswith("info:") and not self.info:
                    self.info = comment.strip()[5:].strip()
        for count, line in enumerate(self.lines, 1):
            text = bare(line)
            label = LABEL.match(text)
            if label and label[2] in ("sub", "endsub"):
                self.check_label(count, label, state)
                state = "inside" if label[2] == "sub" else "after"
                continue
            if state != "inside":
                if text and not (state == "after" and text in WORDS_ENDING) and text != "%":
                    self.fail(count, _("'%s' is outside of the subroutine: only comments may be") % line.strip())
                continue
            if label and label[1].isdigit():
                self.fail(count, _("o%s: numbered o-words are not possible here: give it a name (o<...>)") % label[1])
            if match := NAMED.match(text):
                self.take(count, match, line, named)
            used |= {int(n) for n in re.findall(r"#(\d+)", text) if 1 <= int(n) <= MOST}
            self.body.append(line)
        if state != "after":
            self.fail(len(self.lines), _("o<%s> %s is missing") % (self.name, 'endsub' if state == 'inside' else 'sub'))
        numbers = set(named) | used
        if numbers and numbers != set(range(1, max(numbers) + 1)):
            missing = min(set(range(1, max(numbers) + 1)) - numbers)
            self.fail(1, _("parameter #%s is missing: the numbers must follow each other from 1") % missing)
        self.parameters = [named.get(n) or Parameter(n, f"#{n}") for n in sorted(numbers)]
        self.find_picture()

    def fail(self, line, why):
        raise NotUsable(f"{self.path}:{line}: {why}")

    def check_label(self, count, label, state):
        if label[1] != f"<{self.name.lower()}>":
            self.fail(count, _("the subroutine is o%s: it must have the name of the file, o<%s>")
                      % (label[1], self.name))
        if state != ("before" if label[2] == "sub" else "inside"):
            self.fail(count, _("only one subroutine may be in the file") if label[2] == "sub"
                      else _("endsub without sub"))

    def take(self, count, match, line, named):
        number = int(match[2])
        if not 1 <= number <= MOST:
            if number > MOST:
                self.fail(count, _("#%s: at most %s parameters are possible") % (number, MOST))
            return
        if number in named:
            return
        name = re.search(r"#<\s*([^>]+?)\s*>", line)[1]
        comment = next(iter(comments(line)), "").strip()
        default = ""
        if comment.startswith("="):
            words = comment[1:].strip().split(None, 1)
            default = words[0] if words else ""
            comment = words[1] if len(words) > 1 else ""
        named[number] = Parameter(number, name, default, comment or name)

    def call(self, values):
        return [f"o<{self.name}> call " + " ".join(f"[{v}]" for v in self.checked(values))]

    def expanded(self, values, feature):
        """The body in place of a call; labels get the number of the feature."""
        texts = self.checked(values)
        lines = [f"(expanded: {self.path.name})"]
        for parameter, text in zip(self.parameters, texts):
            lines.append(f"#{parameter.number} = {text}")
        for line in self.body:
            lines.append(re.sub(r"^(\s*[oO]\s*<)([^>]*>)", lambda m: f"{m[1]}{feature:03d}{m[2]}", line)
                         if not re.match(r"^\s*[oO]\s*<[^>]*>\s*call", line, re.I) else line)
        return lines


class Gcmc(Form):
    """A file for the compiler gcmc. Raises NotUsable, OSError."""

    def __init__(self, path, include=()):
        super().__init__(Path(path))
        self.options, self.include = [], list(include)
        seen = set()
        for line in self.path.read_text(errors="replace").splitlines():
            match = re.match(r"\s*//\s*ngcgui\s*:\s*(.*)$", line)
            if not match:
                continue
            text = match[1].strip()
            if text.startswith("-"):
                self.options.append(text.split("//")[0].strip())
            elif text.startswith("info:"):
                self.info = text[5:].strip()
            elif entry := re.match(r"([A-Za-z_]\w*)\s*(?:=\s*([^,;]*))?(?:;[^,]*)?(?:,\s*(.*))?$", text):
                if entry[1] not in seen and len(seen) < MOST:
                    seen.add(entry[1])
                    self.parameters.append(Parameter(len(seen), entry[1], (entry[2] or "").strip(),
                                                     (entry[3] or entry[1]).strip()))
        self.find_picture()

    def call(self, values):
        """What the compiler makes. NotUsable: it is missing, or complains."""
        program = shutil.which("gcmc")
        if not program:
            raise NotUsable(_("%s: the program gcmc is not installed") % self.path)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out.ngc"
            words = [program, "--output", str(out)] + [f"--include={p}" for p in self.include] + self.options
            words += [f"--define={p.name}={v}"
                      for p, v in zip(self.parameters, self.checked(values))] + [str(self.path)]
            done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            if done.returncode:
                raise NotUsable(f"{self.path}: {done.stdout.strip()}")
            return [line for line in out.read_text().splitlines() if bare(line) not in WORDS_ENDING]

    def expanded(self, values, _feature):
        return self.call(values)


def form_of(path, include=()):
    return Gcmc(path, include) if str(path).endswith(".gcmc") else Subroutine(path)


def note(text):
    """A comment of the program; it cannot hold another."""
    return "(" + text.replace("(", "[").replace(")", "]") + ")"


def frame_lines(name):
    """Lines of a preamble or postamble: a file, or after a colon G-code with ; between commands. OSError."""
    if not name:
        return []
    if name.startswith(":"):
        return [part.strip() for part in name[1:].split(";") if part.strip()]
    return [line for line in Path(name).read_text(errors="replace").splitlines() if bare(line) not in WORDS_ENDING]


class Program:
    """Features that make one program. m2: it ends with m2, else it stands between lines with %.

    verbose: comments with the values; the comment FEATURE is always there, so that the result is known as one.
    """

    def __init__(self, preamble="", postamble="", m2=True):
        self.preamble, self.postamble, self.m2, self.verbose, self.features = preamble, postamble, m2, True, []

    def add(self, form, values, expand=False):
        """ValueError, NotUsable: nothing is added."""
        number = len(self.features)
        lines = form.expanded(values, number) if expand else form.call(values)
        notes = [note(f"{p.number:2d} {p.name} = {v.strip()}") for p, v in zip(form.parameters, values)]
        self.features.append((form.path.name, notes, lines))

    def text(self):
        """OSError: preamble or postamble cannot be read."""
        lines = [] if self.m2 else ["%"]
        lines += [note(f"ngcgui: preamble {self.preamble}")] if self.preamble and self.verbose else []
        lines += frame_lines(self.preamble)
        count = len(self.features)
        for number, (name, notes, body) in enumerate(self.features):
            lines += [note(f"ngcgui: FEATURE {number + 1} of {count}: {name}"), f"#<_feature:> = {number}",
                      f"#<_remaining_features:> = {count - number - 1}"]
            lines += notes + body if self.verbose else body
        lines += [note(f"ngcgui: postamble {self.postamble}")] if self.postamble and self.verbose else []
        lines += frame_lines(self.postamble)
        lines.append("m2" if self.m2 else "%")
        return "\n".join(lines) + "\n"

    def write(self, path):
        """The program as a file, with a copy in a backup folder. OSError."""
        path, text = Path(path), self.text()
        files.replace(path, text)
        for folder in backup_folders():
            try:
                folder.mkdir(exist_ok=True)
                (folder / path.name).write_text(text)
                break
            except OSError:
                continue
        return path


def backup_folders():
    """Where copies go: the documented folder, or one of this user's where that is another user's."""
    return BACKUP, Path(f"{BACKUP}-{os.getuid()}")


def folders_of(path):
    """The folders of a list with colons, or of None."""
    return [os.path.expanduser(word.strip()) for word in (path or "").split(":") if word.strip()]


def start_folder(ini_find):
    """Where subroutine files are looked for: [RS274NGC]SUBROUTINE_PATH, [DISPLAY]PROGRAM_PREFIX, the present folder."""
    paths = ini_find("RS274NGC", "SUBROUTINE_PATH") or ""
    first = paths.split(":")[0].strip() or ini_find("DISPLAY", "PROGRAM_PREFIX") or "."
    return Path(os.path.expanduser(first))


def find_file(name, ini_find, base="."):
    """A file that the INI file names: as it is, below [DISPLAY]NGCGUI_SUBFILE_PATH, [RS274NGC]SUBROUTINE_PATH or
    [DISPLAY]PROGRAM_PREFIX, relative to base; the name itself where there is none."""
    if not name or name.startswith(":") or Path(name).exists():
        return name
    paths = [ini_find("DISPLAY", "NGCGUI_SUBFILE_PATH"), ini_find("RS274NGC", "SUBROUTINE_PATH"),
             ini_find("DISPLAY", "PROGRAM_PREFIX"), "."]
    places = (Path(base, folder, name) for path in paths for folder in folders_of(path))
    return next((str(place) for place in places if place.is_file()), name)
