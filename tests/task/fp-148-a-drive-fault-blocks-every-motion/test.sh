#!/bin/bash
exec ../lib/machine-test script.py JOINT_1.HOME=30 JOINT_1.HOME_FINAL_VEL=20
