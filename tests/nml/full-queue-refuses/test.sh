#!/bin/bash
exec "$EMC2_HOME/objects/test/nml-test" full-queue-refuses
