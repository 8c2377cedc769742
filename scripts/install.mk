# SPDX-License-Identifier: GPL-2.0-or-later
# `make install DESTDIR=...`: the layout of an installed system (prefix /usr by default).
# Programs find each other from their own place, so the tree may be moved.
PY_SITE    := $(prefix)/lib/python3/dist-packages
SHARE      := $(prefix)/share/linuxcnc
DOC        := $(prefix)/share/doc/linuxcnc
INST       := install -m 644
INST_EXE   := install -m 755
# Programs in scripts/ that an installed system has too.
USER_SCRIPTS := linuxcnc axis linuxcnc_check_ini linuxcnc_var linuxcnc_info linuxcncmkdesktop kerf-run runtests \
                halrun halcmd_twopass haltcl halreport hal-histogram latency-test latency-histogram latency-plot update_ini
copy_tree = mkdir -p $(DESTDIR)$(2) && cp -rP $(1)/. $(DESTDIR)$(2)/ && find $(DESTDIR)$(2) -name __pycache__ -prune -exec rm -rf {} +

# Modules that users copy and change.
TEMPLATES := src/emc/motion/homecomp.comp src/emc/tp/tpcomp.comp src/emc/kinematics/userkins.comp src/emc/kinematics/userkfuncs.c

install: all $(INSTALL_HOOKS)
	mkdir -p $(DESTDIR)$(prefix)/bin $(DESTDIR)$(prefix)/lib/linuxcnc $(DESTDIR)$(moduledir) $(DESTDIR)$(PY_SITE) \
	    $(DESTDIR)$(prefix)/include/linuxcnc $(DESTDIR)$(SHARE) $(DESTDIR)$(DOC)/examples $(DESTDIR)$(sysconfdir)/linuxcnc $(DESTDIR)$(tcldir)
	$(INST_EXE) $(PROGRAMS) $(SCRIPTS) $(DESTDIR)$(prefix)/bin
	for s in $(USER_SCRIPTS); do [ ! -f scripts/$$s ] || $(INST_EXE) scripts/$$s $(DESTDIR)$(prefix)/bin; done
	for l in $(LIBRARY_FILES); do $(INST) $$l $(DESTDIR)$(prefix)/lib; n=$${l##*/}; ln -sf $$n $(DESTDIR)$(prefix)/lib/$${n%%.so*}.so; done
	$(INST) $(INTERPRETERS) $(DESTDIR)$(prefix)/lib/linuxcnc
	$(INST) $(ARCHIVES) $(DESTDIR)$(prefix)/lib
	$(INST) $(RTMODULES) $(DESTDIR)$(moduledir)
	$(INST_EXE) scripts/realtime $(DESTDIR)$(prefix)/lib/linuxcnc/realtime
	$(INST) scripts/rtapi.conf $(DESTDIR)$(sysconfdir)/linuxcnc/rtapi.conf
	$(INST) $(PYMODULES) $(DESTDIR)$(PY_SITE)
	mkdir -p $(DESTDIR)$(prefix)/lib/linuxcnc/python && ln -sfn $(PYTHON) $(DESTDIR)$(prefix)/lib/linuxcnc/python/python3
	for f in lib/python/*; do case $$f in *.so|*__pycache__) ;; *) cp -r $$f $(DESTDIR)$(PY_SITE)/;; esac; done
	find $(DESTDIR)$(PY_SITE) -name __pycache__ -prune -exec rm -rf {} +
	$(INST) $(PUBLIC) $(DESTDIR)$(prefix)/include/linuxcnc
	$(INST) configs/common/*.nml $(DESTDIR)$(SHARE)
	$(call copy_tree,lib/hallib,$(SHARE)/hallib)
	$(call copy_tree,share/images,$(SHARE)/images)
	install -D -m 644 lib/python/kerf/mtconnect/mtconnect-linuxcnc-1.xsd $(DESTDIR)$(SHARE)/mtconnect/mtconnect-linuxcnc-1.xsd
	$(call copy_tree,nc_files,$(SHARE)/ncfiles)
	$(call copy_tree,configs,$(DOC)/examples/sample-configs)
	$(call copy_tree,tcl,$(tcldir))
	$(INST) src/config.h $(DESTDIR)$(SHARE)
	$(INST) src/Makefile.modinc src/switchkins.mk $(DESTDIR)$(SHARE)
	mkdir -p $(DESTDIR)$(prefix)/lib/linuxcnc/switchkins && $(INST) $(SWITCHKINS_PARTS) $(DESTDIR)$(prefix)/lib/linuxcnc/switchkins
	mkdir -p $(DESTDIR)$(DOC)/examples/templates
	$(INST) $(TEMPLATES) $(DESTDIR)$(DOC)/examples/templates
	ln -sfn ../../../linuxcnc/ncfiles $(DESTDIR)$(DOC)/examples/nc_files
