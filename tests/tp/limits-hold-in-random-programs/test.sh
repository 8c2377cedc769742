#!/bin/bash
# Random machines, programs and events; an independent checker differentiates every position.
exec "$EMC2_HOME"/objects/test/tp-property -n 40
