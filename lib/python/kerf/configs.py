# SPDX-License-Identifier: GPL-2.0-or-later
"""Configurations that can be picked, and the user's own copies of them; no window here.

Sources: launcher reference, section 2 (picker). All paths are absolute `Path`s.
"""

import os
import re
import shutil
import stat
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from . import files
from .language import _

FIRST = ("sim", "by_interface", "by_machine", "axis", "ngcgui", "touchy", "gscreen", "gmoccapy", "low_graphics")
NEVER_COPIED = ("maintainer.txt", "nodemocopy")
AUX_EXAMPLES = "/usr/share/linuxcnc/aux_examples"
README_NGC = """(Programs of your own go here.)
(examples: the programs that came with the controller)
(NAME_lib: libraries of subroutines; add them to [RS274NGC]SUBROUTINE_PATH)
m2
"""


@dataclass
class Node:
    """A folder (with children) or a file that can be started."""
    name: str
    path: Path
    children: list = field(default_factory=list)

    @property
    def is_file(self):
        return not self.children


def user_configs():
    return Path.home() / "linuxcnc/configs"


def search_path(tree, environ=os.environ):
    """Folders with configurations, the user's first, the samples last. Missing ones are left out."""
    middle = [] if tree.in_place else [Path("/usr/local/etc/linuxcnc/configs")]
    aux = Path(AUX_EXAMPLES)
    if aux.is_dir():
        middle += sorted(p for p in aux.iterdir() if p.is_dir())
    middle += [Path(p) for p in environ.get("LINUXCNC_AUX_CONFIGS", "").split(os.pathsep) if p]
    return [p for p in [user_configs(), *middle, tree.configs] if p.is_dir()]


def title(path, tree):
    """What the picker calls a folder of the search path."""
    if path == user_configs():
        return _("My Configurations")
    return _("Sample Configurations") if path == tree.configs else str(path)


def scan(folder, samples=False, seen=()):
    """Nodes below a folder: files first, then folders that contain any; links are followed once."""
    real = folder.resolve()
    if real in seen:
        return []
    files, folders = [], []
    try:
        entries = sorted(folder.iterdir(), key=lambda p: p.name.lower())
    except OSError:
        return []
    for entry in entries:
        if entry.is_dir():
            if entry.name != "common" and not entry.name.startswith("."):
                children = scan(entry, seen=(*seen, real))
                if children:
                    folders.append(Node(entry.name, entry, children))
        elif entry.suffix in (".ini", ".demo") and entry.name != "_panelui.ini":
            files.append(Node(entry.stem, entry))
    if samples:
        rank = {name: i for i, name in enumerate(FIRST)}
        folders.sort(key=lambda n: (rank.get(n.name, len(FIRST)), n.name.lower()))
    return files + folders


def details(path):
    """(description, picture or None) of a file or folder."""
    folder = path if path.is_dir() else path.parent
    candidates = [folder / "README"] if path.is_dir() else [path.with_suffix(".txt"), folder / "README"]
    text = next((c.read_text(errors="replace") for c in candidates if c.is_file()), _("No details available."))
    pictures = [folder / "logo.gif"] if path.is_dir() else [path.with_suffix(".gif"), folder / "logo.gif"]
    return text, next((p for p in pictures if p.is_file()), None)


def usable(path):
    """The path can be started: an INI file, or an executable .demo."""
    return path.is_file() and (path.suffix == ".ini" or (path.suffix == ".demo" and os.access(path, os.X_OK)))


def needs_copy(path, tree, environ=os.environ):
    """The user should work on a copy of this configuration."""
    folder = path.parent
    if path.suffix == ".demo" and (folder / "nodemocopy").exists():
        return False
    if not os.access(folder, os.W_OK):
        return True
    aux = [Path(p) for p in environ.get("LINUXCNC_AUX_CONFIGS", "").split(os.pathsep) if p]
    if any(root in path.parents for root in aux):
        return True
    return not tree.in_place and user_configs() not in path.parents


def sample_root(path, roots):
    """The folder of the search path that a file belongs to, else its own folder's parent."""
    return next((root for root in roots if root in path.parents), path.parent.parent)


