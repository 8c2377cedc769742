# SPDX-License-Identifier: GPL-2.0-or-later
"""halshow: what is in HAL, watch lists, commands."""

import contextlib
import os
import re
import subprocess
import sys
import tempfile
import tkinter as tk
from pathlib import Path
from tkinter import filedialog, simpledialog, ttk

from .. import instance, tkstyle
from ..language import _, N_
from ..tree import Tree
from . import haltree, tclprefs, watch
from .watchview import WatchView
from .widgets import Scrolled

SIZE, MINIMUM = (700, 475), (230, 240)
LEFT_SHARE = 0.3
STRIP, WRAP_PX = 26, 380
DEFAULTS = {"watchInterval": 100, "col1_width": 100, "ffmts": "", "ifmts": "", "alwaysOnTop": 0, "autoSaveWatchlist": 1,
            "separateParams": 0}
START_TEXT = _("Commands may be tested here but they will NOT be saved")
ADDING = {"pin": N_("Add pin"), "sig": N_("Add signal"), "param": N_("Add parameter")}
# Commands that the HAL library may refuse; they start no programs.
REFUSABLE = {"addf", "alias", "delf", "delsig", "linkps", "linksp", "net", "newsig", "setp", "sets",
             "unalias", "unlinkp"}
MODES = ("showhal", "watchhal", "settings")
FILE_TYPES = ((_("Watch lists"), "*.halshow"), (_("All files"), "*"))
USAGE = """Usage: halshow [--help] [--fformat FORMAT] [--iformat FORMAT] [--noprefs] [WATCHFILE]
  --fformat FORMAT   how numbers are shown (a format of Tcl, for example %.3f)
  --iformat FORMAT   how s32 and u32 are shown (for example 0x%08X)
  --noprefs          without remembered settings; they stay as they are"""


def preferences_path():
    """$CONFIG_DIR, else beside the running machine's INI file, else the home directory."""
    folder = os.environ.get("CONFIG_DIR", "")
    if folder and os.pathsep not in folder and os.path.isdir(folder):
        return Path(folder) / "halshow.preferences"
    if os.environ.get("INI_FILE_NAME"):
        return Path(os.environ["INI_FILE_NAME"]).resolve().parent / "halshow.preferences"
    if os.path.exists(instance.suffixed("/tmp/linuxcnc.lock")):
        import linuxcnc
        try:
            stat = linuxcnc.stat()
            stat.poll()
            if stat.ini_filename:
                return Path(stat.ini_filename).parent / "halshow.preferences"
        except linuxcnc.error:
            pass
    return Path.home() / ".halshow_preferences"


class Preferences:
    """Remembered settings. path None: nothing is read or written."""

    def __init__(self, path):
        self.path, self.geometry, self.ratio = path, None, LEFT_SHARE
        self.values, calls = tclprefs.read(path, ("wm", "placeFrames")) if path else ({}, {})
        for words in calls.get("wm", ()):
            if words[:2] == ("geometry", "."):
                self.geometry = words[2]
        for words in filter(None, calls.get("placeFrames", ())):
            self.ratio = self._number(words[0], LEFT_SHARE)
        self.watchlist = tclprefs.words(self.values.get("watchlist", ""))
        self.workmode = self.values.get("workmode", "showhal")

    @staticmethod
    def _number(text, default):
        try:
            return float(text)
        except ValueError:
            return default

    def integer(self, name, low=0):
        return max(low, int(self._number(self.values.get(name, DEFAULTS[name]), DEFAULTS[name])))

    def text(self, name):
        return self.values.get(name, DEFAULTS[name])

    def save(self, geometry, ratio, width, words, workmode, settings):
        if not self.path:
            return
        lines = ["# Halshow settings", "# This file is written when halshow ends.", f"wm geometry . {geometry}",
                 f"placeFrames {ratio:.4f}", f"set ::ratio {ratio:.4f}", f"set ::old_w_leftf {width}",
                 f"set ::watchlist {tclprefs.quoted(words)}", f"set ::workmode {workmode}"]
        lines += [f"set ::{name} {tclprefs.quoted(value)}" for name, value in settings.items()]
        tclprefs.write(self.path, "\n".join(lines) + "\n")


