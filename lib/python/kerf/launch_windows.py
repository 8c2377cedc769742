# SPDX-License-Identifier: GPL-2.0-or-later
"""Windows of the launcher: the picture while the machine starts, and what went wrong.

    python3 -m kerf.launch_windows splash PICTURE SECONDS
    python3 -m kerf.launch_windows errors DIED [PRINT_LOG DEBUG_LOG]
"""

import io
import subprocess
import sys
import tkinter as tk
from pathlib import Path
from tkinter import ttk

from . import tkstyle
from .language import _, N_

REPORT = Path("/tmp/linuxcnc.report")
MOST_OF_SCREEN = 0.8        # for the picture of the start
SHARP = 1.2                 # scale up to which it is shown pixel by pixel


def fitting(root, picture):
    """The picture as large as the screen's scale says, and no larger than the greater part of it."""
    found = tk.PhotoImage(file=picture)
    size, screen = (found.width(), found.height()), (root.winfo_screenwidth(), root.winfo_screenheight())
    factor = min(tkstyle.screen_scale(root), *(MOST_OF_SCREEN * most / side for most, side in zip(screen, size)))
    if 1 <= factor < SHARP:
        return found
    from PIL import Image
    with Image.open(picture) as image:
        data = io.BytesIO()
        image.convert("RGBA").resize([max(1, round(side * factor)) for side in image.size],
                                     Image.LANCZOS).save(data, "PNG")
    return tk.PhotoImage(data=data.getvalue())


def splash(picture, seconds):
    """A bare window with the picture in the middle of the screen; a click or the time ends it."""
    root = tk.Tk()
    root.overrideredirect(True)
    image = fitting(root, picture)
    tk.Label(root, image=image, borderwidth=2, relief="ridge").pack()
    x, y = (root.winfo_screenwidth() - image.width()) // 2, (root.winfo_screenheight() - image.height()) // 2
    root.geometry(f"+{max(x, 0)}+{max(y, 0)}")
    root.bind("<Button>", lambda event: root.destroy())
    root.after(int(float(seconds) * 1000), root.destroy)
    root.mainloop()


def read(path):
    try:
        return Path(path).read_text(errors="replace")
    except OSError as e:
        return f"{path}: {e.strerror}\n"


def kernel_messages():
    done = subprocess.run(["dmesg"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False)
    return "\n".join(done.stdout.splitlines()[-200:]) + "\n"


class Errors:
    """Both logs and the kernel's messages, with a button that writes a report to send. died:
    what of the machine ended."""

    def __init__(self, root, died, print_log=None, debug_log=None):
        self.root = root
        logs = ({N_("What the programs reported"): read(debug_log), N_("Steps of the start"): read(print_log)}
                if print_log else {})
        self.texts = logs | {N_("Kernel messages"): kernel_messages()}
        root.title(died if died else _("LinuxCNC terminated with an error"))
        px = tkstyle.apply(root).px
        tkstyle.centre(root, px(820), px(520), (px(480), px(300)))
        if died:
            ttk.Label(root, padding=px(8), wraplength=px(780), justify="left", font="TkHeadingFont", style="Bad.TLabel",
                      text=died + "\n" + _("Motion was stopped, the machine was switched off, spindles and coolant "
                                           "too. It must be "
                                           "started and homed again.")).pack(fill="x")
        ttk.Label(root, padding=px(8), wraplength=px(780), justify="left",
                  text=_("LinuxCNC terminated with an error. The last lines below usually say which "
                         "program or file, and "
                       "where in it.")).pack(fill="x")
        buttons = ttk.Frame(root, padding=px(8))
        buttons.pack(side="bottom", fill="x")
        self.state = ttk.Label(buttons)
        self.state.pack(side="left", fill="x")
        ttk.Button(buttons, text=_("Close"), command=root.destroy).pack(side="right", padx=(px(8), 0))
        ttk.Button(buttons, text=_("Write report"), command=self.report).pack(side="right")
        book = ttk.Notebook(root)
        book.pack(fill="both", expand=True, padx=px(8))
        for name, text in self.texts.items():
            book.add(self.page(book, text), text=_(name))
        root.bind("<Escape>", lambda event: root.destroy())

    @staticmethod
    def page(book, text):
        frame = ttk.Frame(book)
        bar = ttk.Scrollbar(frame)
        bar.pack(side="right", fill="y")
        box = tk.Text(frame, wrap="word", font="TkFixedFont", yscrollcommand=bar.set)
        box.pack(fill="both", expand=True)
        bar.configure(command=box.yview)
        box.insert("end", text or _("(nothing)") + "\n")
        box.see("end")
        box.configure(state="disabled")
        return frame

    def report(self):
        """Everything that helps to find the reason, in one file."""
        subprocess.run(["linuxcnc_info", "-s"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False)
        parts = [f"===== {name}\n{text}" for name, text in self.texts.items()]
        try:
            REPORT.write_text("\n".join(parts) + "\n===== System\n" + read("/tmp/linuxcnc_info.txt"))
            self.state.configure(text=_("Written: %s") % REPORT)
        except OSError as e:
            self.state.configure(text=f"{REPORT}: {e.strerror}", style="Bad.TLabel")


def main(argv):
    kind, *arguments = argv
    if kind == "splash":
        splash(*arguments)
    else:
        root = tkstyle.open_display("linuxcnc", "LinuxCNC")
        Errors(root, *arguments)
        root.mainloop()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
