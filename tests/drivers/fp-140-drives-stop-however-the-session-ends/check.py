# SPDX-License-Identifier: GPL-2.0-or-later
"""Drives on ptys, and a machine that has them all on its spindle; how it ends differs."""
import os
import subprocess
import tempfile
import threading
import time
from pathlib import Path

from mitsubishi_line import Drive, Line
from modbus_device import SerialDevice

folder = Path(tempfile.mkdtemp())
wj200 = SerialDevice(1, 0x1100, str(folder / "wj200"))
vfdb = SerialDevice(1, 0x2200, str(folder / "vfdb"))
mitsub = Drive()
line = Line(str(folder / "mitsub"), {b"00": mitsub})
RUNS = {"wj200_vfd": lambda: wj200.coils[0], "vfdb_vfd": lambda: vfdb.holding[0x2000] & 2,
        "mitsub_vfd": lambda: mitsub.turns != "00"}
HAL = [f"loadusr -Wn wj200_vfd wj200_vfd --device {folder}/wj200", f"loadusr -Wn vfdb_vfd vfdb_vfd",
       f"loadusr -Wn mitsub_vfd mitsub_vfd -p {folder}/mitsub", "setp wj200-vfd.0.mbslaveaddr 1",
       "setp wj200-vfd.0.enable 1", "setp vfdb_vfd.enable 1", "setp vfdb_vfd.loop-time 0.01",
       "net turns spindle.0.on => wj200-vfd.0.run vfdb_vfd.spindle-on mitsub_vfd.run"]


def simulate(at, value):
    if at == 0:
        wj200.coils[0x0E] = value == 0xFF00


def look():
    while True:
        if all(runs() for runs in RUNS.values()):
            (folder / "turning").touch()
        time.sleep(0.01)


wj200.watch = simulate
threading.Thread(target=look, daemon=True).start()
for way in ("screen", "milltask", "launcher", "rtapi_app"):
    (folder / "turning").unlink(missing_ok=True)
    words = [word for text in HAL for word in ("-hal", text)]
    subprocess.run(["../../task/lib/machine-test", "script.py", f"VFD-B.DEVICE={folder}/vfdb", "VFD-B.PARITY=none",
                    "TRAJ.NO_FORCE_HOMING=1", *words],
                   env=os.environ | {"WAY": way, "TURNING": str(folder / "turning")}, stdout=open("out", "w"),
                   stderr=subprocess.STDOUT, timeout=90)
    turned = (folder / "turning").exists()
    end = time.monotonic() + 15
    while time.monotonic() < end and any(runs() for runs in RUNS.values()):
        time.sleep(0.01)
    print(way, "turned" if turned else "DID NOT TURN",
          {name: "runs" if runs() else "stopped" for name, runs in RUNS.items()})
for name in ("wj200", "vfdb", "mitsub", "turning"):
    (folder / name).unlink(missing_ok=True)
folder.rmdir()
os.unlink("out")
