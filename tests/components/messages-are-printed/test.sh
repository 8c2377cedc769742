#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# message and pushmsg print once at each edge; information is below the level that is shown.
# Then what pushmsg and message say about wrong texts.
set -u
KERF_CLOCK=virtual halrun -f messages.hal 2>&1 | grep -v '^Note'
load() {
    echo "loadrt $*" | KERF_CLOCK=virtual halrun 2>&1 | grep -v '^Note\|stdin\|HAL:'
}
long=$(printf '%0130d' 0)
load pushmsg
for bad in "e|$long" 'e|a' 'x|a|text' 'ea|b' 'e|ab' 'e|a b|text' 'e|a|t {f:y' 'e|a|t {f}' 'e|a|t {fxy}' 'e|a|t {f:b c}' \
        'e|a|t {x:y}' 'e|a|b","e|a|c'; do
    load "pushmsg msgs=\"$bad\""
done
load message names=a,b messages=one
