# SPDX-License-Identifier: GPL-2.0-or-later
# FP-084: a changer that answers late, early, twice or not at all, and stops of each kind, reloads of the table and
# offsets at any moment of a change, with 1000 tools. Status, pins, shared data and file agree after each step; every
# tool stays in exactly one pocket; the tool in the spindle changes only when the changer has said so.
import os
import random

import hal
from mill import *

SEED, STEPS, TOOLS = int(os.environ.get("SEED", "7")), int(os.environ.get("STEPS", "150")), 1000
R = random.Random(SEED)
is_random = "RANDOM_TOOLCHANGER = 1" in open("mill.ini").read()
first = 0 if is_random else 1
with open("mill.tbl", "w") as f:
    for pocket in range(first, first + TOOLS):
        f.write(f"T{10000 - 7 * pocket} P{pocket} D{pocket / 100:.2f} Z{pocket / 10:.1f} ;tool of pocket {pocket}\n")
tools = [10000 - 7 * pocket for pocket in range(first, first + TOOLS)]
changer = hal.component("changer")
changer.newpin("prepared", hal.HAL_BIT, hal.HAL_OUT)
changer.newpin("changed", hal.HAL_BIT, hal.HAL_OUT)
changer.ready()
halcmd("net", "prepared", "changer.prepared", "iocontrol.0.tool-prepared")
halcmd("net", "changed", "changer.changed", "iocontrol.0.tool-changed")
get = hal.get_value


def wrong(what, *more):
    raise SystemExit(f"seed {SEED} step {step}: {what} {more}: T{s.tool_in_spindle} prepared "
                     f"{s.pocket_prepped} {messages()}")


def shared():
    return {(tool.id, pocket) for pocket, tool in enumerate(s.tool_table) if pocket >= first}


def kept():
    return {(int(l.split()[0][1:]), int(l.split()[1][1:])) for l in open("mill.tbl")}


def agree():
    poll()
    spindle = s.tool_table[0].id
    if get("iocontrol.0.tool-number") != s.tool_in_spindle:
        wrong("pin", get("iocontrol.0.tool-number"))
    if spindle != s.tool_in_spindle and not (spindle == -1 and s.tool_in_spindle == 0):
        wrong("record of the spindle", spindle)
    if s.interp_state == INTERP_IDLE and (get("iocontrol.0.tool-change") or get("iocontrol.0.tool-prepare")):
        wrong("a request stays")
    if is_random:
        if sorted(t for t, _ in kept()) != sorted(tools) or shared() != kept():
            wrong("tools", len(kept()), sorted(shared() ^ kept())[:6])
    elif kept() != original or shared() != original:
        wrong("the file", sorted(kept() ^ original)[:6])


step = -1
on()
c.load_tool_table()
c.wait_complete()
original = kept()
messages()
if is_random:
    mdi(f"M61 Q{tools[0]}")
STOPS = {"abort": c.abort, "manual": lambda: c.mode(MODE_MANUAL), "auto": lambda: c.mode(MODE_AUTO),
         "off": lambda: c.state(STATE_OFF), "estop": lambda: c.state(STATE_ESTOP), "mode": lambda: c.mode(MODE_MDI)}
done = dict.fromkeys(list(STOPS) + ["changed", "reload", "offset", "set", "same"], 0)
for step in range(STEPS):
    if poll().task_state != STATE_ON:
        on(home=False)
    mode(MODE_MDI)
    agree()
    before, confirmed, wish = s.tool_in_spindle, False, R.choice(tools[:60] if R.random() < 0.5 else tools)
    what = R.random()
    if what < 0.1:
        c.load_tool_table()
        done["reload"] += c.wait_complete() == 1
        continue
    if what < 0.2:
        done["offset"] += mdi(f"G10 L1 P{wish} Z{R.randint(1, 99)}") == 1
        continue
    if what < 0.25:
        done["set"] += mdi(f"M61 Q{wish}") == 1
        if poll().tool_in_spindle != wish:
            wrong("M61", wish)
        continue
    # ms of the changer, 0: already on before it is asked
    prepare, change = (R.choice((0, 0, 1, 3, 10, 40)) for _ in "12")
    mute, stop_at = R.random() < 0.15, R.randint(0, 60) if R.random() < 0.6 else None
    stop = R.choice(list(STOPS))
    asked = {"prepare": None, "change": None}
    for line in R.choice(([f"T{wish} M6"], [f"T{wish}", "M6"],
                          [f"T{R.choice(tools)}", f"T{wish}", "G4 P0.01", "M6", "G43"])):
        c.mdi(line)
    for ms in range(200):
        for name, delay, answer in (("prepare", prepare, "prepared"), ("change", change, "changed")):
            on_now = get(f"iocontrol.0.tool-{name}")
            if on_now and asked[name] is None:
                asked[name] = ms
            if not on_now:
                asked[name] = None
            changer[answer] = not mute and (delay == 0 or (asked[name] is not None and ms - asked[name] >= delay))
        confirmed = confirmed or changer["changed"]
        if ms == stop_at or (mute and ms == 150):
            STOPS[stop]()
            done[stop] += 1
            # the change that was asked for stays so until it is answered or aborted
            if stop in ("manual", "auto", "mode"):
                sleep(0.02)
                if R.random() < 0.5:
                    c.abort()
                else:
                    confirmed = True
                    changer["prepared"] = changer["changed"] = True
            sleep(0.05)
            break
        sleep(0.001)
        if poll().interp_state == INTERP_IDLE and not s.queued_mdi_commands and c.wait_complete(0) == 1:
            if s.tool_in_spindle != wish:
                wrong("not the tool that was called", wish)
            done["changed" if before != wish else "same"] += 1
            break
    else:
        wrong("never done", wish)
    changer["prepared"] = changer["changed"] = False
    if poll().tool_in_spindle not in ((before, wish) if confirmed or before == wish else (before,)):
        wrong("the spindle's tool changed without the changer", before, wish)
    if s.interp_state != INTERP_IDLE and not until(lambda s: s.interp_state == INTERP_IDLE, 1):
        wrong("still at it", stop)
    messages()
step += 1
if poll().task_state != STATE_ON:
    on(home=False)
agree()
print("random" if is_random else "fixed", done, "spindle", s.spindle[0]["enabled"])
