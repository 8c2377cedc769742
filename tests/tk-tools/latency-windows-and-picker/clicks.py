import time
from types import SimpleNamespace

from kerf import pickconfig, tkstyle
from kerf.haltools import latency_plot, latency_view, strip_chart
from kerf.haltools.latency import ThreadFigures
from kerf.haltools.session import ToolError
from kerf.tree import Tree
from tk_hand import Hand


class Meter:
    """What latency-histogram measures: 20 bins on each side, tails beyond."""

    def __init__(self):
        self.figures, self.resets = [ThreadFigures("servo", 1000000, 100, 20)], 0
        self.figures[0].update(-1500, 2500, 100.0, [3] + [1] * 20 + [1000] + [2] * 20 + [7])

    def read(self):
        pass

    def reset(self):
        self.resets += 1


meter = Meter()
platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"],
                           isolated="2-3")
root = tkstyle.open_display("latency-histogram", "Test")
window = latency_view.Histograms(root, "latency-histogram", ["a processor"], "a note", ["servo thread (1000000 ns)"],
                                 latency_view.latency_bars(meter, True), meter.reset, True, 20, platform)
hand = Hand(root)
chart = window.charts[0]


def bars():
    window.show()
    heights = [chart.coords(i)[3] - chart.coords(i)[1] for i in chart.find_withtag("bar")]
    return (len(chart.bars.counts), chart.bars.counts[0], chart.bars.counts[-1], len(heights),
            round(heights[0] / max(heights), 2))


print(bars(), chart.bars.low, chart.bars.high, chart.itemcget("figures", "text"))
print("choices:", list(window.radios))
hand.click(window.radios[5], x=8)
print(bars(), chart.bars.low, chart.bars.high)
hand.click(window.log_box, x=8)
print("linear:", bars())
hand.click(window.buttons["Reset"])
print("resets:", meter.resets, window.elapsed.cget("text"))
print("end bars:", latency_view.gathered([1, 2, 3, 4, 5, 6, 7], 1), latency_view.gathered([1, 2, 3], 5))
hand.click(window.buttons["Exit"])


def ended(run, *arguments):
    """A window whose figures go: it does not stay as if all were well."""
    try:
        run(*arguments)
        print("closed")
    except ToolError as problem:
        print("ended:", problem)


# as hal.get_p() when its component was unloaded
meter.read = lambda: meter.figures[0].update(None, None, None, None)
latency_view.PERIOD_MS = 10
root = tkstyle.open_display("latency-histogram", "Test")
ended(latency_view.run, latency_view.Histograms(root, "latency-histogram", [], "", ["servo"],
                                                latency_view.latency_bars(meter, True), meter.reset), 0)


class Trace:
    """What latency-plot measures: a second between two looks."""

    def __init__(self, *latencies):
        self.threads, self.start, self.count, self.latencies, self.worst, self.rows = [("servo", 1000000)], 86400.0, 0, latencies, 0, {"servo": []}

    def sample(self):
        latency = self.latencies[self.count % len(self.latencies)]
        self.count, self.worst = self.count + 1, max(self.worst, latency)
        self.rows["servo"].append((self.start + self.count, latency, self.worst))

    def reset(self):
        self.worst = 0


root = tkstyle.open_display("latency-plot", "Test")
trace = Trace(10, 40, 20)
plot = strip_chart.Plot(root, trace, latency_plot.options(["--hal", "-t", "10000"]), "a machine")
hand, strip = Hand(root), plot.strips["servo"]
for _ in range(3):
    trace.sample()
plot.show()
root.update()


def lines():
    found = [strip.coords(tag) for tag in ("line", "largest")]
    heights = [[round(y) for y in points[1::2]] for points in found]
    return ([[h.index(min(h)), len(h)] for h in heights], strip.itemcget("figures", "text"),
            [strip.itemcget(i, "text") for i in strip.find_withtag("time")])


print("plot:", *lines())
hand.click(plot.clock_box, x=8)
print("time of day:", lines()[2] == [time.strftime("%H:%M:%S", time.localtime(86401))])
hand.click(plot.buttons["Reset"])
trace.sample()
plot.show()
print("reset:", lines()[1])
for _ in range(7):
    hand.click(plot.buttons["-"])
print("points:", plot.count.cget("text"))
for _ in range(20):
    trace.sample()
plot.show()
print("moves on:", lines()[0][0][1])
hand.click(plot.buttons["+"])
print("points:", plot.count.cget("text"))
plot.close()
trace.latencies = []
options = latency_plot.options(["--hal", "-t", "100"])
options.time = 10
ended(strip_chart.show_strips, trace, options, "a machine")
print([latency_plot.options(words).relative
       for words in ([], ["--relative"], ["--actual", "-H", "-b", "50000", "-s", "2000000"])])


def picker():
    root = tkstyle.open_display("pickconfig", "Test")
    p = pickconfig.Picker(root, Tree.find())
    hand = Hand(root)
    ids = {p.list.item(i, "text"): i for i in p.paths}
    return root, p, hand, ids


pickconfig.configs.needs_copy = lambda *a: False
root, p, hand, ids = picker()
print(root.title(), p.selected().name, str(p.ok.cget("state")), len(p.text.get("1.0", "end")) > 20)
hand.row(p.list, ids["sim"])
print("a folder:", str(p.ok.cget("state")))
hand.key("Return")
print("still there:", bool(root.winfo_exists()), p.chosen)
hand.row(p.list, ids["mill"])
p.list.item(ids["mill"], open=True)
hand.row(p.list, ids["mill_inch"])
hand.key("Return")
print("Return:", p.chosen.name)
root, p, hand, ids = picker()
hand.row(p.list, ids["mill_inch"], times=2)
print("double click:", p.chosen and p.chosen.name)
root, p, hand, ids = picker()
item = ids["by_interface"]
p.list.see(item)
root.update()
x, y, width, height = p.list.bbox(item)
arrow = next(n for n in range(x, x + width) if p.list.identify_element(n, y + height // 2) == "Treeitem.indicator")
hand.click(p.list, x=arrow + 4, y=y + height // 2, times=2)
print("a folder's arrow, twice:", p.chosen, "selected", p.selected().name)
p.list.selection_set(ids["mill_inch"])
p.list.item(p.list.get_children()[-1], open=False)
root.update()
hand.click(p.list, x=60, y=p.list.winfo_height() - 8, times=2)
print("below the list, twice:", p.chosen)
hand.key("Escape")
print("Escape:", p.chosen)
root, p, hand, ids = picker()
hand.click(p.ok)
print("OK:", p.chosen.name)
