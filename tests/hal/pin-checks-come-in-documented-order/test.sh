#!/bin/bash
# Each check of pin creation, legacy and typed, in the documented order.
exec "$EMC2_HOME/objects/test/hal-api" pins
