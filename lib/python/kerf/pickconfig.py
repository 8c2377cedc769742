# SPDX-License-Identifier: GPL-2.0-or-later
"""The picker: a window with the configurations; prints the chosen path on standard output.

Cancel prints nothing. What can be picked and how it is copied is in `kerf.configs`.
"""

import sys
import tkinter as tk
from pathlib import Path
from tkinter import messagebox, ttk

from . import configs, tkstyle
from .language import _
from .tree import Tree

LIST_PX = 240           # wide, for the names of configurations
WELCOME = (_("Pick the configuration of your machine and press OK.\n"
           "Sample configurations are copied to your own folder first."))


class Picker:
    """The window. `chosen` is the path when it ended with OK, else None."""

    def __init__(self, root, tree, start=None):
        self.root, self.tree, self.chosen = root, tree, None
        self.roots = configs.search_path(tree)
        self.paths = {}
        style = self.style = tkstyle.apply(root)
        px = style.px
        root.title(_("LinuxCNC Configuration Selector"))
        tkstyle.centre(root, px(780), px(480), (px(480), px(320)))
        head = ttk.Frame(root, padding=px(8))
        head.pack(fill="x")
        self.logo(head).pack(side="left", padx=(0, px(10)))
        ttk.Label(head, text=WELCOME).pack(side="left")
        buttons = ttk.Frame(root, padding=px(8))
        buttons.pack(side="bottom", fill="x")
        self.shortcut = tk.BooleanVar(root, False)
        ttk.Checkbutton(buttons, text=_("Create a shortcut on the desktop"), variable=self.shortcut).pack(side="left")
        ttk.Button(buttons, text=_("Cancel"), command=root.destroy).pack(side="right", padx=(px(8), 0))
        self.ok = ttk.Button(buttons, text="OK", command=self.accept, state="disabled")
        self.ok.pack(side="right")
        panes = ttk.PanedWindow(root, orient="horizontal")
        panes.pack(fill="both", expand=True, padx=px(8))
        self.list = self.make_list(panes)
        self.picture, self.text = self.make_details(panes)
        for folder in self.roots:
            self.fill("", configs.Node(configs.title(folder, tree), folder,
                                       configs.scan(folder, samples=folder == tree.configs)), opened=True)
        self.select(start or next((p
                                   for p in (tree.configs / f"sim/{n}.ini" for n in ("axis/axis", "mill/mill"))
                                   if p.exists()), None))
        self.list.bind("<<TreeviewSelect>>", lambda event: self.show())
        for key in ("<Return>", "<KP_Enter>"):
            self.list.bind(key, self.accept)
        self.list.bind("<Double-1>", self.clicked_twice)
        for key in ("<Return>", "<KP_Enter>"):
            root.bind(key, self.accept)
        root.bind("<Escape>", lambda event: root.destroy())
        self.list.focus_set()
        self.show()

    def logo(self, parent):
        """A tool on its way through a workpiece."""
        px, colours = self.style.px, self.style.colours
        size = px(44)
        picture = tk.Canvas(parent, width=size, height=size, highlightthickness=0, background=colours["face"])
        picture.create_rectangle(0, px(14), size, size, fill=colours["select"], width=0)
        picture.create_line(px(6), px(36), px(18), px(24), px(26), px(32), px(38), px(20), fill=colours["face"],
                            width=px(6), capstyle="round", joinstyle="round")
        picture.create_polygon(px(34), px(2), px(42), px(2), px(42), px(14), px(38), px(20), px(34), px(14),
                               fill=colours["ink"])
        return picture

    def make_list(self, panes):
        box = ttk.Frame(panes)
        panes.add(box, weight=2)
        tree = ttk.Treeview(box, show="tree", selectmode="browse")
        tree.column("#0", width=self.style.px(LIST_PX))
        bar = ttk.Scrollbar(box, command=tree.yview)
        tree.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        tree.pack(fill="both", expand=True)
        return tree

    def make_details(self, panes):
        box = ttk.Frame(panes)
        panes.add(box, weight=3)
        picture = ttk.Label(box, anchor="center")
        bar = self.bar = ttk.Scrollbar(box)
        text = tk.Text(box, wrap="word", width=30, height=10, state="disabled", relief="flat", padx=self.style.px(8),
                       pady=self.style.px(8), font="TkDefaultFont", yscrollcommand=bar.set)
        bar.configure(command=text.yview)
        bar.pack(side="right", fill="y")
        text.pack(fill="both", expand=True)
        return picture, text

    def fill(self, parent, node, opened=False):
        item = self.list.insert(parent, "end", text=node.name, open=opened)
        self.paths[item] = node.path
        for child in node.children:
            self.fill(item, child)

    def select(self, path):
        """Selects a path, or the first file when it is not there."""
        items = ([i for i, p in self.paths.items() if p == path]
                 or [i for i, p in self.paths.items() if configs.usable(p)])
        if items:
            self.list.see(items[0])
            self.list.selection_set(items[0])
            self.list.focus(items[0])

    def selected(self):
        items = self.list.selection()
        return self.paths[items[0]] if items else None

    def show(self):
        path = self.selected()
        text, picture = configs.details(path) if path else ("", None)
        self.text.configure(state="normal")
        self.text.delete("1.0", "end")
        self.text.insert("end", text)
        self.text.configure(state="disabled")
        try:
            self.image = tk.PhotoImage(file=str(picture)) if picture else ""
        except tk.TclError:
            self.image = ""
        if self.image and self.image.height() > (most := self.style.px(200)):
            self.image = self.image.subsample(-(-self.image.height() // most))
        self.picture.configure(image=self.image)
        if self.image:
            self.picture.pack(side="top", fill="x", before=self.bar)
        else:
            self.picture.pack_forget()
        self.ok.configure(state="normal" if path and configs.usable(path) else "disabled")

    def clicked_twice(self, event):
        """Counts on the selected line only: a folder's arrow that is clicked quickly does not select."""
        return self.accept() if self.list.identify_row(event.y) in self.list.selection() else None

    def accept(self, event=None):
        path = self.selected()
        if not path or not configs.usable(path):
            return None
        try:
            if configs.needs_copy(path, self.tree) and messagebox.askyesno(
                    _("Copy the configuration"),
                    _("Would you like to copy %s to\n%s?\nYou can change the copy; the original stays as it is.")
                    % (path.stem, configs.user_configs()), parent=self.root):
                path = configs.copy(path, self.tree, self.roots)
                messagebox.showinfo(_("Copied"), _("The configuration is now in\n%s") % path.parent, parent=self.root)
            if self.shortcut.get():
                configs.make_shortcut(path, self.tree)
        except OSError as e:
            messagebox.showerror(_("Not possible"), str(e), parent=self.root)
            return "break"
        try:
            configs.remember(path)
        except OSError as e:        # the machine can be started all the same
            print(f"pickconfig: the choice is not remembered: {e}", file=sys.stderr)
        self.chosen = path
        self.root.destroy()
        return "break"      # the list's own binding would look for a list that is gone


def main(argv=()):
    root = tkstyle.open_display("pickconfig", "Pickconfig")
    picker = Picker(root, Tree.find(), Path(argv[0]) if argv else None)
    root.mainloop()
    if picker.chosen:
        print(picker.chosen)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
