#!/bin/bash
# Four processes change HAL and are killed at random moments.
exec "$EMC2_HOME/objects/test/hal-robust" kills 400 7
