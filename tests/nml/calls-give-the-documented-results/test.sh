#!/bin/bash
"$EMC2_HOME/objects/test/nml-test" calls-give-the-documented-results | sed "s/port [0-9]*/port N/"
