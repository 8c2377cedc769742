#!/bin/bash
exec ../../task/lib/machine-test script.py HAL.HALUI=halui "HALUI.MDI_COMMAND=G0 X1
MDI_COMMAND=G1 F600 X0 Y0
MDI_COMMAND=G1 X1 F0
MDI_COMMAND=G4 P5"
