"""Runs halscope with an operator inside of it: steps that wait until they have come true."""
import sys
import time
import traceback

import kerf.halscope.main
import kerf.halscope.screen as screen
from kerf.halscope import acquire, settings as st

told = []
answers = []
screen.messagebox.showerror = lambda title, text, **_k: told.append((title, text))
screen.messagebox.showinfo = lambda title, text, **_k: told.append((title, text.splitlines()[0]))
screen.messagebox.askyesno = lambda title, text, **_k: (told.append((title, text)), answers.pop(0))[1]


class Operated(screen.Screen):
    def __init__(self, *args):
        super().__init__(*args)
        steps = operate(self)

        def go(condition=None, end=0.0):
            try:
                if condition and not condition():
                    if time.monotonic() > end:
                        print("never came true: line", steps.gi_frame.f_lineno)
                        self.quit()
                        return
                    self.root.after(20, lambda: go(condition, end))
                    return
                condition = next(steps)
                self.root.after(20, lambda: go(condition, time.monotonic() + 30))
            except StopIteration:
                pass
            except BaseException:
                traceback.print_exc()
                self.quit()
        self.root.after(50, go)


def click(s, x, y, to=None, state=0, button=1):
    """A press at a place of the display, a drag, a release."""
    s.root.update()
    if s.display._pending:
        s.display.after_cancel(s.display._pending)
        s.display.draw()
    s.display.event_generate(f"<ButtonPress-{button}>", x=x, y=y, state=state)
    for place in to or ():
        s.display.event_generate("<Motion>", x=place[0], y=place[1], state=state | (0x80 << button))
    s.display.event_generate(f"<ButtonRelease-{button}>", x=x, y=y, state=state)


