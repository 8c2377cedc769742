#!/bin/bash
sed '/emcCommand.*SHMEM/s/$/ diag/' "$EMC2_HOME/configs/common/linuxcnc.nml" > diag.nml
"$EMC2_HOME/objects/test/nml-test" messages-as-text-and-connections diag.nml
rm diag.nml
