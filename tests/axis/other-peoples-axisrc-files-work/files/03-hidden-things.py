# a machine without rotary axes, flood, limits
for name in ("flood", "mist", "coolant", "override", "brake"):
    w = getattr(widgets, name)
    root_window.tk.call("pack", "forget", w) if w.winfo_manager() == "pack" else root_window.tk.call("grid", "remove", w)
widgets.axis_z.grid_remove()
widgets.joints.grid_forget()
widgets.menu_view.delete("Show offsets") if False else widgets.menu_view.entryconfigure(0, state="disabled")
root_window.tk.call(".menu", "delete", "Help")
root_window.tk.call("grid", "forget", ".pane.top.rapidoverride")
root_window.tk.call("pack", "forget", ".toolbar.view_p", ".toolbar.rule12")
widgets.spinoverridef.grid_remove()
root_window.tk.call(".pane.top.tabs", "itemconfigure", "mdi", "-text", "Line of code")
