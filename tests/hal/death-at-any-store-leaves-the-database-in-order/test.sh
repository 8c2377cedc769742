#!/bin/bash
# A process dies before each single store of every changing call; others go on.
exec "$EMC2_HOME/objects/test/hal-robust" stores 1
