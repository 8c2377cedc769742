# SPDX-License-Identifier: GPL-2.0-or-later
# Scripts around HAL.
$(foreach s,halrun haltcl halcmd_twopass halreport hal-histogram pid-tune latency-test latency-histogram latency-plot,$(eval $(call script,$(s),src/hal/utils/scripts/$(s))))
