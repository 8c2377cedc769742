#!/bin/bash
# halcmd -R: a stopped process that holds the lock is passed over.
exec "$EMC2_HOME/objects/test/hal-robust" hang
