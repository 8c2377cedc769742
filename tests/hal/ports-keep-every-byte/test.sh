#!/bin/bash
# Byte queues, among them the write that fills one completely.
exec "$EMC2_HOME/objects/test/hal-api" ports
