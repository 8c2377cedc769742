#!/bin/bash
export PYTHONPATH=$PWD/../../lib:$PWD/../../linuxcncrsh/lib:$PYTHONPATH
exec ../lib/machine-test script.py HAL.HALUI=halui
