#!/bin/bash
exec ../lib/machine-test script.py -hal "!spindle.0.at-speed" 
