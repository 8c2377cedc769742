# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the programs, modules and data of this build are: run in place or installed."""

import os
import re
import shutil
import site
import sys
from dataclasses import dataclass
from pathlib import Path


def put_first(env, name, *paths):
    """Paths that a list of an environment lacks, before its others."""
    old = [p for p in env.get(name, "").split(os.pathsep) if p]
    new = [str(p) for p in paths if str(p) not in old]
    env[name] = os.pathsep.join(new + old)


@dataclass(frozen=True)
class Tree:
    """Absolute directories. `home` is the source tree (in place) or the prefix (/usr)."""
    home: Path
    in_place: bool
    bin: Path
    scripts: Path
    python: Path
    rtlib: Path
    hallib: Path
    nml: Path
    configs: Path
    nc_files: Path
    tcl: Path
    realtime: Path
    share: Path

    @staticmethod
    def find():
        """The tree that this module is part of."""
        python = Path(__file__).resolve().parents[1]
        home = python.parents[1]
        if (home / "rtlib").is_dir() or (home / "configure.ac").is_file():
            return Tree(home, True, home / "bin", home / "scripts", python, home / "rtlib", home / "lib/hallib",
                        home / "configs/common/linuxcnc.nml", home / "configs", home / "nc_files", home / "tcl",
                        home / "scripts/realtime", home / "share")
        while home.name != "lib" and home.parent != home:    # PREFIX/lib/python3/dist-packages
            home = home.parent
        home = home.parent
        share = home / "share/linuxcnc"
        return Tree(home, False, home / "bin", home / "bin", python, home / "lib/linuxcnc/modules",
                    share / "hallib", share / "linuxcnc.nml", home / "share/doc/linuxcnc/examples/sample-configs",
                    share / "ncfiles", home / "share/tcltk/linuxcnc", home / "lib/linuxcnc/realtime", share)

    @property
    def locale(self):
        """Where gettext finds the translations."""
        return self.home / "share/locale"

    def version(self):
        """Version text, as configure wrote it."""
        for path in (self.home / "src/config.h", self.share / "config.h"):
            try:
                found = re.search(r'^#define PACKAGE_VERSION "(.*)"', path.read_text(), re.MULTILINE)
            except OSError:
                continue
            if found:
                return found[1]
        return "unknown"

    def prefer_own_python(self, env):
        """Scripts that begin with `#!/usr/bin/env python3` shall get the Python that our modules are made for, and find
        them, unless the user works in a virtual environment."""
        python = shutil.which("python3", path=env.get("PATH"))
        if "VIRTUAL_ENV" not in env and python and os.path.realpath(python) != os.path.realpath(sys.executable):
            own = str(self.home / ("objects/python" if self.in_place else "lib/linuxcnc/python"))
            env["PATH"] = os.pathsep.join([own, *(p for p in env["PATH"].split(os.pathsep) if p != own)])
        if str(self.python) not in site.getsitepackages():
            put_first(env, "PYTHONPATH", self.python)

    def environment(self):
        """Copy of the environment in which our programs find each other."""
        env = dict(os.environ)

        def prefix(name, *paths):
            put_first(env, name, *paths)

        self.prefer_own_python(env)
        if self.in_place:
            prefix("PATH", self.scripts, self.bin)
            prefix("LD_LIBRARY_PATH", self.home / "lib")
            env["TCLLIBPATH"] = " ".join(filter(None, [str(self.tcl), env.get("TCLLIBPATH", "")]))
            env.update(EMC2_HOME=str(self.home), LINUXCNC_RIP_FLAG="True", EMC2VERSION=self.version())
        else:
            prefix("PATH", self.bin)
            env["TCLLIBPATH"] = " ".join(filter(None, [str(self.tcl), env.get("TCLLIBPATH", "")]))
        env.update(LINUXCNC_HOME=str(self.home), LINUXCNCVERSION=self.version(),
                   LINUXCNC_NCFILES_DIR=str(self.nc_files), LINUXCNC_TCL_DIR=str(self.tcl),
                   LINUXCNC_EMCSH="/usr/bin/wish8.6", REALTIME=str(self.realtime),
                   HALLIB_DIR=str(self.hallib), HAL_RTMOD_DIR=str(self.rtlib),
                   LINUXCNC_HELP_DIR=str(self.home / "docs/help"), LINUXCNC_LANG_DIR=str(self.tcl / "msgs"))
        return env

