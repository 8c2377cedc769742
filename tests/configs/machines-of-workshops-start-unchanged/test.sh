#!/bin/bash
# A wizard's stepper, the same of version 1.0, a gantry, a lathe with encoder, a foam cutter in Tcl with arguments, an arm by
# Denavit-Hartenberg numbers, a tool changer with codes of its own, ladder logic, servos with included and sourced files, a
# panel of Python programs: each starts, homes, runs its program within its limits and stops. A card that is not there is named.
exec ../lib/run-written '^ *P is\|^M111\|no such module'
