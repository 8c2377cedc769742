#!/bin/bash
"$EMC2_HOME/objects/test/nml-test" configuration-lines | sed "s/port [0-9]*/port N/"
