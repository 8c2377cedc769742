#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# No traceback: schedrmt without its INI file, and on a port that another program has.
schedrmt -- -ini nothere.ini 2>&1
echo "status $?"
for option in "-p 99999" "-p 0" "-s -1"; do
    schedrmt $option 2>&1 | tail -n 1
done
/usr/bin/python3 - <<'END'
import os, socket, subprocess
with socket.create_server(("127.0.0.1", 0)) as taken:
    port = taken.getsockname()[1]
    done = subprocess.run(["schedrmt", "-p", str(port), "-ini", f"{os.environ['EMC2_HOME']}/configs/sim/mill/mill.ini"],
                          stderr=subprocess.PIPE, text=True)
print(done.stderr.replace(str(port), "PORT"), end="")
print("status", done.returncode)
END
