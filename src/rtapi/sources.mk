# SPDX-License-Identifier: GPL-2.0-or-later
# Sources of RTAPI for ordinary processes: part of liblinuxcnchal.so.0, which
# src/hal/rules.mk builds. Included by both rules.mk.
RTAPI_ULAPI_SOURCES := $(addprefix src/rtapi/,kerf_instance.c kerf_paths.c kerf_clock.c kerf_vclock.c \
    rtapi_common.c rtapi_shmem.c ulapi.c)
