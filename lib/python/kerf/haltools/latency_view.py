# SPDX-License-Identifier: GPL-2.0-or-later
"""Windows of latency-histogram, hal-histogram and latency-plot: charts on canvases. They only read models."""

import math
import os
import shutil
import subprocess
import time
import tkinter as tk
from dataclasses import dataclass
from pathlib import Path
from tkinter import filedialog, ttk

from .. import tkstyle
from ..language import _, N_
from .session import facts, lost

WIDTH, HEIGHT, MARGIN = 720, 220, 30   # pixels of one chart on a usual screen
PERIOD_MS = 1000                       # between two looks at the model
BIN_CHOICES = (5, 10, 20, 50, 100, 200, 500)
GEARS = "glxgears"                     # a program that gives the computer work


def bar_heights(counts: list[int], height: float, logarithmic: bool) -> list[float]:
    """Heights of bars in pixels: the largest count has the full height."""
    top = max(counts, default=0)
    if top == 0:
        return [0.0] * len(counts)
    if logarithmic:
        scale = math.log10(top + 1)
        return [height * math.log10(c + 1) / scale for c in counts]
    return [height * c / top for c in counts]


def gathered(counts: list[int], bins: int) -> list[int]:
    """The middle bins; what is beyond is in the first and the last of them."""
    cut = max(0, (len(counts) - 1) // 2 - bins)
    if not cut:
        return list(counts)
    middle = counts[cut:-cut]
    middle[0] += sum(counts[:cut])
    middle[-1] += sum(counts[-cut:])
    return middle


@dataclass
class Bars:
    """What a chart shows: counts from low to high (in `unit`), figures above them."""
    counts: list
    low: float
    high: float
    unit: str
    text: str


class Chart(tk.Canvas):
    """Bars with a scale below; title and figures above."""

    def __init__(self, parent, style, title: str):
        super().__init__(parent, width=style.px(WIDTH), height=style.px(HEIGHT), background=style.colours["field"],
                         highlightthickness=1, highlightbackground=style.colours["line"])
        self.style, self.title, self.bars, self.logarithmic = style, title, None, True
        self.drawn, self.rectangles = None, []      # what decides on all but heights and figures; (item, height) of bars
        self.bind("<Configure>", lambda event: self.draw())

    def show(self, bars: Bars, logarithmic: bool):
        self.bars, self.logarithmic = bars, logarithmic
        self.draw()

    def draw(self):
        """What is as it was at the last look stays."""
        bars, width, height = self.bars, self.winfo_width(), self.winfo_height()
        frame = (width, height, bars and (len(bars.counts), bars.low, bars.high, bars.unit))
        if frame != self.drawn:
            self.drawn = frame
            self.delete("all")
            self.draw_frame(width, height)
        if bars:
            self.itemconfigure("figures", text=bars.text)
            self.itemconfigure("highest", text=_("highest bar: %d") % max(bars.counts, default=0))
            self.draw_bars(width, height)

    def draw_bars(self, width, height):
        margin, counts = self.style.px(MARGIN), self.bars.counts
        floor, step = height - margin, (width - 2 * margin) / max(1, len(counts))
        heights = bar_heights(counts, floor - self.style.px(2 * MARGIN), self.logarithmic)
        for i, h in enumerate(max(round(h), 1) if h > 0 else 0 for h in heights):
            item, before = self.rectangles[i]
            if h == before:
                continue
            x = margin + i * step
            if item and h:
                self.coords(item, x, floor - h, x + max(step, 1), floor)
            elif h:
                item = self.create_rectangle(x, floor - h, x + max(step, 1), floor, fill=self.style.colours["chart"],
                                             width=0, tags="bar")
            else:
                item = self.delete(item)
            self.rectangles[i] = item, h

    def draw_frame(self, width, height):
        """All but the bars."""
        px, ink, bars = self.style.px, self.style.colours["ink"], self.bars
        margin = px(MARGIN)
        floor = height - margin
        self.create_text(px(8), px(6), anchor="nw", text=self.title, font="TkDefaultFont", fill=ink, tags="title")
        if not bars:
            return
        self.rectangles = [(None, 0)] * len(bars.counts)
        self.create_text(px(8), px(26), anchor="nw", font="TkDefaultFont", fill=ink, tags="figures")
        self.create_text(width - px(8), px(6), anchor="ne", font="TkDefaultFont", fill=ink, tags="highest")
        self.create_line(margin, floor, width - margin, floor, fill=ink)
        for part in range(5):
            x = margin + part * (width - 2 * margin) / 4
            value = bars.low + part * (bars.high - bars.low) / 4
            self.create_line(x, floor, x, floor + px(4), fill=ink)
            self.create_text(x, floor + px(15), text=f"{value:g} {bars.unit}", font="TkDefaultFont", fill=ink)


class Histograms:
    """read(bins) gives the Bars of all charts; bins: those to show on each side of zero, None: all."""

    def __init__(self, root, title, lines, note, charts, read, reset, logarithmic=True, most_bins=0, platform=None):
        self.root, self.read, self.reset_model, self.gears, self.timer, self.trouble = root, read, reset, [], None, None
        style = self.style = tkstyle.apply(root)
        root.title(title)
        self.start = time.monotonic()
        if platform:
            self._footer(platform)
        self._controls(logarithmic)
        if most_bins:
            self._choice(most_bins)
        for text in list(lines) + ([note] if note else []):
            ttk.Label(root, text=text, anchor="w", justify="left", padding=(style.px(6), style.px(1))).pack(fill="x")
        self.charts = [Chart(root, style, name) for name in charts]
        for chart in self.charts:
            chart.pack(fill="both", expand=True, padx=style.px(4), pady=style.px(2))
        root.update_idletasks()
        tkstyle.centre(root, root.winfo_reqwidth(), root.winfo_reqheight(), (style.px(420), style.px(280)))
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.timer = root.after(PERIOD_MS, self.tick)

    def _footer(self, platform):
        """Cells with what decides whether the figures say anything."""
        row = ttk.Frame(self.root)
        row.pack(side="bottom", fill="x")
        good_facts = (platform.is_realtime and not platform.virtual_clock, platform.governors == ["performance"],
                      bool(platform.isolated))
        for text, good in zip(facts(platform), good_facts):
            ttk.Label(row, text=text, relief="sunken", padding=self.style.px(3), anchor="center",
                      foreground=self.style.colours["good" if good else "bad"]).pack(side="left", fill="x", expand=True)

    def _controls(self, logarithmic):
        px = self.style.px
        row = ttk.Frame(self.root, padding=px(4))
        row.pack(side="bottom", fill="x")
        self.log = tk.BooleanVar(self.root, logarithmic)
        self.buttons = {}

        def button(text, action):
            self.buttons[text] = ttk.Button(row, text=_(text), command=action)
            self.buttons[text].pack(side="left", padx=px(3))
        button(N_("Reset"), self.reset)
        self.log_box = ttk.Checkbutton(row, text=_("ylogscale"), variable=self.log, command=self.show)
        self.log_box.pack(side="left", padx=px(6))
        button(N_("Exit"), self.close)
        self.elapsed = ttk.Label(row, text=_("Elapsed Time: %d s") % 0)
        self.elapsed.pack(side="left", expand=True)
        button("Glxgears", self.start_gears)
        self.gear_count = ttk.Label(row, text="0", width=3)
        self.gear_count.pack(side="left")
        button(N_("Screenshot"), self.screenshot)

    def _choice(self, most):
        row = ttk.Frame(self.root, padding=(self.style.px(6), 0))
        row.pack(side="bottom", fill="x")
        ttk.Label(row, text=_("Display +/- bins:")).pack(side="left")
        self.bins = tk.IntVar(self.root, most)
        self.radios = {}
        for bins in sorted({b for b in BIN_CHOICES if b < most} | {most}):
            self.radios[bins] = ttk.Radiobutton(row, text=str(bins), value=bins, variable=self.bins, command=self.show)
            self.radios[bins].pack(side="left", padx=self.style.px(4))

    def reset(self):
        self.reset_model()
        self.start = time.monotonic()
        self.show()

    def show(self):
        bins = self.bins.get() if hasattr(self, "bins") else None
        for chart, bars in zip(self.charts, self.read(bins)):
            if bars:
                chart.show(bars, self.log.get())
        self.elapsed.configure(text=_("Elapsed Time: %d s") % int(time.monotonic() - self.start))

    def tick(self):
        try:
            self.show()
        except Exception as error:
            self.trouble = lost(error)
            self.close()
            return
        self.gears = [p for p in self.gears if p.poll() is None]
        self.gear_count.configure(text=str(len(self.gears)))
        self.timer = self.root.after(PERIOD_MS, self.tick)

    def start_gears(self):
        """One more program that draws."""
        if shutil.which(GEARS):
            self.gears.append(subprocess.Popen([GEARS], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                               stderr=subprocess.DEVNULL))
            self.gear_count.configure(text=str(len(self.gears)))
        else:
            self.buttons["Glxgears"].configure(state="disabled", text=_("no %s") % GEARS)

    def screenshot(self):
        folder = Path.home() / "Pictures"
        self.root.update()
        box = (self.root.winfo_rootx(), self.root.winfo_rooty(), self.root.winfo_rootx() + self.root.winfo_width(),
               self.root.winfo_rooty() + self.root.winfo_height())
        try:
            from PIL import ImageGrab
            picture = ImageGrab.grab(bbox=box, xdisplay=os.environ.get("DISPLAY"))
        except (ImportError, OSError) as error:
            self.elapsed.configure(text=_("no picture: %s") % error)
            return
        name = filedialog.asksaveasfilename(parent=self.root, initialdir=folder if folder.is_dir() else Path.home(),
                                            defaultextension=".png", initialfile=f"{self.root.title()}.png",
                                            filetypes=((_("Pictures"), "*.png"),))
        if name:
            picture.save(name)

    def close(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        for process in self.gears:
            process.terminate()
            process.wait()
        self.root.destroy()


def run(window: Histograms, seconds: int):
    """Until the window is closed, or so many seconds. Raises ToolError when its figures went."""
    if seconds:
        window.root.after(seconds * 1000 + PERIOD_MS // 2, window.close)
    window.root.mainloop()
    if window.trouble:
        raise window.trouble


def latency_bars(meter, show_tails: bool):
    """The function that gives Histograms the bars of all threads of a meter."""
    def read(bins):
        meter.read()
        found = []
        for t in meter.figures:
            if not t.counts:
                found.append(None)
                continue
            low, *counts, high = t.counts
            whole = [low + counts[0]] + counts[1:-1] + [high + counts[-1]]
            chosen = min(bins or t.bins, t.bins)
            edge = chosen * t.bin_ns / 1e3
            text = t.line(0)[8:].strip()
            if show_tails:
                text += "   " + _("off chart: - %d  + %d") % (low, high)
            found.append(Bars(gathered(whole, chosen), -edge, edge, "us", text))
        return found
    return read


def show_histograms(meter, o, platform):
    """The window of latency-histogram."""
    root = tkstyle.open_display("latency-histogram", "Latency-histogram")
    processor = next((line.split(":", 1)[1].strip()
                      for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")), "")
    lines = [_("%s (%s), kernel %s")
             % (processor or _("processor"), os.cpu_count(), platform.kernel)] + platform.doubts()
    window = Histograms(root, "latency-histogram", lines, o.text,
                        [_("%s thread (%d ns)") % (t.thread, t.period_ns) for t in meter.figures],
                        latency_bars(meter, o.show), meter.reset, bool(o.logscale),
                        max(t.bins for t in meter.figures), platform)
    run(window, o.seconds)
