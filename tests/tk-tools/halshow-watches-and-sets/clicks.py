from pathlib import Path

import hal
from kerf import tkstyle
from kerf.tktools.halshow import Preferences, Window, preferences_path
from tk_hand import Hand

root = tkstyle.open_display("halshow", "Halshow")
path = preferences_path()
print("preferences in", path.name, path.parent == Path("home").resolve())
window = Window(root, Preferences(path))
hand, tree, view = Hand(root), window.tree, window.view
print(root.title(), "|", window.status.cget("text"))
print("size", abs(root.winfo_width() - window.style.px(700)) < 2, "ratio", round(window.ratio(), 1))
print([tree.item(i, "text") for i in tree.get_children()])


def said():
    return window.status.cget("text")


def text():
    return window.text.get("1.0", "end").strip()


def show_watch():
    window.book.select(view)
    root.update()


def place(name):
    return [r.item.name for r in view.rows].index(name)


def row_click(name, button=3):
    hand.click(view.canvas, button, x=view.canvas.winfo_width() - 20, y=place(name) * view.height + view.height // 2)


def button(name, text):
    row = view.rows[place(name)]
    return next(b for b in row.widgets[0].winfo_children() if b.cget("text") == text)


def shown(name):
    row = view.rows[place(name)]
    return row.shown, view.canvas.itemcget(row.oval_id, "state"), view.canvas.itemcget(row.oval_id, "fill")


print("== tree")
window.expand("sig")
hand.row(tree, "sig+sig+wave")
print(text().splitlines()[-1].split()[-3:])
window.expand("pin")
hand.row(tree, "pin+siggen.0.")
print("pins and parameters:", "siggen.0.sine" in text(), "siggen.0.update.tmax" in text(), "mux2" in text())
print("a parameter is brown:", tree.item("pin+param+siggen.0.update.tmax", "tags"))
hand.cleared(window.filter, "^si.e$")
hand.key("Return")
print(said(), tree.selection(), tree.item("pin+siggen.", "open"), tree.item("pin+mux2.", "open"))
hand.click(window.whole_box, x=10)
hand.cleared(window.filter, r"gen\.0\.c")
hand.key("Return")
print(said(), tree.selection())
hand.cleared(window.filter, "(")
hand.key("Return")
print(said().split(":")[0])
hand.click(window.fold)
print("folded", window.panes.sashpos(0) == window.style.px(26), window.fold.cget("text"))
hand.click(window.fold)
print("back", round(window.ratio(), 1), window.fold.cget("text"))

print("== watch")
show_watch()
window.collapse()
window.expand("sig")
hand.row(tree, "sig+sig+freebit")
hand.row(tree, "sig+sig+freebit")
print(said(), view.words())
window.expand("pin")
hand.row(tree, "pin+and2.1.", button=3)
hand.pick(window.tree_menu, 0)
print(view.words())
window.add_words(["pin+mux2.0.in0", "sig+count", "param+siggen.0.update.tmax", "pin+siggen.0.frequency",
                  "pin+no.such", "x+y"])
print(said())
print(shown("freebit"), shown("siggen.0.frequency")[:2])
hand.click(button("freebit", "Set"))
print(shown("freebit"), hal.get_s("freebit"))
hand.click(button("freebit", "Tgl"))
print(hal.get_s("freebit"))
print("greyed:", str(button("mux2.0.in0", "Set val").cget("state")), "and no button for the output:",
      view.rows[place("and2.1.out")].widgets)
for name, typed in (("count", "0x10"), ("count", "3000000000"), ("count", "1.5"), ("siggen.0.frequency", "2,25"),
                    ("siggen.0.frequency", "fast")):
    view.ask_value = lambda *a, t=typed, **k: t
    hand.click(button(name, "Set val"))
    print(f"{name} {typed}:", said())
row_click("mux2.0.in0")
print([view.menu.entrycget(i, "label") for i in range(view.menu.index("end") + 1) if view.menu.type(i) == "command"])
hand.pick(view.menu, "Unlink*")
print(said(), str(button("mux2.0.in0", "Set val").cget("state")))
row_click("siggen.0.frequency")
hand.pick(view.menu, "Show in Tree")
print(tree.selection())
row_click("siggen.0.update.tmax")
hand.pick(view.menu, "Copy")
print("clipboard:", root.clipboard_get())
row_click("and2.1.out")
hand.pick(view.menu, "Remove")
row_click("and2.1.in0")
hand.pick(view.menu, "Remove")
root.clipboard_clear()
root.clipboard_append("net wave siggen.0.sine => mux2.0.in0\nsetp mux2.0.sel 1\nand2.0.out")
hand.click(view.canvas, 3, y=view.canvas.winfo_height() - 5)
hand.pick(view.menu, "Add from clipboard")
print(view.words())

print("== files")
window.save("one.halshow", False)
print(root.title())
window.save("many.halshow", True)
Path("other.halshow").write_text("# mine\npin+and2.0.in0 sig+wave\n\npin+not.yet\n")
window.load("other.halshow")
print(root.title(), view.words(), said(), shown("not.yet"))
window.load("many.halshow")
print(len(view.rows), window.mode)

print("== settings")
window.book.select(2)
root.update()
settings = window.settings
hand.cleared(settings.entries["watchInterval"], "0")
hand.click(settings.button)
print(said())
hand.cleared(settings.entries["watchInterval"], "50")
hand.cleared(settings.entries["ffmts"], "%q")
hand.click(settings.button)
print(said())
hand.cleared(settings.entries["ffmts"], "%.3f")
hand.cleared(settings.entries["ifmts"], "0x%04X")
hand.click(settings.boxes["separateParams"], x=10)
hand.click(settings.button)
print(said(), window.interval, [tree.item(i, "text") for i in tree.get_children()])
show_watch()
print(shown("siggen.0.frequency")[0], shown("count")[0])

window.add_words(["sig+wide"])
hal.set_s("wide", -2 ** 63)
view.update_values()
row = view.rows[place("wide")]
print(view.canvas.itemcget(row.value_id, "text"), "beside the buttons:",
      view.canvas.bbox(row.value_id)[2] <= row.widgets[0].winfo_x())
view.remove(row)

print("== commands")
hand.click(window.command)
for line in ("setp and2.0.in0 1", "setp and2.0.in0 1", "newsig fresh float", "lock all", "newsig other bit",
             "unlock all", "help ptype", "setp nothing 1", "show thread"):
    hand.cleared(window.command, line)
    hand.key("Return")
    print(line, "->", said().split(":", 1)[-1].strip()[:60],
          *(text().splitlines()[:1] if line.startswith("help") else ()))
print(window.history.lines, tree.exists("sig+sig+fresh"), hal.get_p("and2.0.in0"))
hand.key("Up", "Up")
print("recalled:", window.command.get())
window.book.select(0)
root.update()
hand.cleared(window.command, "show pin and2.0.out")
hand.click(window.execute_button)
print(text().splitlines()[0])
window.text.tag_add("sel", "3.40", "3.end")
hand.click(window.text, 3)
hand.pick(window.text_menu, "Copy")
print("copied:", root.clipboard_get().split())
hand.cleared(window.command, "save netl")
hand.key("Return")
print(text().splitlines())
show_watch()
window.add_words(["pin+mux2.0.in1"])
for line in ("unloadrt mux2", "loadrt mux2"):
    hand.cleared(window.command, line)
    hand.key("Return")
    show_watch()
    view.update_values()
    print(line, "->", shown("mux2.0.in1")[0], tree.exists("pin+pin+mux2.0.in1"))
window.add_words(["sig+wide"])
for line in ("delsig wide", "newsig wide bit"):
    window.hal(*line.split())
for _ in range(11):
    view.update_values()
print("another type:", shown("wide")[0], [b.cget("text") for b in view.rows[place("wide")].widgets[0].winfo_children()])
view.remove(view.rows[place("wide")])
window.exit()
again = Preferences(path)
print(again.workmode, len(again.watchlist), again.integer("watchInterval", 1), again.text("ffmts"))
