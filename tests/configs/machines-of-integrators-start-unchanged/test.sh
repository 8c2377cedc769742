#!/bin/bash
# Remapped built-in codes, codes and subs in Python, wear by tool number, HAL in two passes, extra joints, a locking
# indexer, shared home switches, switchable kinematics, random tools, two spindles, a cutter, an INI file of version 1.0:
# each machine starts, homes, runs its program within its limits and stops.
exec ../lib/run-written '^ *P is\|^[xy]=' "$LINUXCNC_NCFILES_DIR/remap_lib/python-stdglue"
