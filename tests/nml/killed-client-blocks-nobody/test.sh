#!/bin/bash
exec "$EMC2_HOME/objects/test/nml-test" killed-client-blocks-nobody
