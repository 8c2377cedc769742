#!/bin/bash
# Aliases replace the current name; the original one keeps working.
exec "$EMC2_HOME/objects/test/hal-api" aliases
