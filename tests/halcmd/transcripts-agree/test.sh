#!/bin/bash
# Recorded sessions (scripts/NAME.hal) print what was recorded (scripts/NAME.out): standard
# output, standard error and exit status. Made with LinuxCNC 2.10; they change only when the
# reference does.
exec ./compare scripts
