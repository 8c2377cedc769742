#!/bin/bash
exec ../../task/lib/machine-test script.py "$@" "RS274NGC.REMAP=M6 modalgroup=6 ngc=change" -file change.ngc -hal "!tool-change " \
    -hal "loadusr -W hal_manualtoolchange" -hal "net number iocontrol.0.tool-prep-number hal_manualtoolchange.number" \
    -hal "net asked iocontrol.0.tool-change hal_manualtoolchange.change" -hal "net answered hal_manualtoolchange.changed iocontrol.0.tool-changed"
