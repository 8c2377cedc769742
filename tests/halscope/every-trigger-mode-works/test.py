"""A component of this program makes values, one step each millisecond."""
from bench import acquire, clock, comp, hal, record, source, st

drive = hal.component("drive")
TYPES = (("bit", hal.HAL_BIT), ("float", hal.HAL_FLOAT), ("s32", hal.HAL_S32), ("u32", hal.HAL_U32),
         ("s64", hal.HAL_S64), ("u64", hal.HAL_U64))
for name, kind in TYPES:
    drive.newpin(name, kind, hal.HAL_OUT)
drive.newparam("par", hal.HAL_FLOAT, hal.HAL_RW)
drive.newpin("in", hal.HAL_FLOAT, hal.HAL_IN)
drive.newpin("port", hal.HAL_PORT, hal.HAL_IN)
drive.ready()
acq = acquire.Acquisition(comp, 1000)
acq.link("servo")
clock.run(["halcmd", "start"])


def ramp(name, values):
    """meanwhile(): the next value each time; the last one stays."""
    left = list(values)
    drive[name] = left[0]

    def step():
        drive[name] = left.pop(0) if len(left) > 1 else left[0]
    return step


def show(what, r, number=1):
    if r is None:
        print(what, "-> no record")
    else:
        v, t = r.values[number], r.trigger
        print(what, f"-> {r.count} samples, trigger {t}:", list(v[max(0, t - 1):t + 1]))


def settings(kind, name, level, rising=True, auto=False, pos=0.1, **more):
    s = st.Settings(run_mode=st.SINGLE)
    source(s, 1, kind, name, voff=level, **more)       # the level is in the middle of the screen
    s.trigger.source, s.trigger.rising, s.trigger.auto, s.trigger.pos = 1, rising, auto, pos
    return s


# Every type (FP-171: values of all widths lie in places of eight bytes).
wave = [0] * 200 + [1] * 50 + [0] * 400
for name, _kind in TYPES:
    for rising in (True, False):
        show(f"{name} {'rising' if rising else 'falling'}",
             record(acq, settings("pin", f"drive.{name}", 0.5, rising), 5, ramp(name, wave)))
show("negative", record(acq, settings("pin", "drive.s64", -4.5, True), 5, ramp("s64", [-5] * 200 + [-4] * 50)))
show("great", record(acq, settings("pin", "drive.u64", 1e18, True), 5, ramp("u64", [0] * 200 + [2**63] * 50)))
show("parameter", record(acq, settings("param", "drive.par", 0.5), 5, ramp("par", wave)))
show("level not reached", record(acq, settings("pin", "drive.float", 2.0), 5, ramp("float", wave)))
show("equal is not above", record(acq, settings("pin", "drive.float", 1.0), 5, ramp("float", wave)))
show("above from the start", record(acq, settings("pin", "drive.float", 0.5), 3, ramp("float", [1] * 10)))
show("auto", record(acq, settings("pin", "drive.float", 2.0, auto=True), 5, ramp("float", wave)))
s = settings("pin", "drive.float", 2.0)
s.trigger.source = 0
show("no source", record(acq, s, 3, ramp("float", wave)))
s.trigger.auto = True
show("no source, auto", record(acq, s, 5, ramp("float", wave)))
forced = settings("pin", "drive.float", 2.0)
show("forced", record(acq, forced, 5, acq.force))
show("first sample", record(acq, settings("pin", "drive.float", 0.5, pos=0.0), 5, ramp("float", wave)))
show("last sample", record(acq, settings("pin", "drive.float", 0.5, pos=1.0), 9, ramp("float", [0] * 1200 + [1] * 50)))

# The level is where the line on the screen is: 2 divisions above the baseline of a channel of 5 a division.
s = settings("pin", "drive.float", 0.0)
c = s.channel(1)
c.vscale, c.vpos, s.trigger.level = 2, 0.7, 0.5
print("scale", st.scale(c.vscale), "level", round(st.trigger_level(c, s.trigger.level), 9))
show("level from the screen", record(acq, s, 5, ramp("float", [9.9] * 200 + [10.1] * 50)))

# A pin that is linked meanwhile is followed to its signal.
s = settings("pin", "drive.in", 0.5)
count = iter(range(10000))


def link():
    if next(count) == 50:
        hal.new_sig("s", hal.HAL_FLOAT), hal.connect("drive.in", "s"), hal.connect("drive.float", "s")
    step()


step = ramp("float", wave)
show("linked meanwhile", record(acq, s, 5, link))
print("port", acquire.source_type("pin", "drive.port"), "none", acquire.source_type("sig", "none"))
drive.exit()
show("source is gone", record(acq, settings("pin", "drive.float", 0.5, auto=True), 5))
for what, f in (("thread", lambda: acq.link("none")), ("channels", lambda: acq.start(st.Settings()))):
    try:
        f()
    except acquire.ScopeError as e:
        print(what, "->", str(e).splitlines()[-1])
print("linked", acquire.linked_thread())
comp.exit()
