# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += src/hal/hal.h

include src/rtapi/sources.mk
HAL_SOURCES := $(addprefix src/hal/,hal_segment.c hal_index.c hal_recover.c hal_comp.c hal_pin.c \
    hal_signal.c hal_thread.c hal_port.c hal_stream.c)

$(eval $(call library,linuxcnchal,0,$(HAL_SOURCES) src/hal/hal_query.c $(RTAPI_ULAPI_SOURCES),-lpthread))
$(eval $(call rtmodule,hal_lib,$(HAL_SOURCES) src/hal/hal_lib.c))
$(eval $(call rtmodule,threads,src/hal/threads.c))

$(eval $(call rtmodule,sampler,src/hal/stream/sampler.c))
$(eval $(call rtmodule,streamer,src/hal/stream/streamer.c))
HALSTREAM_MAIN := src/hal/stream/halstream_main.c
$(eval $(call program,halsampler,src/hal/stream/halsampler.c $(HALSTREAM_MAIN),linuxcnchal))
$(eval $(call program,halstreamer,src/hal/stream/halstreamer.c $(HALSTREAM_MAIN),linuxcnchal))

$(eval $(call pymodule,_hal,$(addprefix src/hal/python/,_hal.cc component.cc query.cc stream.cc values.cc),linuxcnchal))
