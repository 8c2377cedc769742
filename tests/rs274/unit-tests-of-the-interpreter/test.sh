#!/bin/bash
# Through the public interface, then stage by stage.
../../../objects/test/interp-unit && exec ../../../objects/test/interp-stages
