# SPDX-License-Identifier: GPL-2.0-or-later
import subprocess
from pathlib import Path

from mill import *

done = clock.run(["tclsh8.6", str(Path(__file__).with_suffix(".tcl"))], stdout=subprocess.PIPE,
                 stderr=subprocess.STDOUT, text=True)
print(done.stdout, end="")
