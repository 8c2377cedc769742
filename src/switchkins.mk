# SPDX-License-Identifier: GPL-2.0-or-later
# switchkins.mk: builds switchable kinematics with functions of the user, in the present folder and without
# the sources of the others. An installed system has it beside Makefile.modinc.
#
#     userkfuncs=FILE make -f .../switchkins.mk            all of them; FILE.c has the functions of type 2
#     MODULES="genhexkins mykins"     these only; mykins.c has a switchkinsSetup() (switchkins.h)
#     make -f .../switchkins.mk ... install                puts them where loadrt finds them
#
# FILE.c defines userkKinematicsSetup, userkKinematicsForward and userkKinematicsInverse (kinematics.h);
# the template userkfuncs.c, which makes type 2 the identity, is what comes without userkfuncs=.

SWITCHKINS_DIR := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
SWITCHKINS_PARTS := $(firstword $(wildcard $(SWITCHKINS_DIR)/../lib/switchkins $(SWITCHKINS_DIR)/../../lib/linuxcnc/switchkins))
SWITCHKINS_SHIPPED := $(filter-out frame userkfuncs,$(basename $(notdir $(wildcard $(SWITCHKINS_PARTS)/*.o))))
MODULES ?= $(SWITCHKINS_SHIPPED)
SWITCHKINS_USER := $(if $(userkfuncs),userkfuncs.user.o,$(SWITCHKINS_PARTS)/userkfuncs.o)

modules:
userkfuncs.user.o: $(userkfuncs)
	$(MODINC_Q)$(CC) $(MODINC_CFLAGS) $(EXTRA_CFLAGS) -c -o $@ $<

obj-m := $(addsuffix .o,$(MODULES))
$(foreach m,$(MODULES),$(eval $(m)-objs := \
    $(if $(filter $(m),$(SWITCHKINS_SHIPPED)),$(SWITCHKINS_PARTS)/)$(m).o $(SWITCHKINS_PARTS)/frame.o $(SWITCHKINS_USER)))
# Parts of C++ (matrices).
EXTRA_LDFLAGS += -Wl,--as-needed -l:libstdc++.so.6
include $(SWITCHKINS_DIR)/Makefile.modinc
