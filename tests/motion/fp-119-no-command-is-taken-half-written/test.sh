#!/bin/bash
# Two writers, killed now and then, and one reader; `make bench-handover` hands over ten million, as many as the
# field problem asks for.
exec "$EMC2_HOME/objects/test/motion-handover" 100000
