#!/usr/bin/env python3
import linuxcnc
e = linuxcnc.error_channel()
while True:
    error = e.poll()
    if not error:
        break
    kind, text = error
    if kind in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR):
        typus = "error"
    else:
        typus = "info"
    print(typus, text)
