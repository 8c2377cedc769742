#!/bin/bash
# As it comes, with other settings, and with a word that is none.
run() { ../lib/machine-test script.py "$@"; }
echo "== as it comes"; run
echo "== set"; run TRAJ.PROBE_CONTACT_RAPID=warn TRAJ.PROBE_CONTACT_FEED=IGNORE
echo "== set the other way round, filtered"; run TRAJ.PROBE_CONTACT_RAPID=IGNORE TRAJ.PROBE_CONTACT_FEED=STOP TRAJ.PROBE_CONTACT_FILTER=0.05
echo "== a mistake"; run TRAJ.PROBE_CONTACT_FEED=SOMETIMES | grep -E "must be|did not start"
