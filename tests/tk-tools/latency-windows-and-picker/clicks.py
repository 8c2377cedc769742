from types import SimpleNamespace

from kerf import pickconfig, tkstyle
from kerf.haltools import latency_view
from kerf.haltools.latency import ThreadFigures
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
platform = SimpleNamespace(realtime="PREEMPT_RT", is_realtime=True, virtual_clock=False, governors=["performance"], isolated="2-3")
root = tkstyle.open_display("latency-histogram", "Test")
window = latency_view.Histograms(root, "latency-histogram", ["a processor"], "a note", ["servo thread (1000000 ns)"],
                                 latency_view.latency_bars(meter, True), meter.reset, True, 20, platform)
hand = Hand(root)
chart = window.charts[0]


def bars():
    window.show()
    heights = [chart.coords(i)[3] - chart.coords(i)[1] for i in chart.find_withtag("bar")]
    return len(chart.bars.counts), chart.bars.counts[0], chart.bars.counts[-1], len(heights), round(heights[0] / max(heights), 2)


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

root = tkstyle.open_display("latency-plot", "Test")
strip = latency_view.Strip(root, tkstyle.apply(root), "servo", 300)
strip.pack()
root.update()
strip.show([10, 40, 20], "last 20 ns")
points = strip.coords("line")
print("strip:", len(points) // 2, points[3] == min(points[1::2]), strip.itemcget("figures", "text"))
root.destroy()


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
hand.key("Escape")
print("Escape:", p.chosen)
root, p, hand, ids = picker()
hand.click(p.ok)
print("OK:", p.chosen.name)
