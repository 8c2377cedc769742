# pages of one's own, commands called from Python
page = commands.dynamic_tab("maint", "Maintenance")
hours = Tkinter.Label(root_window, name="hours", text="0 h")
root_window.tk.call("pack", hours, "-in", page)
raised = []
def setup_raised():
    raised.append(1)
TclCommands.setup_raised = setup_raised
commands = TclCommands(root_window)
root_window.tk.call(widgets.right, "insert", "end", "setup", "-text", "Setup", "-raisecmd", "setup_raised")
root_window.tk.call(".pane.top.tabs", "insert", "end", "probe", "-text", "Probe")
Tkinter.Button(root_window, name="go", command=lambda: commands.send_mdi_command("G0 Z-1"))
commands.set_grid_size(10 / 25.4)
commands.set_feedrate(90)
commands.setup_raised()
answer = commands.remote("clear_live_plot")
