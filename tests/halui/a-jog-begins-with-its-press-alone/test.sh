#!/bin/bash
exec ../../task/lib/machine-test script.py HAL.HALUI=halui
