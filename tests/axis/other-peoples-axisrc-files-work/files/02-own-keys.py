# keys of one's own; F7 and F8 are free here
def go_to_zero(event=None):
    if not manual_ok():
        return
    ensure_mode(linuxcnc.MODE_MDI)
    c.mdi("G53 G0 Z0")
    c.wait_complete()
    c.mdi("G0 X0 Y0")
    c.wait_complete()
    ensure_mode(linuxcnc.MODE_MANUAL)
TclCommands.go_to_zero = go_to_zero
commands = TclCommands(root_window)
root_window.bind("<F6>", go_to_zero)
root_window.bind("<Shift-F6>", lambda event: commands.set_view_z())
root_window.unbind("<KeyPress-Foo>") if False else None
help1.append(("F6", _("Go to zero")))
help2.insert(0, ("Shift-F6", "Top view"))
root_window.tk.call("bind", ".", "<Control-Key-g>", "go_to_zero")
