#!/bin/bash
# Named promises of the planner's interface to motmod: timing, ids, outputs, waits, spindles.
exec "$EMC2_HOME"/objects/test/tp-api