def operate(s):
    settings = s.settings
    yield lambda: s.dialog is not None and s.dialog.winfo_exists()
    d = s.dialog
    print(d.title(), "|", [name for name, _ in d._threads], d.period_text.get(), d.rate_text.get())
    d.mult.set("0")
    d.accept()
    d.mult.set("2")
    print(told.pop() if told else "no complaint", d.period_text.get(), d.rate_text.get(), d.lengths[1][1].cget("text"))
    d.mult.set("1")
    d.accept()
    print("linked", acquire.linked_thread(), s.horizontal.rate.cget("text").split("\n"),
          s.horizontal.per_div.cget("text"))

    s.run_mode.buttons[st.NORMAL].invoke()
    print(told.pop(), settings.run_mode)
    s.channels.buttons[0].invoke()
    yield lambda: s.picker.winfo_exists()
    print(s.picker.title(), [s.picker.book.tab(i, "text") for i in range(3)])
    s.picker.filter.set("0.SINE")
    s.picker.accept()
    s.channels.buttons[1].invoke()
    s.picker.book.select(1)
    s.picker.choose("square")
    s.picker.accept()
    s.set_source(3, "pin", "and2.0.out")
    s.set_source(4, "param", "siggen.0.update.tmax")
    print([(c.kind, c.name, c.type) for c in settings.channels[:4]], "selected", settings.selected,
          s.horizontal.rate.cget("text").split("\n"))
    settings.channel(2).vpos, settings.channel(3).vpos = 0.2, 0.9

    s.channels.buttons[3].invoke()                       # the selected one: off
    print("off", settings.enabled(), settings.selected)
    s.channels.buttons[0].invoke()
    print("selected", settings.selected, s.channels.name.cget("text"), s.vertical.scale.cget("text"))
    s.set_trigger_source(1)
    s.trigger.mode.invoke()
    s.trigger.edge.invoke()
    print("trigger", s.trigger.source.cget("text"), s.trigger.mode.cget("text"), s.trigger.edge.cget("text"),
          s.trigger.text.cget("text"))
    s.run_mode.buttons[st.SINGLE].invoke()
    yield lambda: s.record is not None and settings.run_mode == st.STOP
    r = s.record
    v, t = r.values[1], r.trigger
    print("single", r.count, r.period, sorted(r.values), "falling edge", v[t - 1] > 0 >= v[t])

    # The mouse: select, scale, level, baseline, zoom, position, edge.
    settings.zoom = 5
    s.changed()
    s.root.update()
    width, height = s.display.size
    yield lambda: s.display._spans.get(2)
    x = width // 2 + 40
    top, bottom = s.display._spans[2][x]
    click(s, x, round((top + bottom) / 2))
    print("clicked trace", settings.selected)
    before = settings.channel(2).vscale
    y = round((top + bottom) / 2)
    away = 1 if y > settings.channel(2).vpos * height else -1
    click(s, x, y, [(x, y + away * 6), (x, y + away * 12)])
    print("dragged away from its baseline", settings.channel(2).vscale - before)
    click(s, 5, round(0.9 * height), [(5, round(0.7 * height) + 1)])
    print("baseline", settings.selected, settings.channel(3).vpos)
    click(s, width - 30, round(settings.trigger.level * height), [(width - 30, round(0.4 * height))])
    print("level", settings.trigger.level)
    click(s, width - 30, 60, [(width - 30, round(0.45 * height))], state=4)
    print("level with Control", settings.trigger.level)
    click(s, width - 30, 60, [(width - 30, round(0.6 * height))], state=1)
    print("baseline with Shift", settings.channel(3).vpos)
    mark = s.display._trigger_mark(s.display.horizontal())
    click(s, round(mark[0]), round(mark[1]))
    print("edge", s.trigger.edge.cget("text"))
    click(s, width - 30, height - 3)
    print("nothing there", settings.selected)
    s.select(1)
    h = s.display.horizontal()
    sample = h.sample(100)
    s.display.event_generate("<Button-4>", x=100, y=50)
    print("zoomed", settings.zoom, abs(s.display.horizontal().sample(100) - sample) < 1e-6)
    s.display.event_generate("<Button-5>", x=100, y=50)
    before = s.display.horizontal().sample(0)
    click(s, 200, 50, [(300, 50)], button=2)
    print("moved", round((before - s.display.horizontal().sample(0)) / h.step))
    s.display.event_generate("<Motion>", x=width // 2, y=40)
    s.root.update()
    text = [s.display.itemcget(i, "text") for i in s.display.find_withtag("readout") if s.display.type(i) == "text"]
    found = s.display.readout(width // 2)
    print("readout", text == ["f(% 8.5f) = % 8.5f (ddt % 8.5f)" % found])

    def words(tag):
        s.root.update()
        return [s.display.itemcget(i, "text") for i in s.display.find_withtag(tag) if s.display.type(i) == "text"]
    click(s, width // 2 + 100, 40, button=3)
    s.display.event_generate("<Motion>", x=width // 2, y=40)
    found, other = s.display.readout(width // 2), s.display.readout(width // 2 + 100)
    line = words("readout")[0].split("\n")[1].split()
    print("second cursor", line[:3], abs(float(line[3]) - (found[0] - other[0])) < 1e-6,
          abs(float(line[-1]) - (found[1] - other[1])) < 1e-4)
    click(s, width // 2 + 102, 40, button=3)
    print("gone", [t.count("\n") for t in words("readout")])
    settings.zoom = 1
    s.changed()
    print("measured", words("measured")[0].split("mean")[0], words("measured")[0].split()[-2:])

    # Sliders and the offset.
    s.vertical._set_gain(3.2)
    s.vertical._set_pos(0.3)
    s.vertical.offset.invoke()
    s.dialog.offset.set("x")
    s.dialog.accept()
    s.dialog.offset.set("1,5")
    s.dialog.ac.set(True)
    s.dialog.accept()
    c = settings.channel(1)
    print(told.pop(), c.vscale, c.vpos, c.voff, c.ac, s.vertical.scale.cget("text"), s.vertical.offset.cget("text"))
    s.vertical.coupled.invoke()
    c.voff, c.vpos, c.vscale, settings.trigger.level = 0.0, 0.5, 0, 0.5
    s.changed()

    # Files and prompts.
    s.write_log("log.csv")
    whole = [list(v) for v in s.record.values.values()]
    s.load_log("nothing.csv")
    print(told.pop())
    s.load_log("log.csv")
    same = all(abs(a - b) < 1e-14 for x, y in zip(whole, s.record.values.values()) for a, b in zip(x, y))
    print("log", s.state_text(), same, [(c.kind, c.name) for c in settings.channels[:3]])
    with open("foreign.csv", "w") as f:
        f.write("# Sampling period is 1000 ns\nsiggen.0.sine;far.away\n1;2\n2;3\n")
    s.load_log("foreign.csv")
    print([(c.kind, c.name) for c in settings.channels[:2]], s.record.count)
    answers.append(False)
    s.run_mode.buttons[st.ROLL].invoke()
    print(told.pop(), settings.run_mode, s.log)
    answers.append(True)
    s.run_mode.buttons[st.ROLL].invoke()
    yield lambda: s.record is not None and s.record.count > 100
    print("roll", told.pop()[1], settings.run_mode, s.log, settings.shown(), s.state_text())
    s.run_mode.buttons[st.STOP].invoke()
    yield lambda: s.acq.idle

    with open("my.halscope", "w") as f:
        f.write("THREAD base\nHMULT 2\nCHAN 5\nPIN siggen.0.cosine\nVSCALE 1\nPIN nothing\nCHAN 6\nSIG square\n"
                "TSOURCE 5\nTMODE 0\nRMODE 1\n")
    s.load_configuration("my.halscope")
    settings = s.settings
    print("configuration", acquire.linked_thread(), settings.mult, settings.enabled(), settings.run_mode, s.period)
    yield lambda: s.record is not None and sorted(s.record.values) == [5, 6]
    print("normal", s.record.period,
          s.record.values[5][s.record.trigger - 1] <= 0 < s.record.values[5][s.record.trigger])
    s.force()
    s.ask_rate()
    s.dialog.samples.set("20000")
    s.dialog.accept()
    print(told.pop(), settings.samples)
    s.select(6)
    bar = s.root.nametowidget(s.root["menu"])
    s.root.nametowidget(bar.entrycget("File", "menu")).invoke("Quit")


screen.Screen = Operated
sys.exit(kerf.halscope.main.main(["4000"]))