class History:
    """Lines typed before. up() and down() give them, or None at the end."""

    def __init__(self):
        self.lines, self.place = [], 0

    def add(self, line):
        if line and (not self.lines or self.lines[-1] != line):
            self.lines.append(line)
        self.place = len(self.lines)

    def move(self, step):
        self.place = min(max(self.place + step, 0), len(self.lines))
        return self.lines[self.place] if self.place < len(self.lines) else ""


@contextlib.contextmanager
def overheard(lines):
    """What the HAL library writes on standard error goes into the list, too: the reasons of its refusals."""
    sys.stderr.flush()
    with tempfile.TemporaryFile() as file:
        kept = os.dup(2)
        os.dup2(file.fileno(), 2)
        try:
            yield
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            file.seek(0)
            text = file.read()
            os.write(2, text)
            lines += text.decode(errors="replace").splitlines()


class Window:
    def __init__(self, root, prefs, real="", integer=""):
        self.root, self.prefs, self.file, self.timer = root, prefs, None, None
        root.tk.eval(f"lappend auto_path {{{Tree.find().tcl}}}; package require Hal")
        root.bind("<Destroy>", lambda event: event.widget is root and root.tk.call("hal", "--leave"))
        self.style = tkstyle.apply(root)
        self.formats = watch.Formats(real or prefs.text("ffmts"), integer or prefs.text("ifmts"))
        self.interval = prefs.integer("watchInterval", 1)
        self.separate = bool(prefs.integer("separateParams"))
        self.tree_nodes, self.history, self.collapsed = [], History(), None
        self.ask_name, self.ask_file = simpledialog.askstring, filedialog
        root.title("Halshow")
        self._menus()
        self.status = ttk.Label(root, text=START_TEXT, anchor="w", padding=self.style.px(3), relief="sunken")
        self.status.pack(side="bottom", fill="x")
        self.panes = ttk.Panedwindow(root, orient="horizontal")
        self.panes.pack(fill="both", expand=True)
        self._left()
        self._right()
        px = self.style.px
        tkstyle.centre(root, px(SIZE[0]), px(SIZE[1]), MINIMUM)
        if prefs.geometry:
            try:
                root.geometry(prefs.geometry)
            except tk.TclError:
                pass
        root.update()
        self.place_frames(prefs.ratio)
        self.widen_left()
        self.panes.bind("<Configure>", lambda event: self.widen_left())
        self.panes.bind("<Button-1>", lambda event: self.panes.unbind("<Configure>"), "+")
        root.protocol("WM_DELETE_WINDOW", self.exit)
        root.attributes("-topmost", bool(prefs.integer("alwaysOnTop")))
        self.load_tree()
        if prefs.integer("autoSaveWatchlist"):
            self.add_words(prefs.watchlist, keep=True)
        if prefs.workmode == "watchhal":
            self.book.select(self.view)
        self.tick()

    # -- parts --------------------------------------------------------------------------

    def _menus(self):
        bar = tk.Menu(self.root)
        self.root.configure(menu=bar)
        self.menus = {}
        for title, tearoff, entries in (
                (N_("File"), True, ((N_("Load Watch List"), self.load_dialog),
                                    (N_("Save Watch List"), lambda: self.save_dialog(False)),
                                (N_("Save Watch List (multiline)"), lambda: self.save_dialog(True)), None,
                                (N_("Exit"), self.exit))),
                (N_("Tree View"), False, ((N_("Expand All"), self.expand), (N_("Collapse All"), self.collapse),
                                          (N_("Expand Pins"), lambda: self.expand("pin")),
                                      (N_("Expand Parameters"), lambda: self.expand("param")),
                                      (N_("Expand Signals"), lambda: self.expand("sig")), None,
                                      (N_("Reload tree view"), self.reload_tree))),
                (N_("Watch"), False, ((ADDING["pin"], lambda: self.add_dialog("pin")),
                                      (ADDING["sig"], lambda: self.add_dialog("sig")),
                                  (ADDING["param"], lambda: self.add_dialog("param")),
                                  (N_("Add from HAL text"), self.text_dialog), None,
                                  (N_("Reload Watch"), lambda: self.view.layout()), (N_("Erase Watch"), self.erase)))):
            menu = self.menus[title] = tk.Menu(bar, tearoff=tearoff)
            bar.add_cascade(label=_(title), menu=menu, underline=0)
            for entry in entries:
                if entry:
                    menu.add_command(label=_(entry[0]), command=entry[1])
                else:
                    menu.add_separator()

    def _left(self):
        px = self.style.px
        self.left = ttk.Frame(self.panes)
        self.panes.add(self.left, weight=0)
        top = ttk.Frame(self.left, padding=px(2))
        self.fold = ttk.Button(top, text="«", style="Toolbutton", width=2, command=self.toggle_left)
        self.fold.pack(side="right")
        self.filter = ttk.Entry(top)
        self.filter.pack(side="left", fill="x", expand=True)
        self.filter.bind("<Return>", lambda event: self.apply_filter())
        self.filter.bind("<KP_Enter>", lambda event: self.apply_filter())
        top.pack(fill="x")
        self.whole = tk.BooleanVar(self.root, False)
        self.tree_box = ttk.Frame(self.left)
        self.whole_box = ttk.Checkbutton(self.left, text=_("Full path (regex)"), variable=self.whole,
                                         command=self.apply_filter)
        self.whole_box.pack(anchor="w", padx=px(2))
        self.tree_box.pack(fill="both", expand=True)
        self.tree = ttk.Treeview(self.tree_box, show="tree", selectmode="extended")
        bar = ttk.Scrollbar(self.tree_box, command=self.tree.yview)
        self.tree.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        self.tree.pack(fill="both", expand=True)
        self.tree.tag_configure("param", foreground=self.style.colours["param"])
        self.tree.bind("<<TreeviewSelect>>", lambda event: None)
        self.tree.bind("<ButtonRelease-1>", self.tree_click)
        self.tree.bind("<Return>", lambda event: self.use_node(self.tree.focus()))
        self.tree.bind("<Button-3>", self.tree_popup)
        self.tree_menu = tk.Menu(self.root, tearoff=False)

    def _right(self):
        px = self.style.px
        right = ttk.Frame(self.panes)
        self.panes.add(right, weight=1)
        command = ttk.Frame(right, padding=px(4))
        command.pack(side="bottom", fill="x")
        ttk.Label(command, text=_("HAL command :")).pack(side="left")
        self.execute_button = ttk.Button(command, text=_("Execute"), command=self.execute)
        self.execute_button.pack(side="right")
        self.command = ttk.Entry(command, font="TkFixedFont")
        self.command.pack(side="left", fill="x", expand=True, padx=px(4))
        for key, action in (("Return", self.execute), ("KP_Enter", self.execute), ("Up", lambda: self.recall(-1)),
                            ("Down", lambda: self.recall(1))):
            self.command.bind(f"<{key}>", lambda event, a=action: a())
        self.book = ttk.Notebook(right)
        self.book.pack(fill="both", expand=True)
        box = ttk.Frame(self.book)
        self.text = tk.Text(box, wrap="none", state="disabled", relief="flat", width=10, height=4,
                            padx=px(4), pady=px(4))
        bars = (ttk.Scrollbar(box, command=self.text.yview),
                ttk.Scrollbar(box, orient="horizontal", command=self.text.xview))
        self.text.configure(yscrollcommand=bars[0].set, xscrollcommand=bars[1].set)
        bars[0].pack(side="right", fill="y")
        bars[1].pack(side="bottom", fill="x")
        self.text.pack(fill="both", expand=True)
        self.text.bind("<Control-c>", lambda event: self.copy_selection())
        self.text.bind("<Button-1>", lambda event: self.text.focus_set())
        self.text.bind("<Button-3>", self.text_popup)
        self.text_menu = tk.Menu(self.root, tearoff=False)
        self.view = WatchView(self.book, self.style, self.formats, self.say, self.show_in_tree, self,
                              px(self.prefs.integer("col1_width", 20)) / self.style.scale)
        self.settings = Settings(self.book, self)
        for page, title in ((box, _(" SHOW ")), (self.view, _(" WATCH ")), (self.settings.scroll, _(" SETTINGS "))):
            self.book.add(page, text=title)

    def say(self, text, bad=False):
        self.status.configure(text=" ".join(text.split()), style="Bad.TLabel" if bad else "TLabel")

    @property
    def mode(self):
        return MODES[self.book.index("current")]

    # -- left side ----------------------------------------------------------------------

    def place_frames(self, ratio):
        width = self.panes.winfo_width()
        self.panes.sashpos(0, round(width * min(max(ratio, 0.02), 0.9)))

    def widen_left(self):
        """Until the user moves the border there is room for what is left of it."""
        least = self.whole_box.winfo_reqwidth() + 2 * self.style.px(2)
        if self.prefs.ratio >= LEFT_SHARE and self.collapsed is None and self.panes.sashpos(0) < least:
            self.panes.sashpos(0, least)

    def ratio(self):
        return self.collapsed or self.panes.sashpos(0) / max(1, self.panes.winfo_width())

    def toggle_left(self):
        """The tree becomes a strip, or comes back."""
        if self.collapsed is None:
            self.collapsed = self.ratio()
            for widget in (self.whole_box, self.tree_box, self.filter):
                widget.pack_forget()
            self.fold.configure(text="»")
            self.panes.sashpos(0, self.style.px(STRIP))
        else:
            ratio, self.collapsed = self.collapsed, None
            self.filter.pack(side="left", fill="x", expand=True)
            self.whole_box.pack(anchor="w", padx=self.style.px(2))
            self.tree_box.pack(fill="both", expand=True)
            self.fold.configure(text="«")
            self.place_frames(ratio)

    def load_tree(self):
        """The tree as HAL is now; open branches stay open."""
        try:
            self.found = haltree.names()
        except RuntimeError as error:
            self.say(str(error), True)
            return
        tree = self.tree
        opened = {i for i in self.all_ids() if tree.item(i, "open")}
        self.tree_nodes = haltree.nodes(self.found, self.separate)
        tree.delete(*tree.get_children())
        for node in self.tree_nodes:
            tree.insert(node.parent, "end", iid=node.id, text=node.text, open=node.id in opened,
                        tags=("param",) if node.kind == "param" else ())

    def all_ids(self):
        return [node.id for node in self.tree_nodes if self.tree.exists(node.id)]

    def reload_tree(self):
        self.load_tree()
        self.say(_("The tree shows HAL as it is now"))

    def expand(self, kind=None):
        root = "pin" if kind == "param" and not self.separate else kind
        for node in self.tree_nodes:
            if root is None or node.id == root or node.id.startswith(root + "+"):
                self.tree.item(node.id, open=True)

    def collapse(self):
        for id_ in self.all_ids():
            self.tree.item(id_, open=False)

    def apply_filter(self):
        """Branches that match are opened and selected."""
        pattern = self.filter.get().strip()
        self.collapse()
        self.tree.selection_set()
        if not pattern:
            return
        try:
            found = haltree.matching(self.tree_nodes, pattern, self.whole.get())
        except re.error as error:
            self.say(_("filter: %s: in a regular expression . matches any character, \\. a dot") % error, True)
            return
        for id_ in found:
            parent = self.tree.parent(id_)
            while parent:
                self.tree.item(parent, open=True)
                parent = self.tree.parent(parent)
        self.tree.selection_set(*found)
        if found:
            self.tree.see(found[0])
        self.say(_("%d found") % len(found))

    def tree_click(self, event):
        if (self.tree.identify_region(event.x, event.y) == "tree"
                and "indicator" not in self.tree.identify_element(event.x, event.y)):
            self.use_node(self.tree.identify_row(event.y))

    def use_node(self, id_):
        """SHOW: what halcmd says of it. WATCH: a leaf goes to the list."""
        node = next((n for n in self.tree_nodes if n.id == id_), None)
        if not node:
            return
        if self.mode == "watchhal":
            if node.kind in watch.KINDS:
                self.add_words([f"{node.kind}+{node.name}"])
            return
        self.book.select(0)
        kinds = [node.kind or id_.split("+")[0]]
        if not node.kind and not self.separate and kinds == ["pin"]:
            kinds.append("param")
        self.show_text("\n\n".join(t
                                   for t in (self.hal("show", k, *([node.name] if node.name else [])) or ""
                                             for k in kinds) if t))

    def tree_popup(self, event):
        id_ = self.tree.identify_row(event.y)
        self.tree_menu.delete(0, "end")
        items = [w for w in haltree.leaves(self.tree_nodes, id_) if w[0] in watch.KINDS] if id_ else []
        self.tree_menu.add_command(label=_("Add all sub-items to watch"), state="normal" if items else "disabled",
                                   command=lambda: self.add_words(f"{kind}+{name}" for kind, name in items))
        self.tree_menu.tk_popup(event.x_root, event.y_root)

    def show_in_tree(self, item):
        root = "pin" if item.kind == "param" and not self.separate else item.kind
        id_ = f"{root}+{item.kind}+{item.name}"
        if not self.tree.exists(id_):
            self.load_tree()
        if self.collapsed is not None:
            self.toggle_left()
        if self.tree.exists(id_):
            self.tree.selection_set(id_)
            self.tree.see(id_)

    # -- SHOW and commands --------------------------------------------------------------

    def hal(self, *words):
        """A HAL command; its output, or None when it failed (the status line says why)."""
        reasons = []
        try:
            with overheard(reasons) if words[0] in REFUSABLE else contextlib.nullcontext():
                return str(self.root.tk.call("hal", *words))
        except tk.TclError as error:
            self.say(" ".join([*reasons, str(error)]), True)
            return None

    def show_text(self, text):
        self.text.configure(state="normal")
        self.text.delete("1.0", "end")
        self.text.insert("end", text)
        self.text.configure(state="disabled")

    def execute(self):
        line = self.command.get().strip()
        if not line:
            return
        self.history.add(line)
        words = line.split()
        if words[0] == "halcmd":
            words.pop(0)
        if words[:1] == ["help"]:           # halcmd itself would write it on the terminal
            text = subprocess.run(["halcmd", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  check=False).stdout
        elif words[:1] == ["save"] and len(words) < 3:
            text = self.saved(words)
        else:
            text = self.hal(*words) if words else ""
        if text is None:
            return
        self.command.delete(0, "end")
        self.say(_("Done: %s") % line)
        if text.strip():
            self.book.select(0)
            self.show_text(text)
        try:
            if haltree.names() != self.found:
                self.load_tree()
        except RuntimeError as error:
            self.say(str(error), True)
        self.view.layout()

    def saved(self, words):
        """What `save` without a file writes; None when it failed."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "saved.hal")
            if self.hal("save", *(words[1:] or ["all"]), path) is None:
                return None
            with open(path, encoding="utf-8", errors="replace") as file:
                return file.read()

    def recall(self, step):
        self.command.delete(0, "end")
        self.command.insert(0, self.history.move(step))
        return "break"

    def selection(self):
        try:
            return self.text.get("sel.first", "sel.last")
        except tk.TclError:
            return ""

    def copy_selection(self):
        if self.selection():
            self.root.clipboard_clear()
            self.root.clipboard_append(self.selection())
        return "break"

    def text_popup(self, event):
        text, menu = self.selection(), self.text_menu
        state = "normal" if text.strip() else "disabled"
        menu.delete(0, "end")
        menu.add_command(label=_("Copy"), state=state, command=self.copy_selection)
        for label, kind in ((N_("Add as Pin(s)"), "pin"), (N_("Add as Signal(s)"), "sig"),
                            (N_("Add as Param(s)"), "param")):
            menu.add_command(label=_(label), state=state,
                             command=lambda k=kind: self.add_words(f"{k}+{name}" for name in text.split()))
        menu.tk_popup(event.x_root, event.y_root)

    # -- WATCH --------------------------------------------------------------------------

    def add_words(self, words, keep=False):
        """Items that exist go to the list; others are told, and with `keep` shown as missing."""
        items, unknown = [], []
        have = set(self.view.words())
        for word in words:
            try:
                kind, name = watch.split(word)
                if word in have:
                    continue
                if watch.find(kind, name):
                    items.append((kind, name))
                    continue
                unknown.append(name)
                if keep:
                    items.append((kind, name))
            except (ValueError, RuntimeError) as error:
                unknown.append(str(error))
        if items:
            self.view.show([(r.item.kind, r.item.name) for r in self.view.rows] + items)
        if unknown:
            self.say(_("Not in HAL: %s") % (', '.join(unknown),), True)
        elif items:
            self.say(_("%d added to the watch list") % len(items))

    def add_dialog(self, kind):
        text = self.ask_name(_(ADDING[kind]), _("Name (several: with blanks between)"), parent=self.root)
        if text and text.strip():
            self.book.select(self.view)
            self.add_words(f"{kind}+{name}" for name in text.split())

    def text_dialog(self):
        """Lines of HAL files."""
        window = tk.Toplevel(self.root)
        window.title(_("Add from HAL text"))
        window.transient(self.root)
        ttk.Label(window, text=_("Lines: net SIGNAL PIN..., setp NAME VALUE, or names of pins"),
                  padding=self.style.px(6)).pack(fill="x")
        text = self.dialog_text = tk.Text(window, width=60, height=12)
        bar = ttk.Frame(window, padding=self.style.px(6))

        def add():
            words = watch.from_hal_text(text.get("1.0", "end"))
            window.destroy()
            self.book.select(self.view)
            self.add_words(words)
        self.dialog_add = ttk.Button(bar, text=_("Add"), command=add)
        self.dialog_add.pack(side="right")
        ttk.Button(bar, text=_("Cancel"), command=window.destroy).pack(side="right", padx=self.style.px(6))
        bar.pack(side="bottom", fill="x")
        text.pack(fill="both", expand=True)
        window.bind("<Escape>", lambda event: window.destroy())
        text.focus_set()

    def menu_elsewhere(self, menu):
        menu.add_command(label=_("Add from clipboard"), command=self.add_clipboard)
        menu.add_command(label=_("Add from HAL text"), command=self.text_dialog)
        menu.add_separator()
        menu.add_command(label=_("Erase Watch"), command=self.erase)

    def add_clipboard(self):
        try:
            text = self.root.clipboard_get()
        except tk.TclError:
            self.say(_("The clipboard is empty"), True)
            return
        words = text.split()
        self.add_words(words if all(w.split("+")[0] in watch.KINDS and "+" in w for w in words)
                       else watch.from_hal_text(text))

    def erase(self):
        self.view.show([])
        self.file = None
        self.root.title("Halshow")
        self.say(_("The watch list is empty"))

    def load(self, path):
        """A file replaces the list; the old one is kept beside it."""
        try:
            words = watch.read_file(path)
        except OSError as error:
            self.say(f"{path}: {error.strerror}", True)
            return
        if self.view.rows:
            try:
                tclprefs.write(Path(path).resolve().parent / watch.BACKUP, watch.file_text(self.view.words(), True))
            except OSError as error:
                self.say(f"{watch.BACKUP}: {error.strerror}", True)
        self.view.show([])
        self.say(_("Loaded %s") % path)
        self.add_words(words, keep=True)
        self.named(path)
        self.book.select(self.view)

    def save(self, path, multiline):
        try:
            tclprefs.write(path, watch.file_text(self.view.words(), multiline))
        except OSError as error:
            self.say(f"{path}: {error.strerror}", True)
            return
        self.named(path)
        self.say(_("Saved %s") % path)

    def named(self, path):
        self.file = Path(path)
        self.root.title(f"{self.file.name} - Halshow")

    def load_dialog(self):
        path = self.ask_file.askopenfilename(parent=self.root, title=_("Load Watch List"), filetypes=FILE_TYPES)
        if path:
            self.load(path)

    def save_dialog(self, multiline):
        path = self.ask_file.asksaveasfilename(parent=self.root, title=_("Save Watch List"), filetypes=FILE_TYPES,
                                               defaultextension=".halshow",
                                               initialfile=self.file.name if self.file else "my.halshow")
        if path:
            self.save(path, multiline)

    # -- time ---------------------------------------------------------------------------

    def tick(self):
        if self.mode == "watchhal":
            self.view.update_values()
        self.timer = self.root.after(self.interval, self.tick)

    def exit(self):
        self.save_preferences()
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()

    def save_preferences(self):
        keep = self.settings.value("autoSaveWatchlist")
        try:
            self.prefs.save(self.root.geometry(), self.ratio(), self.left.winfo_width(),
                            self.view.words() if keep else [], "watchhal" if self.mode == "watchhal" else "showhal",
                            self.settings.values())
        except OSError as error:
            print(f"halshow: {self.prefs.path}: {error.strerror}", file=sys.stderr)


class Settings:
    """The page SETTINGS. `scroll` is its outer widget."""

    def __init__(self, parent, window):
        self.window, style = window, window.style
        px, prefs = style.px, window.prefs
        self.scroll = Scrolled(parent, style)
        page = self.scroll.inner
        page.configure(padding=px(10))
        self.vars = {"watchInterval": tk.StringVar(page, window.interval),
                     "col1_width": tk.StringVar(page, prefs.integer("col1_width", 20)),
                     "ffmts": tk.StringVar(page, window.formats.real),
                     "ifmts": tk.StringVar(page, window.formats.integer),
                     "alwaysOnTop": tk.BooleanVar(page, prefs.integer("alwaysOnTop")),
                     "autoSaveWatchlist": tk.BooleanVar(page, prefs.integer("autoSaveWatchlist")),
                     "separateParams": tk.BooleanVar(page, window.separate)}
        self.entries = {}
        for row, (name, label) in enumerate((("watchInterval", _("Update interval (ms)")),
                                             ("col1_width", _("Column width")), ("ffmts", _("Float")),
                                             ("ifmts", _("Integer")))):
            if name == "ffmts":
                ttk.Label(page, text=_("Format overrides (printf style, for example %.3f and %08X):"),
                          wraplength=px(WRAP_PX)).grid(row=2, column=0, columnspan=2, sticky="w", pady=(px(8), 0))
            ttk.Label(page, text=label).grid(row=row + (row > 1), column=0, sticky="w", pady=px(2))
            self.entries[name] = ttk.Entry(page, textvariable=self.vars[name], width=12)
            self.entries[name].grid(row=row + (row > 1), column=1, sticky="w", pady=px(2))
            self.entries[name].bind("<Return>", lambda event: self.apply())
        self.boxes = {}
        for row, (name, label) in enumerate((("alwaysOnTop", _("Always on top")),
                                             ("autoSaveWatchlist", _("Remember watchlist")),
                                             ("separateParams", _("Separate parameters from pins in tree"))), 5):
            self.boxes[name] = ttk.Checkbutton(page, text=label, variable=self.vars[name])
            self.boxes[name].grid(row=row, column=0, columnspan=2, sticky="w", pady=(px(8) if row == 5 else 0, 0))
        self.button = ttk.Button(page, text=_("Apply"), command=self.apply)
        self.button.grid(row=8, column=0, sticky="w", pady=px(10))
        where = _("Settings are stored in\n%s") % prefs.path if prefs.path else _("Settings are not stored (--noprefs)")
        ttk.Label(page, text=where, style="Faint.TLabel", justify="left", wraplength=px(WRAP_PX)).grid(row=9, column=0, columnspan=2, sticky="w")
        self.scroll.wheel(*page.winfo_children())

    def value(self, name):
        return self.vars[name].get()

    def values(self):
        w = self.window
        return {"watchInterval": w.interval, "col1_width": round(w.view.column), "ffmts": w.formats.real,
                "ifmts": w.formats.integer,
                **{name: int(self.value(name)) for name in ("alwaysOnTop", "autoSaveWatchlist", "separateParams")}}

    def apply(self):
        window = self.window
        try:
            interval = watch.convert("u32", self.value("watchInterval"))
            column = watch.convert("u32", self.value("col1_width"))
            window.formats.check(self.value("ffmts"), self.value("ifmts"))
            if not 1 <= interval <= 60000:
                raise ValueError(_("update interval %s ms: must be 1 to 60000") % interval)
            if not 20 <= column <= 1000:
                raise ValueError(_("column width %s: must be 20 to 1000") % column)
        except ValueError as error:
            window.say(_("Not applied: %s") % error, True)
            return
        window.interval, window.view.column = interval, column
        window.formats.real, window.formats.integer = self.value("ffmts"), self.value("ifmts")
        window.root.attributes("-topmost", self.value("alwaysOnTop"))
        if window.separate != self.value("separateParams"):
            window.separate = self.value("separateParams")
            window.load_tree()
        window.view.layout()
        window.say(_("Applied"))
        window.save_preferences()


def main(arguments):
    real = integer = ""
    prefs, files, words = True, [], list(arguments)
    while words:
        word = words.pop(0)
        if word in ("--help", "-h"):
            print(USAGE)
            return 0
        if word in ("--fformat", "--iformat"):
            if not words:
                print(f"halshow: {word} needs a format\n{USAGE}", file=sys.stderr)
                return 1
            real, integer = (words.pop(0), integer) if word == "--fformat" else (real, words.pop(0))
        elif word == "--noprefs":
            prefs = False
        elif word.startswith("-") and word != "--":
            print(f"halshow: unknown option {word}\n{USAGE}", file=sys.stderr)
            return 1
        elif word != "--":
            files.append(word)
    try:
        watch.Formats().check(real, integer)
    except ValueError as error:
        print(f"halshow: {error}", file=sys.stderr)
        return 1
    root = tkstyle.open_display("halshow", "Halshow")
    window = Window(root, Preferences(preferences_path() if prefs else None), real, integer)
    if files:
        window.load(files[0])
    tkstyle.run(root, window.exit)
    return 0
