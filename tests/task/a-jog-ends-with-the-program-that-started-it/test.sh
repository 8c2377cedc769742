#!/bin/bash
PYTHONPATH=$PWD/../../nml/lib:$PYTHONPATH exec ../lib/machine-test script.py HAL.HALUI=halui
