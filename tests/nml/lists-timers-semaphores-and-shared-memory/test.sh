#!/bin/bash
exec env KERF_CLOCK=virtual "$EMC2_HOME/objects/test/nml-classes-test"
