#!/bin/bash
exec "$EMC2_HOME/objects/test/nml-test" many-clients-lose-nothing
