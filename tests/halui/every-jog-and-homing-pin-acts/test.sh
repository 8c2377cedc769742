#!/bin/bash
exec ../../task/lib/machine-test script.py HAL.HALUI=halui "HALUI.MDI_COMMAND=G0 X1
MDI_COMMAND=G0 X2 Y2
MDI_COMMAND=G1 F60 X0 Y0
MDI_COMMAND=G1 X1 F0"
