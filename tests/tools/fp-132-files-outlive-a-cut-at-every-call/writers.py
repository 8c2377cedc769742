# SPDX-License-Identifier: GPL-2.0-or-later
# Every place of the sources that opens a file for writing is known: what users keep goes through replace_file
# (run.py), the rest is named here.
import os
import re
from pathlib import Path

OPENS = re.compile(r"""\bopen\([^()\n]*(\([^()\n]*\)[^()\n]*)*,\s*(mode=)?["'](w|a|x)[bt+]?["']|\.write_(text|bytes)\(|\bfopen\([^;\n]*"(w|a)"""
                   r"""|\bofstream\b|\bO_CREAT\b|\[open [^\]\n]* (w|a)\]""")
TESTS = re.compile(r"(^|/)(test|tests|bench|fuzz)(/|-|_|\.)|_unit\.cc|_stages\.cc|_fuzz\.cc|_bench\.|-bench")
# Not kept: files of a session or a build, reports and exports that are asked for by name and made anew, logs, and what
# makes the others.
KNOWN = {
    "the way itself": "src/emc/ini/replace_file.cc",
    "of a session, in its own folder": "lib/python/axis/program.py lib/python/axis/reading.py "
                                       "lib/python/kerf/launcher.py lib/python/kerf/launch_logs.py "
                                       "lib/python/kerf/haltools/latency_test.py "
                                       "lib/python/kerf/haltools/latency_panel.py lib/python/kerf/screen_record.py "
                                       "src/emc/tool/toolstore.cc lib/python/kerf/runner.py",
    "reports, exports, logs": "lib/python/kerf/failures.py lib/python/kerf/launch_windows.py "
                              "lib/python/kerf/haltools/report.py lib/python/kerf/tktools/teach_in.py "
                              "src/hal/stream/halsampler.c src/hal/utils/halrmt/commands.cc "
                              "src/emc/motion/usr/motion_logger.c src/libnml/rcs_print.cc "
                              "src/hal/user_comps/panelui.py src/emc/rs274ngc/interp.cc "
                              "src/emc/rs274ngc/rs274_main.cc src/emc/task/task_canon.cc "
                              "src/hal/utils/halcmd/graph.cc scripts/linuxcnc_info lib/hallib/sim_lib.tcl",
    "made of templates, new": "lib/python/kerf/configs.py lib/python/kerf/tktools/ngcfiles.py",
    "all files of a configuration, after a copy of its folder": "lib/python/kerf/update_ini.py",
    "building": "src/hal/components/manuals.py src/hal/components/conv_gen.py src/hal/utils/halcompile/build.py "
                "src/hal/drivers/mesa-hostmot2/mesambccc.py src/hal/utils/halcompile/cli.py scripts/window-pictures "
                "scripts/runtests",
}
known = {name for names in KNOWN.values() for name in names.split()}
top = Path(os.environ["EMC2_HOME"])
found = set()
for path in (file for folder in ("src", "lib", "scripts", "tcl", "configs") for file in (top / folder).rglob("*")):
    name = str(path.relative_to(top))
    if (path.suffix in (".so", ".o", ".a", ".pyc") or TESTS.search(name) or path.suffix in (".md", ".po", ".ngc", ".png", ".mk") or path.is_symlink()
            or not path.is_file()):
        continue
    if OPENS.search(path.read_text(errors="replace")):
        found.add(name)
print("not known:", sorted(found - known))
