#!/bin/bash
# The picker finds configurations in the documented order, copies samples to the user's folder with
# their programs' prefix changed, remembers the choice, and its window returns what was clicked.
rm -rf work; mkdir -p work/home work/samples/{sim,by_interface,zoo,common,sim/axis/sub} ; trap 'cd "$TEST_DIR"; rm -rf work' EXIT
cd work
ini='[DISPLAY]\nPROGRAM_PREFIX = ../../nc_files\nDISPLAY = axis\n[EMC]\nVERSION = 1.1\n'
printf "$ini" > samples/sim/axis/axis.ini; echo "A mill." > samples/sim/axis/axis.txt; echo tool > samples/sim/axis/sim.tbl
printf "$ini" > samples/sim/axis/_panelui.ini; printf "$ini" > samples/sim/axis/sub/other.ini; printf "$ini" > samples/zoo/z.ini
printf "$ini" > samples/by_interface/card.ini; echo "All cards." > samples/by_interface/README; printf "$ini" > samples/common/no.ini
echo x > samples/sim/axis/maintainer.txt; ln -s ../../nc_files samples/sim/axis/nc_files; mkdir samples/sim/axis/data; echo d > samples/sim/axis/data/d.txt
printf '#!/bin/sh\n' > samples/zoo/show.demo; mkdir empty
export HOME=$PWD/home
/usr/bin/python3 - <<'END'
import os, dataclasses
from pathlib import Path
from kerf import configs
from kerf.tree import Tree
tree = dataclasses.replace(Tree.find(), configs=Path("samples").resolve(), in_place=False)
aux = Path("empty").resolve()
roots = configs.search_path(tree, {"LINUXCNC_AUX_CONFIGS": str(aux)})
print([configs.title(r, tree) if r != aux else "aux" for r in roots if r in (aux, tree.configs)])
def show(nodes, depth=0):
    for n in nodes:
        print("  " * depth + n.name + ("" if n.is_file else "/"))
        show(n.children, depth + 1)
show(configs.scan(tree.configs, samples=True))
axis = tree.configs / "sim/axis/axis.ini"
print(configs.details(axis), configs.details(tree.configs / "zoo/z.ini")[0], configs.details(tree.configs / "by_interface/card.ini")[0].strip())
print("demo usable", configs.usable(tree.configs / "zoo/show.demo"), "copy", configs.needs_copy(axis, tree, {}))
for _ in range(2):
    new = configs.copy(axis, tree, roots)
    print(new.relative_to(Path.home()))
print(sorted(str(p.relative_to(new.parent)) for p in new.parent.rglob("*") if "hallib/" not in str(p)))
print(new.read_text().splitlines()[1].replace(str(Path.home()), "HOME"))
print(sorted(p.name for p in (Path.home() / "linuxcnc/nc_files").iterdir() if not p.name.endswith("_lib")), (new.parent / "hallib").resolve() == tree.hallib)
print("copy of a copy:", configs.needs_copy(new, tree, {}))
(Path.home() / ".linuxcncrc").write_text("[PICKCONFIG]\nLAST_CONFIG = old\n[OTHER]\nX = 1\n")
configs.remember(new)
print((Path.home() / ".linuxcncrc").read_text().replace(str(Path.home()), "HOME"), end="")
(Path.home() / "linuxcnc/nc_files").rename("away"); (Path.home() / "linuxcnc/nc_files").touch()
before = sorted(configs.user_configs().iterdir())
try:
    configs.copy(axis, tree, roots)
except OSError as e:
    print("not copied:", e.strerror, sorted(configs.user_configs().iterdir()) == before)
(Path.home() / "linuxcnc/nc_files").unlink(); Path("away").rename(Path.home() / "linuxcnc/nc_files")
END
DISPLAY=:7777 linuxcnc 2>&1; echo "no display: $?"
echo "# programs"
linuxcncmkdesktop /x/mill.ini "My Mill" "at the window" | sed "s|Exec=.*/linuxcnc |Exec=BIN/linuxcnc |"
linuxcncmkdesktop /x/a.demo Demo; linuxcncmkdesktop /x/a.txt Text; linuxcncmkdesktop 2>&1; echo "=> $?"
report=$(linuxcnc_info -s); grep -c -E '^ +(date|release|LINUXCNCVERSION|RTS): .' "${report#linuxcnc_info: }"
echo "# window"
../../../lib/with-display /usr/bin/python3 - <<'END'
import dataclasses, tkinter as tk
from pathlib import Path
from unittest import mock
from kerf import configs, pickconfig
from kerf.tree import Tree
tree = dataclasses.replace(Tree.find(), configs=Path("samples").resolve(), in_place=False)
def run(script, answer=True):
    root = tk.Tk()
    with mock.patch.object(pickconfig.messagebox, "askyesno", return_value=answer), \
            mock.patch.object(pickconfig.messagebox, "showinfo"):
        picker = pickconfig.Picker(root, tree)
        root.after(50, lambda: script(picker))
        root.mainloop()
    return picker.chosen
def key(name):
    def script(p):
        p.root.update()
        p.list.focus_force()
        p.list.event_generate(name)
    return script
print("at start", run(key("<Return>"), answer=False) == tree.configs / "sim/axis/axis.ini")
print("copied", run(key("<Return>")).relative_to(Path.home()))
print("cancelled", run(key("<Escape>")))
def folder(p):
    p.select(tree.configs / "zoo")
    p.root.update()
    print("OK on a folder:", p.ok["state"])
    p.accept()
    p.root.destroy()
print("folder", run(folder))
(Path.home() / ".linuxcncrc").unlink(); (Path.home() / ".linuxcncrc").mkdir()
print("not remembered, but started", run(key("<Return>"), answer=False) is not None)
END
