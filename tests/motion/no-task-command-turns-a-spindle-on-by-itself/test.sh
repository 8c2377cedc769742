#!/bin/bash
exec ../../task/lib/machine-test script.py TRAJ.SPINDLES=2 "EMCMOT.EMCMOT=motmod num_spindles=2"
