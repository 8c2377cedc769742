#!/bin/bash
exec ../../task/lib/machine-test script.py HAL.HALUI=halui "HALUI.MDI_COMMAND=G0 X1
MDI_COMMAND=G1 X1 F0
MDI_COMMAND=G0 X9 $(printf '%0254d' 9)"
