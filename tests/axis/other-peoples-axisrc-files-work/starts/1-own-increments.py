# increments as buttons, and a list of one's own
steps = ["1.0mm", "0.1mm", "0.01mm", "1/16in", "5 mil"]
root_window.tk.call(widgets.jogincr, "configure", "-values", [_("Continuous")] + steps)
row = Tkinter.Frame(root_window, name="steps")
root_window.tk.call("grid", row, "-in", tabs_manual, "-row", 41, "-column", 0, "-columnspan", 3)
def choose(text):
    root_window.tk.call("set", "jogincrement", text)
for n, text in enumerate([_("Continuous")] + steps):
    Tkinter.Radiobutton(row, text=text, value=text, variable="jogincrement", indicatoron=0, name="s%d" % n, takefocus=0).pack(side="left")
choose("0.1mm")
vars.jog_speed.set(600)
def faster():
    root_window.tk.call("set", "jog_slider_val", 0.5)
def slower():
    root_window.tk.call("set", "maxvel_slider_val", 0.5)
root_window.bind("<Key-F6>", lambda e: choose(steps[3]))
