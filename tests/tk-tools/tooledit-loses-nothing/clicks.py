from kerf import tkstyle
from kerf.tktools.tooledit import Table, Window, chosen_columns
from tk_hand import Hand

open(".tooleditrc", "w").write("# mine\nset geometry 1000x400+10+10\n")
root = tkstyle.open_display("tooledit", "Tooledit")
window = Window(root, Table("tool.tbl"), chosen_columns(["x", "z", "diam", "front"])[0], ".tooleditrc")
hand, sheet, buttons = Hand(root), window.sheet, window.buttons


def state(name):
    return str(buttons[name].cget("state"))


def cell(row, key):
    return sheet.entry(row, key)


def status():
    return window.status.cget("text")


print("geometry", root.winfo_width(), root.winfo_height())
print([h.cget("text") for h in sheet.heads], len(window.table.rows))
print("reload offered:", bool(buttons["ReLoadTable"].winfo_manager()), "delete:", state("Delete"))
hand.click(cell(1, "X"))
hand.key("ctrl+slash")
hand.type("0,750")        # FP-175: a decimal comma
hand.key("Down")
hand.type("1e")
print("typed:", window.table.rows[1].get("X"), "red:", cell(2, "X").cget("foreground") == window.style.colours["bad"],
      cell(1, "X").cget("foreground") == window.style.colours["ink"])
hand.key("ctrl+slash")
hand.type("1_0")        # the controller reads 1, Python 10
print("red:", cell(2, "X").cget("foreground") == window.style.colours["bad"])
hand.key("ctrl+slash")
hand.type("1e")
hand.key("Right")
hand.key("Up")
print("focus is Z of tool 2:", root.focus_get() is cell(1, "Z"))
hand.key("Left", "Left", "Left", "Left")
print("focus wraps to the comment:", root.focus_get() is cell(1, ";"))
hand.click(buttons["SaveFile"])
print(status(), window.problem_window.winfo_children()[1].get(0, "end"))
window.problem_window.destroy()
hand.cleared(cell(2, "X"), "-2")
hand.click(buttons["AddTool"])
print("new:", window.table.rows[-1].get("T"), window.table.rows[-1].get(";")[:6], root.focus_get() is cell(3, "T"))
hand.click(buttons["SaveFile"])
print(status())
window.problem_window.destroy()
for key, text in (("T", "4"), ("P", "9"), ("Z", "3")):
    hand.cleared(cell(3, key), text)
hand.click(buttons["SaveFile"])
print(window.problem_window.winfo_children()[1].get(0, "end"))
window.problem_window.destroy()
hand.cleared(cell(3, "T"), "0")
hand.click(sheet.heads[0])
print("sorted:", [r.get("T") for r in window.table.rows], status())
hand.click(sheet.heads[0])
print("sorted:", [r.get("T") for r in window.table.rows], status())
hand.click(sheet.lines[3][0])
print("delete:", state("Delete"))
hand.click(buttons["Delete"])
print([r.get("T") for r in window.table.rows], "delete:", state("Delete"), root.title())
hand.click(buttons["SaveFile"])
print(status(), root.title())
open("tool.tbl", "a").write("T9 P9 ;another hand\n")
hand.cleared(cell(0, "Z"), "5")
with hand.answers("no"):
    hand.click(buttons["SaveFile"])
print(status())
with hand.answers("cancel"):
    hand.click(buttons["Quit"])
print("FP-186: asked, still open, edited:", bool(root.winfo_exists()), window.table.modified,
      window.table.rows[0].get("Z"))
hand.click(buttons["ReRead"])
print(status(), window.table.modified)
many = Table("tool.tbl")
window.table.rows[:] = many.rows * 250
sheet.show(window.table.rows)
print("widgets for", len(window.table.rows), "tools:", len(sheet.lines) < 40)
hand.click(cell(0, "T"))
hand.key("Up")
print("the end is in sight:", sheet.top + sheet.visible() == len(window.table.rows),
      root.focus_get() is cell(len(window.table.rows) - 1, "T"))
hand.click(buttons["ReRead"])
hand.click(buttons["Quit"])
