#!/bin/bash
# Every text of a window can be translated and is, in each language; what the operator must read at a tool change and in the tool table, in the languages there are; a language without a catalogue reads English.
for language in C de fr xx; do
    LANGUAGE=$language LANG=C.UTF-8 PYTHONPATH="$TEST_DIR/../../../lib/python" /usr/bin/python3 -B - <<'PY'
from kerf.language import _
from kerf.tktools.hal_manualtoolchange import request_text
print(request_text(0), "|", request_text(7).splitlines()[0], "|", _("Save the changes to %s?") % "tool.tbl")
PY
done
strings=$TEST_DIR/../../../scripts/message-strings
"$strings" --check "$TEST_DIR"/../../../src/po/*.po && "$strings" --unmarked && echo "all texts are marked and translated"
cat > window.py <<'PY'
TITLE = "Some Window"
def make(root, count):
    root.title(TITLE)
    ttk.Label(root, text=_("Marked"))
    ttk.Label(root, text="Forgotten")
    ttk.Label(root, text=f"{count} tools" if count else "OK")
    for text, action in ((N_("Run"), 1), ("Walk", 2)):
        ttk.Button(root, text=_(text), command=action)
PY
"$strings" --unmarked window.py
printf 'wm title $w "AXIS on $machine"\nlabel $f.a -text [_ "Marked"]\nlabel $f.b -text "Forgotten $n"\nbutton $f.c -text + -command go\n' > window.tcl
"$strings" --unmarked window.tcl
printf 'msgid "Cancel"\nmsgstr "Abbrechen"\n\nmsgid "Gone"\nmsgstr "Weg"\n\nmsgid "Saved %%s"\nmsgstr "Gespeichert"\n' > part.po
"$strings" --check part.po | grep -E "'(Cancel|Gone|Quit|Saved %s)'"
rm window.py window.tcl part.po
