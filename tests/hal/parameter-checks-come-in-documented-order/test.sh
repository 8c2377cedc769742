#!/bin/bash
# Each check of parameter creation and of hal_param_set.
exec "$EMC2_HOME/objects/test/hal-api" params
