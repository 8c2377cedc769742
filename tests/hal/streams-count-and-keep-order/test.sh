#!/bin/bash
# Streams: type strings, overruns, sample numbers.
exec "$EMC2_HOME/objects/test/hal-api" streams
