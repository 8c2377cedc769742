#!/bin/bash
exec ../../task/lib/machine-test script.py HAL.HALUI=halui -file pendant.py -hal "loadusr -Wn pendant ./pendant.py" \
    -hal "net button pendant.button halui.axis.x.plus" -hal "net stick pendant.stick halui.axis.y.analog" \
    -hal "net lamp pendant.lamp"
