# a screen for the apprentice: little on it
for name in ("spindle_minus", "spindle_plus", "brake"):
    root_window.tk.call("pack", "forget", getattr(widgets, name))
widgets.flood.grid_forget()
for name in ("view_z", "view_z2", "rotate", "axis_y", "spindlef", "help_window"):
    getattr(widgets, name).destroy()
for path in (".toolbar.program_step", ".pane.top.spinoverride", ".pane.top.gcodes", ".info.tool", ".pane.bottom.t.text",
             ".pane.top.tabs.fmdi.go", ".menu.help"):
    root_window.tk.call("destroy", path)
root_window.tk.call("pack", "forget", ".info.position")
widgets.menu_file.delete("Reload")
widgets.menu_machine.delete("Calibration", "Set Debug Level")
widgets.menu_view.delete(0, "end")
root_window.tk.call(".menu.machine", "delete", 0, "end")
root_window.tk.call(".pane.top.tabs", "delete", "mdi")
root_window.tk.call(".pane", "forget", ".pane.bottom")
