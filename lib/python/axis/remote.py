# SPDX-License-Identifier: GPL-2.0-or-later
"""What axis-remote asks of the screen, by Tk's `send axis remote VERB [ARGUMENT]`."""

import subprocess

BUSY = "axis cannot accept remote command while running"


def serve(root):
    """Names the program `axis`."""
    for entry in ("gdm", "root"):  # Tk takes commands of others only when xauth alone guards the display
        try:
            subprocess.run(["xhost", f"-SI:localuser:{entry}"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, timeout=5)
        except (OSError, subprocess.TimeoutExpired):
            break
    root.tk.call("tk", "appname", "axis")


def answers(root, screen, running):
    """The command `remote`. screen has load(path), reload(), send_mdi(text), clear_live_plot() and quit(), of which
    load and reload may return BUSY; running() is true while a program runs."""
    verbs = {"open_file_name": screen.load, "reload_file": screen.reload, "send_mdi_command": screen.send_mdi,
             "clear_live_plot": screen.clear_live_plot, "destroy": lambda: root.after_idle(screen.quit)}

    def remote(verb="", *arguments):
        if verb not in verbs:
            return f"unknown remote command '{verb}'"
        if verb != "clear_live_plot" and running():
            return BUSY
        return BUSY if verbs[verb](*arguments) == BUSY else ""

    return remote
