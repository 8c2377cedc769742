#!/bin/bash
exec "$EMC2_HOME/objects/test/nml-test" error-queue-holds-25
