#!/bin/bash
# In each encoding; raw carries the local fields too.
for coding in xdr disp force_raw; do
    echo "$coding"
    sed "s/ xdr/ $coding/" "$EMC2_HOME/configs/common/linuxcnc.nml" > coded.nml
    "$EMC2_HOME/objects/test/nml-test" tcp-carries-every-message coded.nml
done
rm coded.nml
