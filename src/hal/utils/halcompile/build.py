# SPDX-License-Identifier: GPL-2.0-or-later
"""Building and installing: make with Makefile.modinc does the work."""

from __future__ import annotations

import codecs
import os
import shutil
import stat
import subprocess
import sys
import tempfile

from .errors import UsageError

BINDIR = os.environ.get("KERF_HALCOMPILE_BINDIR") or os.path.dirname(os.path.abspath(sys.argv[0]))


def modinc(bindir: str | None = None) -> str:
    """The path of Makefile.modinc, sought from where the program lies."""
    parent = os.path.dirname(os.path.abspath(bindir or BINDIR))
    for place in (parent + "/src", parent + "/etc/linuxcnc", "/etc/linuxcnc", parent + "/share/linuxcnc"):
        path = place + "/Makefile.modinc"
        if os.path.isfile(path):
            return path
    raise UsageError("Unable to locate Makefile.modinc")


class BuildFailed(Exception):
    def __init__(self, status: int):
        super().__init__(f"make failed with status {status}")
        self.status = status


def _make(directory: str, *words: str) -> None:
    environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    status = subprocess.call(["make", "--no-print-directory", "-C", directory, *words], env=environment)
    if status:
        raise BuildFailed(status)


def _quoted(path: str) -> str:
    return "'" + path.replace("'", "'\\''").replace("$", "$$").replace("#", "\\#") + "'"


def user_module_dir() -> str:
    """Where --install puts programs."""
    return os.environ.get("USER_MODULE_DIR") or BINDIR


def build_rt(c_file: str, name: str, source_dir: str, workdir: str, install: bool) -> None:
    """Builds NAME.so from c_file (in workdir); leaves it in the current
    directory, or in the realtime module directory."""
    with open(os.path.join(workdir, "Makefile"), "w") as f:
        print(f"obj-m += {name}.o", file=f)
        print(f"EXTRA_CFLAGS += -I{_quoted(os.path.abspath(source_dir))} -I{_quoted(os.getcwd())}", file=f)
        print(f"include {modinc()}", file=f)
    if os.path.dirname(os.path.abspath(c_file)) != os.path.abspath(workdir):
        shutil.copy(c_file, os.path.join(workdir, name + ".c"))
    _make(workdir, *(["modules", "install"] if install else ["modules"]))
    if not install:
        shutil.copy(os.path.join(workdir, name + ".so"), os.getcwd())


def build_user(c_file: str, name: str, source_dir: str, workdir: str, install: bool,
               compile_args: str = "", link_args: str = "") -> None:
    """Builds the program NAME; leaves it beside its source, or installs it."""
    with open(os.path.join(workdir, "Makefile"), "w") as f:
        print(f"include {modinc()}", file=f)
        print(f".PHONY: {name}\n{name}:", file=f)
        print(f"\t$(CC) -I{_quoted(os.path.abspath(source_dir))} $(MODINC_INCLUDE) "
              "-URTAPI -U__MODULE__ -DULAPI -DUSPACE -O2 "
              f"{compile_args} -o $@ {_quoted(c_file)} -Wl,-rpath,$(LIBDIR) -L$(LIBDIR) -llinuxcnchal "
              f"{link_args} -lm", file=f)
    _make(workdir, "-s" if "s" in os.environ.get("MAKEFLAGS", "").split(" ")[0] else "--", name)
    built = os.path.join(workdir, name)
    if install:
        install_file(built, user_module_dir(), name, 0o755)
    else:
        shutil.copy(built, source_dir or ".")


def install_file(path: str, directory: str, name: str, mode: int) -> None:
    directory = os.environ.get("DESTDIR", "") + directory
    os.makedirs(directory, exist_ok=True)
    target = os.path.join(directory, name)
    if os.path.lexists(target):
        os.unlink(target)
    shutil.copy(path, target)
    os.chmod(target, mode)


def install_python(path: str) -> None:
    """Installs a Python program: first line names this interpreter, no .py, mode 0555."""
    with open(path, "rb") as f:                 # bytes: it may name an encoding of its own
        lines = f.read().removeprefix(codecs.BOM_UTF8).replace(b"\r\n", b"\n").split(b"\n")
    if lines[0].startswith(b"#!"):
        del lines[0]
    with tempfile.NamedTemporaryFile(delete=False) as f:
        f.write(b"\n".join([b"#!" + os.fsencode(sys.executable), *lines]))
    try:
        install_file(f.name, user_module_dir(), os.path.splitext(os.path.basename(path))[0],
                     stat.S_IRUSR | stat.S_IXUSR | stat.S_IRGRP | stat.S_IXGRP | stat.S_IROTH | stat.S_IXOTH)
    finally:
        os.unlink(f.name)


def man_dir(number: int) -> str:
    """Where --install-doc puts pages of a section."""
    prefix = os.path.dirname(BINDIR)
    share = f"{prefix}/share/man/man{number}"
    return share if os.path.isdir(share) else f"{prefix}/docs/build/man/man{number}"
