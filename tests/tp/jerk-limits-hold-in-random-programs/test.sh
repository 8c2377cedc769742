#!/bin/bash
# Random machines with limits of jerk, programs and events; an independent checker differentiates
# every position, and every program must reach its end.
exec "$EMC2_HOME"/objects/test/tp-property -j -n 25
