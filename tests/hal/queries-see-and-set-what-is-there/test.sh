#!/bin/bash
# The query interface: look-ups, lists, values, callbacks that change things.
exec "$EMC2_HOME/objects/test/hal-api" queries
