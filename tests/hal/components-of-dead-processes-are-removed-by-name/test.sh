#!/bin/bash
# A killed component is named, removed, and its signal keeps the value.
exec "$EMC2_HOME/objects/test/hal-robust" reap
