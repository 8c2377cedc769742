#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
exec ../../task/lib/machine-test script.py -file _panelui.ini -hal "loadrt streamer depth=100 cfg=u" \
    -hal "loadrt sampler depth=1000 cfg=u" -hal "net code streamer.0.pin.0 sampler.0.pin.0" \
    -hal "addf streamer.0 servo-thread" -hal "addf sampler.0 servo-thread"
