#!/usr/bin/python3
"""A program that waits for its spindle, its tools and a program of its own runs twice: the
second time the run time is right."""
import ast
import configparser
import os
import sys
from pathlib import Path

import linuxcnc
import operator_lib as lib
from axis import dialogs
from kerf import clock

TITLES = ("Tool changes:", "Spindle starts:", "User M codes:", "Waits for inputs (M66):", "Stops (M0, M1):")


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app = op.app
    op.power_on()
    op.home()

    def properties(when):
        told = []
        dialogs.ask = lambda root, title, question, *rest, **_: told.append(question)
        app.commands.gcode_properties()
        op.answer(0)
        print(when, *(line for line in told[0].splitlines() if line.startswith(TITLES)), sep="\n  ")

    def load(name):
        op.app.open_file_guts(name)
        app.estimate.wait()
        op.wait(0.1)

    def run():
        told, begin = app.estimate.total, clock.now()
        op.key("r")
        op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE, "the start")
        op.idle()
        taken = clock.now() - begin
        op.wait(1)
        app.estimate.wait()
        op.wait(0.1)
        return told / taken - 1

    load(os.environ["PART"])
    properties("before")
    print("first run: told too little:", run() < -0.1)
    properties("after a run")
    op.wait(5)
    error = run()
    print("second run: within 5 %:", True if abs(error) < 0.05 else error)
    load(os.environ["ASKS"])
    properties("what cannot be known")
    kept = configparser.RawConfigParser()
    kept.read(Path.home() / ".axis_preferences")
    print("remembered by machine:",
          {os.path.basename(k): sorted(v) for k, v in ast.literal_eval(kept.get("DEFAULT", "waits")).items()})


lib.run(script)
