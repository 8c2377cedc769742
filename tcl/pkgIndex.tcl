# SPDX-License-Identifier: GPL-2.0-or-later
package ifneeded Hal 1.0 [list load [file join $dir hal.so] Hal]
package ifneeded Linuxcnc 1.0 [list source [file join $dir linuxcnc.tcl]]
# Tabs of AXIS: the commands are made by lib/python/kerf/tktools/ngcgui_tabs.py.
package ifneeded Ngcgui 1.0 {::ngcgui::embed; package provide Ngcgui 1.0}
package ifneeded Ngcguittt 1.0 {::ngcgui::embed_text; package provide Ngcguittt 1.0}
