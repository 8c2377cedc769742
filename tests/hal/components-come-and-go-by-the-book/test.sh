#!/bin/bash
# Making, readying and removing components, with every refusal and its message.
"$EMC2_HOME/objects/test/hal-api" life | sed "s/pid=[0-9]*/pid=P/"
