#!/bin/bash
# Values of 1 and 4 bytes agree with 64-bit readers after link and unlink.
exec "$EMC2_HOME/objects/test/hal-api" widths
