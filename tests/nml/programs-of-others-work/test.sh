#!/bin/bash
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for program in operate ownbuffers; do
    g++ -Wall -Wextra -Wno-cast-function-type -Werror -I"$EMC2_HOME/include" -o "$scratch/$program" programs/$program.cc -L"$EMC2_HOME/lib" -llinuxcnc -lnml -llinuxcnchal -Wl,-rpath,"$EMC2_HOME/lib" || exit 1
done
(
    cd "$scratch"
    echo "anna correct-horse" > logins
    chmod 600 logins
    cat > own.nml <<- EOF
	B robotCmd SHMEM localhost 4096 0 0 1 8 2001 TCP=5099 xdr queue confirm_write serial passwd=logins
	B robotSts SHMEM localhost 16384 0 0 2 8 2002 TCP=5099 xdr passwd=logins
	B gripper SHMEM localhost 4096 0 0 3 8 2003 TCP=5099 xdr queue confirm_write serial passwd=logins
	P server default LOCAL localhost RW 1 1.0 1 0
	P robot default LOCAL localhost RW 0 1.0 0 1
	P operator default REMOTE localhost RW 0 10.0 0 2
	EOF
    sed 's/ passwd=logins//' own.nml > far.nml
    ./ownbuffers | sed 's/127.0.0.1:[0-9]*/127.0.0.1/'
)
export BUILT=$scratch KERF_CLOCK=virtual:4
exec ../../task/lib/machine-test script.py HAL.HALUI=halui
