# SPDX-License-Identifier: GPL-2.0-or-later
"""The HAL oscilloscope. settings: what the user chose; configfile, csvlog: its files; acquire:
records from scope_rt; geometry: from values to pixels; screen, picker, dialogs: what is seen."""
