# SPDX-License-Identifier: GPL-2.0-or-later
"""What others show inside the screen: PyVCP and GladeVCP panels, embedded tabs; files loaded behind the screen.

A PyVCP panel is made by the module vcpparse: `vcpparse.filename = FILE; vcpparse.create_vcp(frame, component)`.
"""

import os
import shlex
import subprocess
import sys
import tkinter as tk

import hal
import hal.query
from kerf import clock
from kerf.tkscroll import Scrolled

CHILD_POLL_MS = 100
LOADUSR = "halcmd loadusr"


class PanelsPart:
    """Part of App: panels, tabs, child processes."""

    def view(self, master, **options):
        """A frame for a panel, which scrolls where the screen has no room for it."""
        self.views.append(Scrolled(master, **options))
        return self.views[-1]

    # -- PyVCP -----------------------------------------------------------------------------

    def beside_ini(self, path):
        """A file of the INI: as it is, or beside the INI file."""
        path = os.path.expanduser(path)
        beside = os.path.join(os.path.dirname(os.path.abspath(self.settings.ini_path)), path)
        return beside if not os.path.exists(path) and os.path.exists(beside) else path

    def pyvcp(self, frame, path, name):
        """Fills a frame with a panel; its component. What is wrong is told and the frame stays empty: None."""
        component = None
        try:
            import vcpparse
            component = hal.component(name)
            vcpparse.filename = self.beside_ini(path)
            vcpparse.numbers = self.kept_numbers()
            vcpparse.create_vcp(frame, component)
            return component
        except (Exception, SystemExit) as e:
            if component is not None:
                component.exit()
            text = f"PyVCP panel {path}: {e or type(e).__name__}"
            print(f"axis: {text}", file=sys.stderr)
            self.notifications.add("error", text)
            return None

    def make_panel(self):
        """[DISPLAY]PYVCP: at the right, or in the bottom row."""
        path = self.settings.find("DISPLAY", "PYVCP")
        if not path or self.comp is None:
            return
        self.panel = self.view(self.root, name="pyvcp")
        self.panel_at_bottom = self.settings.find("DISPLAY", "PYVCP_POSITION") == "BOTTOM"
        component = self.pyvcp(self.panel.inner, path, "pyvcp")
        if component is None:
            self.panel.destroy()
            self.panel = None
            return
        component.ready()
        self.panel_component = component
        self.show_panel()

    def show_panel(self):
        if self.panel is None:
            return
        if not self.vars.show_pyvcppanel.get():
            self.panel.grid_remove()
        elif self.panel_at_bottom:
            self.panel.grid(row=4, column=0, columnspan=6, sticky="nsew")
        else:
            self.panel.grid(row=0, column=4, rowspan=6, sticky="nsew")

    def toggle_panel(self):
        self.vars.show_pyvcppanel.set(not self.vars.show_pyvcppanel.get())
        self.show_panel()

    # -- GladeVCP and tabs -----------------------------------------------------------------

    def container(self, view):
        """A frame in a view that another program shows its window in; the X window id."""
        frame = tk.Frame(view.inner, container=True, background="")
        frame.pack(fill="both", expand=True)
        self.root.update_idletasks()
        return frame.winfo_id()

    def start_child(self, words, line):
        try:
            self.children.append((subprocess.Popen(words), line))
        except OSError as e:
            text = f"{line}: {e.strerror}"
            print(f"axis: {text}", file=sys.stderr)
            self.notifications.add("error", text)

    def start_tabs(self):
        """[DISPLAY]EMBED_TAB_NAME and EMBED_TAB_COMMAND, pair by pair."""
        names = self.ini.findall("DISPLAY", "EMBED_TAB_NAME") or []
        lines = self.ini.findall("DISPLAY", "EMBED_TAB_COMMAND") or []
        os.environ["AXIS_FORWARD_EVENTS_TO"] = str(self.root.winfo_id())
        if len(names) != len(lines):
            print("Invalid tab configuration")
            names = lines = []
        self.tab_components, self.tab_names = [], []
        for i, (name, line) in enumerate(zip(names, lines)):
            view = self.view(self.wrap(str(self.add_tab(f"user_{i}", name))))
            view.pack(fill="both", expand=True)
            words = line.split()
            if words[:1] == ["pyvcp"]:
                if self.comp is None:
                    print(f"axis: EMBED_TAB_COMMAND = {line}: no panels with AXIS_NO_HAL")
                elif len(words) == 2:
                    self.tab_names.append(name.lower().replace(" ", "_"))
                    self.tab_components.append(self.pyvcp(view.inner, words[1], self.tab_names[-1]))
                else:
                    print(f"axis: EMBED_TAB_COMMAND = {line}: a panel has one file and no options")
                continue
            try:
                words = shlex.split(line.replace("{XID}", str(self.container(view))))
            except ValueError as e:
                print(f"axis: EMBED_TAB_COMMAND = {line}: {e}")
                continue
            if words:
                self.start_child(words, line)
        self.start_gladevcp()

    def start_gladevcp(self):
        """[DISPLAY]GLADEVCP: a panel at the right, in a process of its own."""
        value = self.settings.find("DISPLAY", "GLADEVCP")
        if not value or self.comp is None:
            return
        words = shlex.split(value)
        name = "gladevcp"
        if "-c" in words[:-1]:
            at = words.index("-c")
            name = words[at + 1]
            del words[at:at + 2]
        view = self.view(self.root, name="gladevcp")
        view.grid(row=0, column=5, rowspan=6, sticky="nsew")
        xid = self.container(view)
        line = f"{LOADUSR} -Wn {name} gladevcp -c {name} -d -x {xid} " + " ".join(words)
        self.start_child(["halcmd", "loadusr", "-Wn", name, "gladevcp", "-c", name, "-d", "-x", str(xid), *words], line)

    def wait_for_children(self, then):
        """Calls `then` when every child that loads a component is done; a failure ends AXIS."""
        for child, line in self.children:
            if line.startswith(LOADUSR) and child.poll() is None:
                self.root.after(CHILD_POLL_MS, lambda: self.wait_for_children(then))
                return
        for child, line in self.children:
            if line.startswith(LOADUSR) and child.returncode:
                print(f"axis: '{line}' ended with {child.returncode}")
                self.exit_status = child.returncode
                self.root.destroy()
                return
        then()

    def postgui(self):
        """[HAL]POSTGUI_HALFILE and POSTGUI_HALCMD; a failure ends AXIS with its status."""
        ini = self.settings.ini_path
        lines = []
        if self.comp is not None:
            for entry in self.ini.findall("HAL", "POSTGUI_HALFILE") or []:
                name, *args = entry.split()
                name = os.path.expanduser(name)
                lines.append(["haltcl", "-i", ini, name, *args] if name.endswith(".tcl")
                             else ["halcmd", "-i", ini, "-f", name])
            lines += [["halcmd", *line.split()] for line in self.ini.findall("HAL", "POSTGUI_HALCMD") or []]
        before = set(hal.query.comps()) if lines else ()
        for words in lines:
            status = clock.run(words).returncode
            if status:
                print(f"axis: '{' '.join(words)}' ended with {status}", file=sys.stderr)
                self.exit_status = status
                self.root.destroy()
                return
        if lines:
            self.loaded = {name: comp["pid"]
                           for name, comp in hal.query.comps().items()
                           if name not in before and comp["type"] == hal.CompType.USER}
        self.show()

    def own_components(self):
        """Names of the components whose pins come and go with the screen."""
        loaded = [words[words.index("-Wn") + 1]
                  for words in (line.split() for _, line in self.children if line.startswith(LOADUSR))
                  if "-Wn" in words[:-1]]
        return {"axisui", "pyvcp", *self.tab_names, *loaded}

    def parts(self):
        """Ids of the processes that show something in the screen."""
        owners = [hal.query.comp(name) for name in self.own_components()] if self.comp is not None else []
        pids = ({child.pid for child, _ in self.children if child.poll() is None}
                | {owner["pid"] for owner in owners if owner})
        return sorted(pids - {os.getpid()})

    def look_at_children(self):
        """A program in a tab, or one that POSTGUI loaded, that ended is told once; the screen goes on."""
        for name, pid in list(self.loaded.items()):
            if not hal.component_exists(name):       # of the dead HAL takes the pins away, its bits fall
                del self.loaded[name]
                self.notifications.add("error",
                                       self.translate("%s (process %d) has ended: what it did is no longer done")
                                       % (name, pid))
        for i, (child, line) in enumerate(self.children):
            if child.poll() and i not in self.told_children and not line.startswith(LOADUSR):
                self.told_children.add(i)
                self.notifications.add("error",
                                       f"{line}: {self.translate('ended with status %d') % (child.returncode if child.returncode > 0 else 128 - child.returncode)}")

    def end_children(self):
        """Programs of tabs end with the screen; components that halcmd loaded do not."""
        for child, line in self.children:
            if "loadusr" not in line and child.poll() is None:
                child.terminate()
        for component in (getattr(self, "panel_component", None), *getattr(self, "tab_components", ())):
            if component is not None:
                component.exit()
