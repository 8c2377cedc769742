# SPDX-License-Identifier: GPL-2.0-or-later
include src/rtapi/sources.mk

PUBLIC_HEADERS += $(addprefix src/rtapi/,rtapi.h rtapi_app.h rtapi_atomic.h rtapi_bitops.h \
    rtapi_bool.h rtapi_byteorder.h rtapi_ctype.h rtapi_device.h rtapi_errno.h rtapi_firmware.h \
    rtapi_gfp.h rtapi_io.h rtapi_limits.h rtapi_list.h rtapi_math.h rtapi_math_i386.h \
    rtapi_math64.h rtapi_mutex.h rtapi_parport.h rtapi_pci.h rtapi_slab.h rtapi_stdint.h \
    rtapi_string.h rtapi_vsnprintf.h kerf_clock.h kerf_instance.h kerf_paths.h)
