# touch off with a plate of known thickness
plate = float(inifile.find("AXIS_Z", "PLATE") or 12.5)
def touch_off_plate(event=None):
    new, ignored = prompt_float("Plate", "Thickness of the plate:", plate, "mm")
    if new is None:
        return
    ensure_mode(linuxcnc.MODE_MDI)
    c.mdi("G10 L20 P0 Z%f" % new)
    c.wait_complete()
    ensure_mode(linuxcnc.MODE_MANUAL)
    reload_file(False)
    s.poll()
    o.tkRedraw() if hasattr(o, "tkRedraw") else commands.redraw_soon()
TclCommands.touch_off_plate = touch_off_plate
commands = TclCommands(root_window)
button = Tkinter.Button(widgets.homebutton.master, name="plate", text="Plate", command=touch_off_plate)
button.pack(side="left")
root_window.tk.call("setup_widget_accel", button, "P_late")
