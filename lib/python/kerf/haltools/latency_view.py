# SPDX-License-Identifier: GPL-2.0-or-later
"""Windows of latency-histogram and hal-histogram: bars on a canvas. Tk only reads models."""

import math
import tkinter as tk

WIDTH, HEIGHT, MARGIN = 720, 240, 30   # pixels of one chart
PERIOD_MS = 1000                       # between two looks at the model


def bar_heights(counts: list[int], height: float, logarithmic: bool) -> list[float]:
    """Heights of bars in pixels: the largest count has the full height."""
    top = max(counts, default=0)
    if top == 0:
        return [0.0] * len(counts)
    if logarithmic:
        scale = math.log10(top + 1)
        return [height * math.log10(c + 1) / scale for c in counts]
    return [height * c / top for c in counts]


class Chart(tk.Canvas):
    """Bars with a scale below; title and figures above."""

    def __init__(self, parent, title: str):
        super().__init__(parent, width=WIDTH, height=HEIGHT, background="white")
        self.title = title

    def draw(self, counts: list[int], low: float, high: float, unit: str, text: str, logarithmic: bool):
        """counts from low to high (same unit)."""
        self.delete("all")
        width, height = self.winfo_width() or WIDTH, self.winfo_height() or HEIGHT
        floor, ceiling = height - MARGIN, MARGIN
        self.create_text(8, 10, anchor="w", text=f"{self.title}   {text}")
        if not counts:
            return
        step = (width - 2 * MARGIN) / len(counts)
        for i, h in enumerate(bar_heights(counts, floor - ceiling, logarithmic)):
            if h > 0:
                x = MARGIN + i * step
                self.create_rectangle(x, floor - h, x + max(step, 1), floor, fill="#2563a8", width=0)
        self.create_line(MARGIN, floor, width - MARGIN, floor)
        for part in range(5):
            x = MARGIN + part * (width - 2 * MARGIN) / 4
            value = low + part * (high - low) / 4
            self.create_line(x, floor, x, floor + 4)
            self.create_text(x, floor + 14, text=f"{value:g} {unit}")


def run_window(title: str, banner: str, note: str, charts: list[str], refresh, reset, seconds: int = 0):
    """A window with charts; refresh(charts) is called each second until it is closed."""
    root = tk.Tk()
    root.title(title)
    tk.Label(root, text=banner, anchor="w", justify="left").pack(fill="x")
    if note:
        tk.Label(root, text=note, anchor="w").pack(fill="x")
    drawn = []
    for name in charts:
        chart = Chart(root, name)
        chart.pack(fill="both", expand=True)
        drawn.append(chart)
    buttons = tk.Frame(root)
    buttons.pack(fill="x")
    tk.Button(buttons, text="Reset", command=reset).pack(side="left")
    tk.Button(buttons, text="Quit", command=root.destroy).pack(side="right")

    def tick():
        refresh(drawn)
        root.after(PERIOD_MS, tick)

    root.after(PERIOD_MS, tick)
    if seconds:
        root.after(seconds * 1000 + PERIOD_MS // 2, root.destroy)
    root.mainloop()


def show_histograms(meter, o, platform):
    """The window of latency-histogram."""

    def refresh(charts):
        meter.read()
        for chart, t in zip(charts, meter.figures):
            if not t.counts:
                continue
            low, *counts, high = t.counts
            edge = t.bins * t.bin_ns / 1e3
            text = t.line(0)[8:].strip()
            if o.show:
                text += f"   below: {low} above: {high}"
            chart.draw(counts, -edge, edge, "us", text, bool(o.logscale))

    run_window("latency-histogram", platform.banner(), o.text, [f"{t.thread} ({t.period_ns} ns)" for t in meter.figures],
               refresh, meter.reset, o.seconds)
