#!/bin/bash
exec ../../task/lib/machine-test script.py HAL.HALUI=halui "HALUI.MDI_COMMAND=G0 Y5"
