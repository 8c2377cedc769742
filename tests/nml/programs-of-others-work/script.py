# SPDX-License-Identifier: GPL-2.0-or-later
# Programs as others write them: in C++ with the classic headers, in Python, in Tcl; on this computer
# and over TCP.
import os
from mill import *

here = Path(__file__).resolve().parent
built = Path(os.environ["BUILT"])


def start(*command):
    clock.suspend()  # they sleep in real time
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    clock.resume()
    print("==", *[Path(c).name for c in command if c != "/usr/bin/python3"])
    print(done.stdout + (f"status {done.returncode}\n" if done.returncode else ""), end="")


def python(name, *arguments):
    start("/usr/bin/python3", here / "programs" / f"{name}.py", *arguments)


start(built / "operate")
python("status_dump")
python("mdi_sender", "G0 X0 Y0 Z0", "G1 F600 X5", "G1 F0 X0")
python("error_logger")
python("pendant")
python("tools")
os.environ["LINUXCNC_TCL_DIR"] = str(Path(os.environ["EMC2_HOME"]) / "tcl")
start(here / "programs" / "monitor.tcl")
files = Path(os.environ["EMC2_HOME"]) / "configs/common"
Path("client.nml").write_text((files / "client.nml").read_text().replace("192.168.0.4", "127.0.0.1"))
python("remote", "client.nml")
python("buttons")
