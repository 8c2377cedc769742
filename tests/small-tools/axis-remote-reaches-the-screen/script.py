# SPDX-License-Identifier: GPL-2.0-or-later
import os
import subprocess
import threading
import tkinter

from axis import remote

root = tkinter.Tk()
log, busy = [], []


class Screen:
    def load(self, path): log.append(("load", os.path.relpath(path)))
    def reload(self): log.append(("reload",))
    def send_mdi(self, text): log.append(("mdi", text))
    def clear_live_plot(self): log.append(("clear",))
    def quit(self): log.append(("quit",)); root.destroy()


def ask(*words):
    done = subprocess.run(["axis-remote", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, timeout=60)
    return done.returncode, done.stderr.splitlines()[:1] if done.returncode != 99 else "usage"


def conversation():
    for words in (["--ping"], ["a/part.ngc"], ["-r"], ["--mdi", "G0 X1 Y[2+3]"], ["-c"], ["-h"], ["-r", "-c"], [],
                  ["a", "b"], ["-m"], ["--reload", "x"], ["-x"]):
        print(words, *ask(*words), log.pop() if log else "")
    busy.append(1)
    for words in (["b.ngc"], ["-m", "G0 X2"], ["-r"], ["-q"], ["-c"], ["-p"]):
        print("running", words, *ask(*words), log.pop() if log else "")
    busy.clear()
    print(["-q"], *ask("-q"))


print("before:", *ask("--ping"), *ask("-r"))
remote.serve(root)
root.tk.createcommand("remote", remote.answers(root, Screen(), lambda: bool(busy)))
thread = threading.Thread(target=conversation)
thread.start()
root.mainloop()
thread.join()
print(log)
