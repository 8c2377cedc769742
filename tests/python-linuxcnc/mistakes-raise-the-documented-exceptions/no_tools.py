# SPDX-License-Identifier: GPL-2.0-or-later
# A status buffer, but no tool data: said once, the rest works.
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["EMC2_HOME"]) / "tests/nml/lib"))
from wire import Server

os.environ["HOME"] = os.getcwd()
server = Server()
import linuxcnc

linuxcnc.nmlfile = str(Path("test.nml").resolve())
stat = linuxcnc.stat()
for _ in range(3):
    stat.poll()
print(stat.tool_table, stat.taskbeat)
server.stop()
