#!/bin/bash
../../task/lib/machine-test script.py || exit
exec ../../task/lib/machine-test no-contact.py EMCMOT.SERVO_PERIOD=10000000
