# letters, places, a question before the program starts
t.config(height=8)
root_window.tk.call("wm", "geometry", ".", "1000x700+0+0")
root_window.minsize(800, 600)
root_window.tk.call(".pane", "sash", "place", 0, 1, 420)
asked, allowed = [], False
_run = TclCommands.task_run
def task_run(*event):
    asked.append("run")
    if allowed:
        _run(*event)
TclCommands.task_run = task_run
commands = TclCommands(root_window)
