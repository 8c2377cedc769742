#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
set -u
modules=$(dirname "$(command -v halcompile)")/../rtlib
trap 'for c in logic counted one; do rm -f "$modules/kerf_test_$c.so"; done; realtime stop' EXIT
for c in logic counted one; do halcompile --install kerf_test_$c.comp > /dev/null || exit 1; done

# try WORDS...: what loadrt WORDS makes, or why it does not.
try() {
    echo "-- $*"
    realtime start > /dev/null 2>&1
    if halcmd loadrt "$@" 2> /dev/null; then
        halcmd list pin | tr ' ' '\n' | grep -v '\.time$'
        halcmd list param | tr ' ' '\n' | grep -v 'tmax'
        halcmd list funct | tr ' ' '\n'
    else
        echo "refused"
    fi
    realtime stop > /dev/null 2>&1
}
try kerf_test_logic
try kerf_test_logic count=1 personality=0x102
try kerf_test_logic names=first,second personality=2,0x103
try kerf_test_logic count=1 names=a
try kerf_test_logic personality=5
try kerf_test_logic count=-1
try kerf_test_logic names=a_name_of_fifty_six_characters_that_is_longer_than_allow
try kerf_test_counted
try kerf_test_counted names=a,b
try kerf_test_counted names=a
try kerf_test_counted count=2
try kerf_test_one
