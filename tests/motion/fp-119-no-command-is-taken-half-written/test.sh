#!/bin/bash
# Two writers, killed now and then, and one reader; `motion-handover 10000000` runs as many as the
# field problem asks for.
exec "$EMC2_HOME/objects/test/motion-handover" 100000
