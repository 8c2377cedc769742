#!/bin/bash
# One session through all commands that say something: what -v adds on standard output, the errors on
# standard error, nothing else; the same without -v prints only values and errors.
session() {
    realtime start > /dev/null 2>&1 < /dev/null
    halcmd -k "$@" -f commands.hal > out 2> err < /dev/null
    echo "exit status $?"
    realtime stop > /dev/null 2>&1 < /dev/null
    echo "-- standard output"
    sed "s|$EMC2_HOME/bin/||g" out
    echo
    echo "-- standard error"
    sed "s|$EMC2_HOME/bin/||g" err
    mv err "err$1"
}
session -v
session | sed '/-- standard error/,$d'
grep -v 'already linked' err-v | cmp - err && echo "the same errors"
rm -f out err err-v
