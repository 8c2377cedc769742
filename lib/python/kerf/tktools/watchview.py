# SPDX-License-Identifier: GPL-2.0-or-later
"""The rows of a watch list: value, buttons, name."""

import tkinter as tk
import tkinter.font
from tkinter import simpledialog, ttk

from ..language import _
from .watch import Item

COLOURS = {"pin": "pin", "sig": "signal", "param": "param"}
CONNECTION_TICKS = 10       # updates between two looks at what is connected
LONGEST = 40                # characters of a value that are shown


class Row:
    """Canvas items and widgets of one item."""

    def __init__(self, item):
        self.item, self.widgets, self.shown = item, [], None
        self.laid = None            # the type and access that its buttons are for
        self.value_id = self.oval_id = self.name_id = None


class WatchView(ttk.Frame):
    """say(text, bad) shows a message; show_in_tree(item) and text_dialog() belong to the window around."""

    def __init__(self, parent, style, formats, say, show_in_tree, text_dialog, column=100):
        super().__init__(parent)
        self.style, self.formats, self.say, self.show_in_tree, self.text_dialog = style, formats, say, show_in_tree, text_dialog
        self.column, self.rows, self.ticks, self.ask_value = column, [], 0, simpledialog.askstring
        self.widest = 0             # pixels of the widest value of this list so far
        self.canvas = tk.Canvas(self, highlightthickness=0, background=style.colours["field"])
        bar = ttk.Scrollbar(self, command=self.canvas.yview)
        self.across = ttk.Scrollbar(self, orient="horizontal", command=self.canvas.xview)
        self.canvas.configure(yscrollcommand=bar.set, xscrollcommand=self._xset)
        bar.pack(side="right", fill="y")
        self.canvas.pack(fill="both", expand=True)
        self.font = tkinter.font.nametofont("TkDefaultFont", self)
        self.menu = tk.Menu(self, tearoff=False)
        self.canvas.bind("<Button-3>", self.popup)
        self._wheel(self.canvas)
        self.canvas.bind("<Configure>", lambda event: self.lines())

    def _xset(self, first, last):
        """A bar below only where names are too long for the window."""
        self.across.set(first, last)
        if float(first) <= 0 and float(last) >= 1:
            self.across.pack_forget()
        elif not self.across.winfo_manager():
            self.across.pack(side="bottom", fill="x", before=self.canvas)

    def _wheel(self, widget):
        for button, step in (("<Button-4>", -1), ("<Button-5>", 1)):
            widget.bind(button, lambda event, n=step: self.canvas.yview_scroll(n, "units"))

    # -- the list -----------------------------------------------------------------------

    def words(self):
        return [row.item.word for row in self.rows]

    def add(self, kind, name):
        """False when it is there already."""
        if f"{kind}+{name}" in self.words():
            return False
        self.rows.append(Row(Item(kind, name)))
        self.layout()
        return True

    def show(self, items):
        """These (kind, name) pairs."""
        self.widest = 0
        self.rows = [Row(Item(kind, name)) for kind, name in dict.fromkeys(items)]
        self.layout()

    def remove(self, row):
        self.rows.remove(row)
        self.layout()

    # -- drawing ------------------------------------------------------------------------

    @property
    def height(self):
        return max(self.font.metrics("linespace") + self.style.px(10), self.style.px(26))

    def layout(self):
        """All rows anew."""
        canvas, height, px = self.canvas, self.height, self.style.px
        canvas.delete("all")
        for row in self.rows:
            for widget in row.widgets:
                widget.destroy()
            row.widgets, row.shown = [], None
        left = px(8)
        buttons = left + max(px(self.column), self.widest + px(8))
        for place, row in enumerate(self.rows):
            row.item.refresh()
            row.laid = row.item.type, row.item.access
            y = place * height + height // 2
            size = px(8)
            row.oval_id = canvas.create_oval(left, y - size, left + 2 * size, y + size, state="hidden",
                                             outline=self.style.colours["line"])
            row.value_id = canvas.create_text(left, y, anchor="w", font="TkDefaultFont", fill=self.style.colours["ink"])
            row.name_id = canvas.create_text(buttons, y, anchor="w", text=row.item.name, font="TkDefaultFont",
                                             fill=self.style.colours[COLOURS[row.item.kind]])
            if row.item.access != "read":
                self.make_buttons(row, buttons, y)
        self.update_idletasks()
        room = max([w.winfo_reqwidth() for row in self.rows for w in row.widgets], default=0)
        for row in self.rows:
            canvas.move(row.name_id, room + px(8), 0)
        self.lines()
        self.update_values()

    def make_buttons(self, row, x, y):
        if row.item.type == "bit":
            actions = [(_("Tgl"), lambda: self.set(row, not row.item.value())), (_("Set"), lambda: self.set(row, True)),
                       (_("Clr"), lambda: self.set(row, False))]
        else:
            actions = [(_("Set val"), lambda: self.ask(row))]
        frame = ttk.Frame(self.canvas, style="Field.TFrame")
        ttk.Style(self).configure("Field.TFrame", background=self.style.colours["field"])
        for text, action in actions:
            button = ttk.Button(frame, text=text, style="Small.TButton", command=action, takefocus=False,
                                state="normal" if row.item.access == "write" else "disabled")
            button.pack(side="left", padx=1)
            button.bind("<Button-3>", lambda event, r=row: self.popup(event, r))
            self._wheel(button)
        self.canvas.create_window(x, y, anchor="w", window=frame)
        row.widgets.append(frame)

    def lines(self):
        """Lines between rows; they follow the width."""
        canvas, height = self.canvas, self.height
        canvas.delete("line")
        width = max(canvas.winfo_width(), (canvas.bbox("all") or (0, 0, 0, 0))[2])
        for place in range(1, len(self.rows) + 1):
            canvas.create_line(0, place * height, width, place * height,
                               fill=self.style.colours["heading"], tags="line")
        canvas.configure(scrollregion=(0, 0, width, max(len(self.rows) * height, 1)), yscrollincrement=height)

    def update_values(self):
        """What has changed in HAL; called at the update interval."""
        self.ticks += 1
        if (self.ticks % CONNECTION_TICKS == 0
                and any(bool(row.item.refresh()) and (row.item.type, row.item.access) != row.laid
                        for row in self.rows)):
            self.layout()
            return
        wide = self.widest
        for row in self.rows:
            value = row.item.value()
            text = self.formats.text(row.item.type, value)
            if text != row.shown:
                row.shown = text
                self.draw(row, value, text if len(text) <= LONGEST else text[:LONGEST] + "…")
                if box := self.canvas.bbox(row.value_id):
                    wide = max(wide, box[2] - self.style.px(8))
        if wide > max(self.widest, self.style.px(self.column)):
            self.widest = wide
            self.layout()

    def draw(self, row, value, text):
        """A lamp for a bit and for what is gone; else text."""
        canvas, left = self.canvas, self.style.px(8)
        lamp = row.item.type == "bit" or value is None
        if lamp:
            colour = self.style.colours["off"] if value is None else self.style.colours["true" if value else "false"]
            canvas.itemconfigure(row.oval_id, fill=colour)
        canvas.itemconfigure(row.oval_id, state="normal" if lamp else "hidden")
        canvas.coords(row.value_id, left + (self.style.px(22) if lamp else 0), canvas.coords(row.value_id)[1])
        canvas.itemconfigure(row.value_id, text="" if lamp and value is not None else text)

    # -- setting ------------------------------------------------------------------------

    def set(self, row, value):
        try:
            row.item.set(value)
            self.say(f"{row.item.name} = {self.formats.text(row.item.type, row.item.value())}")
        except (RuntimeError, ValueError, OverflowError, TypeError) as error:
            self.say(f"{row.item.name}: {error}", True)
        self.update_values()

    def ask(self, row):
        value = row.item.value()
        text = self.ask_value(_("Set value"), f"{row.item.name} ({row.item.type})", parent=self,
                              initialvalue=self.formats.text("", value) if value is None
                              else repr(value) if row.item.type == "float" else str(int(value)))
        if text is not None and text.strip():
            self.set(row, text)

    def unlink(self, row):
        if self.text_dialog.hal("unlinkp", row.item.name) is not None:
            self.say(_("%s is not connected any more") % row.item.name)
        self.layout()

    # -- menus --------------------------------------------------------------------------

    def row_at(self, y):
        place = int(self.canvas.canvasy(y)) // self.height
        return self.rows[place] if 0 <= place < len(self.rows) else None

    def popup(self, event, row=None):
        row = row or self.row_at(event.y)
        self.menu.delete(0, "end")
        (self.row_menu if row else self.text_dialog.menu_elsewhere)(self.menu, *([row] if row else []))
        self.menu.tk_popup(event.x_root, event.y_root)

    def row_menu(self, menu, row):
        item = row.item
        menu.add_command(label=_("Copy"), command=lambda: self.copy(item.name))
        writable = "normal" if item.access == "write" else "disabled"
        if item.type == "bit":
            menu.add_command(label=_("Set to TRUE"), state=writable, command=lambda: self.set(row, True))
            menu.add_command(label=_("Set to FALSE"), state=writable, command=lambda: self.set(row, False))
        else:
            menu.add_command(label=_("Set to .."), state=writable, command=lambda: self.ask(row))
        if item.kind == "pin" and item.info and item.info["signal"]:
            menu.add_command(label=_("Unlink pin (from %s)") % item.info["signal"], command=lambda: self.unlink(row))
        menu.add_command(label=_("Show in Tree"), state="normal" if item.info else "disabled",
                         command=lambda: self.show_in_tree(item))
        menu.add_separator()
        menu.add_command(label=_("Remove"), command=lambda: self.remove(row))

    def copy(self, text):
        self.clipboard_clear()
        self.clipboard_append(text)
        self.say(_("Copied: %s") % text)


