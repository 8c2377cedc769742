#!/bin/bash
exec ../../../objects/test/interp-unit
