# keys: numeric pad for the feed, space stops, some of the keys of AXIS off, all others are seen
def feed(step):
    def go(event=None):
        set_feedrate(max(0, min(150, vars.feedrate.get() + step)))
        return "break"
    return go
root_window.bind("<Key-KP_Add>", feed(10))
root_window.bind("<Key-KP_Subtract>", feed(-10))
root_window.bind("<Key-space>", lambda e: commands.task_stop())
root_window.bind("<Key-Pause>", lambda e: commands.task_pauseresume())
for key in ("<Key-r>", "<Key-t>", "<Key-o>", "<Key-F7>", "<Key-F8>", "<Key-5>", "<Key-Up>", "<Key-Home>", "<Shift-Key-Home>", "<Key-b>"):
    root_window.bind(key, "")
root_window.unbind("<Control-Key-r>")
root_window.bind("<Alt-Key-r>", lambda e: commands.task_run())
pressed = []
root_window.bind("<Key>", lambda e: pressed.append(e.keysym))
root_window.bind("<KeyRelease>", lambda e: pressed.append("-" + e.keysym))
def home_if_needed(event):
    if not all_homed():
        commands.home_all_joints()
root_window.bind("<Key-F6>", home_if_needed)
widgets.mdi_command.bind("<Key-Prior>", lambda e: commands.mdi_up_cmd())
help1.append(("KP +/-", "Feed override"))
