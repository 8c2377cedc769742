#!/bin/bash
exec "$EMC2_HOME/objects/test/nml-test" tcp-carries-every-message
