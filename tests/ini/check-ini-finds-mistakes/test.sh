#!/bin/bash
# One mistake of each kind; the checker names section, variable and reason.
base='[KINS]
KINEMATICS = trivkins coordinates=XY
JOINTS = 2
[TRAJ]
LINEAR_UNITS = mm
ANGULAR_UNITS = deg
COORDINATES = X Y
[AXIS_X]
MIN_LIMIT = -10
MAX_LIMIT = 10
MAX_VELOCITY = 5
MAX_ACCELERATION = 50
[JOINT_0]
MIN_LIMIT = -10
MAX_LIMIT = 10
MAX_VELOCITY = 5
MAX_ACCELERATION = 50
[JOINT_1]
MIN_LIMIT = -10
MAX_LIMIT = 10
MAX_VELOCITY = 5
MAX_ACCELERATION = 50
'
check() { # sed expression
    echo "# $1"
    printf '%s' "$base" | sed "$1" > bad.ini
    linuxcnc_check_ini bad.ini 2>&1
    echo "=> $?"
}
check ''
check '/KINEMATICS/d'
check 's/KINEMATICS.*/KINEMATICS =/'
check '/JOINTS/d'
check 's/JOINTS = 2/JOINTS = 17/'
check 's/JOINTS = 2/JOINTS = two/'
check 's/LINEAR_UNITS = mm/LINEAR_UNITS = furlong/'
check '/ANGULAR_UNITS/d'
check 's/coordinates=XY/coordinates=XQ/'
check 's/coordinates=XY/coordinates/'
check '/JOINT_0/,/MAX_LIMIT/s/-10/-9/'
check '/JOINT_0/,/MAX_VEL/s/= 10/= 9/'
check 's/^COORDINATES.*/COORDINATES = Y X/'
check '$a MAX_VELOCITY = 6'
check '$a TYPE = ROUND'
check '$a HOME_IS_SHARED = maybe'
check '$a COMP_FILE_TYPE = 2'
check '$a [EMCMOT]\nEMCMOT = motmod num_extrajoints=1'
rm -f bad.ini
linuxcnc_check_ini missing.ini 2>&1; echo "=> $?"
linuxcnc_check_ini 2>&1; echo "=> $?"
