# SPDX-License-Identifier: GPL-2.0-or-later
# While one thread waits for a command the others poll, on objects of their own and on one that they share; Ctrl-C and
# signal handlers end a wait at once.
import signal
import threading
import time

from mill import *

on()
mode(MODE_MDI)
stop, counts, wrong = threading.Event(), [0, 0, 0], []
shared = linuxcnc.stat()


def look(n):
    stat = shared if n else linuxcnc.stat()
    while not stop.is_set():
        try:
            stat.poll()
            stat.position, stat.joint, stat.tool_table, stat.file
        except Exception as error:
            wrong.append(error)
        counts[n] += 1
        time.sleep(0.001)


threads = [threading.Thread(target=look, args=(n,)) for n in range(3)]
for thread in threads:
    thread.start()


class Alarm(Exception):
    pass


def ring(*_):
    raise Alarm


signal.signal(signal.SIGALRM, ring)
for name, number, what in (("Ctrl-C", signal.SIGINT, KeyboardInterrupt), ("handler", signal.SIGALRM, Alarm)):
    before = list(counts)
    c.mdi("G4 P1000000")
    killer = threading.Timer(0.3, signal.pthread_kill, (threading.main_thread().ident, number))
    killer.start()
    try:
        print(name, c.wait_complete(900000))
    except what as ended:
        print(f"{name} ends the wait: {type(ended).__name__}; the others polled meanwhile:",
              all(a > b for a, b in zip(counts, before)))
    killer.join()
    c.abort()
    print("and goes on:", c.wait_complete(), mdi("G0 X1"), poll().position[0])
stop.set()
for thread in threads:
    thread.join()
print("mistakes:", wrong)
