#!/bin/bash
# Every path and every code symbol that docs/architecture.md names must exist.
cd ../../.. || exit 1
/usr/bin/python3 - <<'END'
import re, subprocess, pathlib
text = pathlib.Path("docs/architecture.md").read_text()
names = set(re.findall(r"`([^`\s]+)`", text))
for name in sorted(names):
    if re.match(r"(src|lib|docs|tests|scripts|configs)/", name):
        if not pathlib.Path(name).exists():
            print("no such file:", name)
    elif re.fullmatch(r"[A-Za-z_]\w*(::\w+)*", name) and (any(c.isupper() for c in name) or "_" in name) \
            and not name.isupper():
        word = name.split("::")[-1]
        if subprocess.run(["grep", "-rqsw", word, "src", "scripts", "lib/python"]).returncode:
            print("no such symbol:", name)
print("checked", len(names) > 40)
END
