#!/bin/bash
# Who may share a signal, and which value wins at link and unlink.
exec "$EMC2_HOME/objects/test/hal-api" signals