def copy(path, tree, roots):
    """Copies the folder of a configuration below the user's configurations; returns the new path.

    Links become files, the programs' prefix becomes the user's, sub-folders with
    configurations of their own stay behind. Raises OSError, and leaves no part of a copy then.
    """
    source = path.parent
    name = ".".join(source.relative_to(sample_root(path, roots)).parts) or source.name
    target = user_configs() / name
    number = 0
    while target.exists():
        number += 1
        target = user_configs() / f"{name}-{number}"
    try:
        copy_folder(source, target)
        hallib = target / "hallib"
        if not hallib.exists():
            hallib.symlink_to(tree.hallib)
        for ini in target.glob("*.ini"):
            text = ini.read_text(errors="surrogateescape")
            prefix = f"PROGRAM_PREFIX = {Path.home() / 'linuxcnc/nc_files'}"
            ini.write_text(re.sub(r"(?m)^[ \t]*PROGRAM_PREFIX[ \t]*=.*$", lambda match: prefix, text),
                           errors="surrogateescape")
        make_nc_files(tree)
    except OSError:
        shutil.rmtree(target, ignore_errors=True)
        raise
    return target / path.name


def copy_folder(source, target):
    target.mkdir(parents=True)
    for entry in sorted(source.iterdir()):
        if entry.name in NEVER_COPIED or (entry.is_symlink() and entry.name == "nc_files"):
            continue
        to = target / entry.name
        if entry.is_dir():
            if not any(f.suffix in (".ini", ".demo") for f in entry.rglob("*")):
                copy_folder(entry, to)
        elif entry.is_file():
            shutil.copyfile(entry, to)
            to.chmod(stat.S_IMODE(entry.stat().st_mode) | stat.S_IWUSR | stat.S_IRUSR)


def make_nc_files(tree):
    """The user's folder of programs, with links to the samples and the libraries."""
    mine = Path.home() / "linuxcnc/nc_files"
    mine.mkdir(parents=True, exist_ok=True)
    links = {"examples": tree.nc_files}
    if tree.nc_files.is_dir():
        links.update({p.name: p for p in sorted(tree.nc_files.iterdir()) if p.is_dir() and p.name.endswith("_lib")})
    for name, to in links.items():
        if not (mine / name).is_symlink() and not (mine / name).exists():
            (mine / name).symlink_to(to)
    if not (mine / "readme.ngc").exists():
        (mine / "readme.ngc").write_text(README_NGC)


def remember(path):
    """Keeps [PICKCONFIG]LAST_CONFIG of ~/.linuxcncrc; other lines stay."""
    rc = Path.home() / ".linuxcncrc"
    lines = rc.read_text(errors="surrogateescape").splitlines() if rc.exists() else []
    lines = [line for line in lines if not re.match(r"\s*LAST_CONFIG\s*=", line)]
    if "[PICKCONFIG]" not in lines:
        lines.append("[PICKCONFIG]")
    lines.insert(lines.index("[PICKCONFIG]") + 1, f"LAST_CONFIG = {path}")
    files.replace(rc, "\n".join(lines) + "\n")


def desktop_entry(path, tree, name, comment=""):
    """Text of a desktop entry that starts the file; empty for another kind of file."""
    if path.suffix not in (".ini", ".demo"):
        return ""
    start = str(path) if path.suffix == ".demo" else f"{tree.scripts / 'linuxcnc'} '{path}'"
    return (f"[Desktop Entry]\nName={name}\nExec={start}\nType=Application\nComment={comment}\n"
            f"Icon=linuxcncicon\n")


def desktop_folder():
    """The user's desktop."""
    try:
        found = subprocess.run(["xdg-user-dir", "DESKTOP"], stdout=subprocess.PIPE, text=True,
                               check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        found = ""
    return Path(found) if found else Path.home() / "Desktop"


def make_shortcut(path, tree):
    """Puts a shortcut on the desktop; returns its path. Raises OSError."""
    folder = desktop_folder()
    folder.mkdir(parents=True, exist_ok=True)
    shortcut = folder / f"{path.stem}.desktop"
    shortcut.write_text(desktop_entry(path, tree, path.stem))
    shortcut.chmod(0o755)
    return shortcut
