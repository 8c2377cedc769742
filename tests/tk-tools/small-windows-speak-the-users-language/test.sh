#!/bin/bash
# What the operator must read at a tool change and in the tool table, in the languages there are; a language without a catalogue reads English.
for language in C de fr xx; do
    LANGUAGE=$language LANG=C.UTF-8 PYTHONPATH="$TEST_DIR/../../../lib/python" /usr/bin/python3 -B - <<'PY'
from kerf.language import _
from kerf.tktools.hal_manualtoolchange import request_text
print(request_text(0), "|", request_text(7).splitlines()[0], "|", _("Save the changes to %s?") % "tool.tbl")
PY
done
