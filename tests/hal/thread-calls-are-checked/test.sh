#!/bin/bash
# Calls about functions and threads from an ordinary process.
exec "$EMC2_HOME/objects/test/hal-api" threads
