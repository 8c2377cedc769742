# Every tool in a process of its own: thousands of looks at values that change. What leaks grows with each look.
import os
import random
import sys
from pathlib import Path
from types import SimpleNamespace

LOOKS = int(os.environ.get("LOOKS", 360)) // 3     # of one part
MOST = 8                # parts of the looks, three at least
TOLERANCE_KB = 100      # of one part: what is touched for the first time comes once, what leaks comes in every part


def private_kb():
    lines = Path("/proc/self/smaps_rollup").read_text().splitlines()
    return sum(int(line.split()[1]) for line in lines if line.startswith(("Private_Dirty:", "Swap:")))


def change(n):
    import hal
    hal.set_s("freebit", n % 2)
    hal.set_s("count", random.randrange(10 ** 9))
    hal.set_s("real", random.uniform(-1e6, 1e6))


def halshow(root):
    from kerf.tktools.halshow import Preferences, Window
    window = Window(root, Preferences(None))
    window.add_words(["sig+freebit", "sig+count", "sig+real", "pin+siggen.0.sine", "param+siggen.0.update.tmax",
                      "pin+and2.0.in0"])
    window.book.select(window.view)
    yield
    while True:
        window.view.update_values()
        yield


def halmeter(root):
    from kerf.tktools.halmeter import Window
    window = Window(root, False, "sig", "real", None)
    yield
    while True:
        window.show()
        yield


def halscope(root):
    import hal
    from kerf import tkstyle
    from kerf.halscope import acquire, settings as st
    from kerf.halscope.screen import Screen
    component = hal.component("halscope")
    component.ready()
    acq = acquire.Acquisition(component, 1000)
    acq.link("servo-thread")
    settings = st.Settings(thread="servo-thread")
    screen = Screen(root, settings, acq, tkstyle.apply(root))
    for n, (kind, name) in enumerate((("pin", "siggen.0.sine"), ("sig", "real")), 1):
        screen.set_source(n, kind, name)
    screen.set_run_mode(st.NORMAL)
    yield
    for n in range(1 << 60):        # records as fast as they come, drawn and measured
        values = [acquire.array("d", (random.random() for _ in range(500))) for _ in range(2)]
        screen.record = acquire.Record(1000000, 250, 500, dict(zip((1, 2), values)))
        screen._fetch()
        screen.changed()
        yield


def histogram(root):
    from kerf.haltools.latency_view import Bars, Histograms
    platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"],
                               isolated="2-3")

    def read(bins):
        return [Bars([random.randrange(10 ** 6) for _ in range(401)], -20, 20, "us", f"sdev {random.random()}")
                for _ in range(2)]
    window = Histograms(root, "latency-histogram", ["processor"], "", ["base", "servo"], read, lambda: None, True,
                        200, platform)
    yield
    while True:
        window.show()
        yield


def latency_test(root):
    import hal
    from kerf.haltools import latency_panel
    from kerf.haltools.session import Platform
    component = latency_panel.make_component(hal)
    worst = latency_panel.Worst("bs")
    window = latency_panel.Window(root, component, worst, {"s": "servo", "b": "base"},
                                  {"s": 1000000, "b": 25000}, Platform())
    root.after = lambda *_: None        # the looks are ours
    yield
    while True:
        hal.set_p("lat.sl", random.randrange(10 ** 6))
        window.tick()
        yield


def tooledit(root):
    from kerf.tktools.tooledit import Table, Window
    path = Path("tool.tbl")
    path.write_text("".join(f"T{n} P{n} Z{n} D{n} ;tool {n}\n" for n in range(1, 200)))
    window = Window(root, Table(path), ["Z", "D"], "rc")
    yield
    for n in range(1 << 60):
        window.look()
        if n % 10 == 0:
            path.touch()
            window.reread()
        yield


def sim_pin(root):
    sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "src/hal/user_comps"))
    import sim_pin as program
    window = program.Window(root, "Pins",
                            [(program.Item("freebit"), "toggle", True), (program.Item("count"), "toggle", True),
                             (program.Item("real"), "toggle", True)])
    yield
    while True:
        for row in window.rows:
            row.update()
        yield


def changer(root):
    import hal
    from kerf.tktools.hal_manualtoolchange import Exchange, Window, make_component
    window = Window(root, Exchange(make_component(),
                                   sleep=lambda seconds: hal.set_p("hal_manualtoolchange.change", "0")))
    yield
    for n in range(1 << 60):
        hal.set_p("hal_manualtoolchange.number", str(n % 50))
        hal.set_p("hal_manualtoolchange.change", str(int(n % 4 > 1)))
        window.tick()
        if n % 4 == 3:
            window.confirm()
        if n % 8:               # two exchanges to a look: a dialog that is made anew leaves half a kB
            root.update()
        else:
            yield


PROGRAMS = {"halshow": halshow, "halmeter": halmeter, "halscope": halscope, "latency-histogram": histogram,
            "latency-test": latency_test, "tooledit": tooledit, "sim_pin": sim_pin, "hal_manualtoolchange": changer}


def look(name):
    from kerf import tkstyle
    root = tkstyle.open_display(name, "Test")
    steps = PROGRAMS[name](root)
    next(steps)
    sizes, flat = [], False
    for n in range(1, MOST * LOOKS + 1):
        change(n)
        next(steps)
        root.update()
        if n % LOOKS == 0:
            sizes.append(private_kb())
            flat = len(sizes) >= 3 and sizes[-1] - sizes[-2] <= TOLERANCE_KB
            if flat:
                break
    if "LOOKS" in os.environ:
        print(name, n, "looks, kB after each part:", sizes, flush=True)
    print(f"{name} {'keeps its size' if flat else 'grows ' + str(sizes)}", flush=True)


for name in sys.argv[1:] or PROGRAMS:
    child = os.fork()
    if not child:
        status = 1
        try:
            look(name)
            status = 0
        except BaseException:
            import traceback
            traceback.print_exc()
        sys.stdout.flush()
        os._exit(status)
    os.waitpid(child, 0)
