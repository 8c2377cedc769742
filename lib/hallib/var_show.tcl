# SPDX-License-Identifier: GPL-2.0-or-later
# var_show.tcl - a [HAL]HALFILE that prints context, environment and INI settings: for finding out
# what a haltcl file can use. It changes nothing.

source [file join $::env(HALLIB_DIR) util_lib.tcl]
show_context
show_env
show_ini
