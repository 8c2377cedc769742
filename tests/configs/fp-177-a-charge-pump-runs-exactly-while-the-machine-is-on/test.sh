#!/bin/bash
# FP-177: the safety wiring of the stepper machine: the charge pump runs exactly while the chain is closed and
# the machine is on; a pressed emergency stop, the operator's and a fault each end it.
exec ../../task/lib/machine-test pump.py -machine stepper
