#!/bin/bash
# The documented public headers are there; each compiles alone, all together, in C for realtime and
# ordinary programs and in C++, without a warning, and the constants of linuxcnc.h are what they were.
scratch=$(mktemp -d)
inc=$EMC2_HOME/include
rt="rtapi.h rtapi_app.h rtapi_atomic.h rtapi_bitops.h rtapi_bool.h rtapi_byteorder.h rtapi_ctype.h rtapi_device.h rtapi_errno.h
    rtapi_firmware.h rtapi_gfp.h rtapi_io.h rtapi_limits.h rtapi_list.h rtapi_math.h rtapi_math64.h rtapi_mutex.h rtapi_parport.h
    rtapi_pci.h rtapi_slab.h rtapi_stdint.h rtapi_string.h rtapi_vsnprintf.h hal.h hostmot2-serial.h linuxcnc.h kinematics.h emcmotcfg.h emcpos.h
    emcpose.h motion_types.h posemath.h posemath_types.h"
ul="hal.h rtapi.h rtapi_stdint.h rtapi_math.h linuxcnc.h inifile.h emcpos.h emcpose.h posemath.h motion_types.h"
cxx="hal.h rtapi.h rtapi_atomic.h linuxcnc.h inifile.hh inifile.h posemath.hh posemath.h emcpos.h"
common="-Wall -Wextra -Werror -D_GNU_SOURCE -I$inc -fsyntax-only"
RTFLAGS="-std=gnu11 -DRTAPI -DUSPACE -Drealtime -DSIM -D__MODULE__ -fPIC"
try() { # title, compiler and flags..., header names on standard input
    local title=$1; shift
    local headers; headers=$(cat)
    for h in $headers; do
        [ -f "$inc/$h" ] || echo "$h is missing"
        echo "#include <$h>" > $scratch/one.c
        "$@" $scratch/one.c || echo "$title: $h does not compile alone"
    done
    for h in $headers; do echo "#include <$h>"; done > $scratch/all.c
    "$@" $scratch/all.c && echo "$title: together"
}
try realtime gcc $RTFLAGS $common <<< "$rt"
try user gcc -std=gnu11 -DULAPI $common <<< "$ul"
try C++ g++ -x c++ -std=c++20 -DULAPI $common <<< "$cxx"
cat > $scratch/use.c <<'C'
#include <linuxcnc.h>
#include <hal.h>
_Static_assert(LINELEN == 255 && BUFFERLEN == 80, "sizes");
_Static_assert(MM_PER_INCH == 25.4 && INCH_PER_MM == 1.0 / 25.4, "factors");
_Static_assert(HAL_NAME_LEN == 55 && RTAPI_NAME_LEN == 31 && HAL_STREAM_MAX_PINS == 21, "lengths");
_Static_assert(HAL_LOCK_TUNE == 3 && HAL_LOCK_ALL == 255 && HAL_TYPE_MAX == 8 && HAL_RW == 192 && HAL_IO == 48, "numbers");
C
gcc -std=gnu11 -DULAPI $common $scratch/use.c && echo "constants"
for api in "" "-DRTAPI -DULAPI"; do
    echo '#include <hal.h>' | gcc $api -I$inc -fsyntax-only -x c - 2>&1 | grep -q '#error' && echo "refused: ${api:-neither}"
done
# Every documented function, with its documented type, in the contexts that have it.
for api in RTAPI ULAPI; do
    { echo '#include <stdarg.h>'; echo '#include <signal.h>'; for h in ${rt/rtapi_app.h/}; do echo "#include <$h>"; done; cat signatures.h; } > $scratch/all.c
    gcc -std=gnu11 -D$api -DUSPACE -fPIC $common $scratch/all.c && echo "documented functions: $api"
done
# What a driver of something on a serial channel of a Mesa board is made of.
gcc $RTFLAGS $common uart-driver.c && echo "serial driver"
rm -rf $scratch
