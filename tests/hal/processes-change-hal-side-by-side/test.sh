#!/bin/bash
# Six processes create, link, alias and delete at once; nothing is lost or left.
exec "$EMC2_HOME/objects/test/hal-robust" together 6 100000 5
