#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# bin/halconfig for callers of halconfig.tcl. For Tcl the next line is a part of this comment. \
exec wish8.6 "$0" "$@"
source [file join [file dirname [info script]] start.tcl]
