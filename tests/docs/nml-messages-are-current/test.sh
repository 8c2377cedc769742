#!/bin/bash
# docs/nml-messages.md is what the descriptions say.
"$EMC2_HOME/objects/test/nml-describe" docs | diff - "$EMC2_HOME/docs/nml-messages.md" && echo current
