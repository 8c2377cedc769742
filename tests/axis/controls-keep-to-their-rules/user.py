# a user's file that removes an entry, and whose update fails at every call
root_window.tk.call(".menu.file", "delete", "Edit tool data...")
root_window.tk.call(".menu.machine", "delete", "Step")
def user_live_update():
    raise ValueError("no such sensor")
