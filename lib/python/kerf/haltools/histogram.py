# SPDX-License-Identifier: GPL-2.0-or-later
"""hal-histogram: how often a pin has which value, counted every cycle of its thread.

Realtime part: component histobinstream (or histobins with --legacy), added after the other
functions of the thread that handles the pin.
"""

import argparse
import json
import math
import sys

from .. import clock
from ..language import _
from .report import Netlist
from .session import SETTLE_S, ToolError, each_second, fetch, halcmd, pulse, run_tool

KEY = 21000           # shared memory key of stream 0
INSTANCES = 5         # tools that may run at the same time
MAX_BINS = 200
INPUTS = {"float": ("0", "input"), "s32": ("1", "input-s32"), "u32": ("2", "input-u32"), "bit": ("3", "input-bit")}


def options(arguments: list[str]) -> argparse.Namespace:
    p = argparse.ArgumentParser(prog="hal-histogram", allow_abbrev=False,
                                description="Histogram of the values of a HAL pin.")
    p.add_argument("--minvalue", type=float, default=0, metavar="n", help="lower end of the first bin (0)")
    p.add_argument("--binsize", type=float, default=100, metavar="n", help="width of a bin (100)")
    p.add_argument("--nbins", type=int, default=50, metavar="n", help=f"number of bins (50; 1 to {MAX_BINS})")
    p.add_argument("--logscale", type=int, default=1, choices=(0, 1), help="counts on a logarithmic scale (1)")
    p.add_argument("--text", default="", help="a note to be shown")
    p.add_argument("--show", action="store_true", help="show counts beyond the bins")
    p.add_argument("--verbose", action="store_true")
    p.add_argument("--legacy", action="store_true", help="use component histobins")
    p.add_argument("--nox", action="store_true", help="no window: print the counts once a second")
    p.add_argument("--seconds", type=int, default=0, metavar="n", help="end after n seconds (0: never)")
    p.add_argument("pin", nargs="?", default="motion-command-handler.time")
    o = p.parse_args(arguments)
    if not 1 <= o.nbins <= MAX_BINS:
        p.error(f"--nbins {o.nbins}: must be 1 to {MAX_BINS}")
    if o.binsize <= 0:
        p.error(f"--binsize {o.binsize:g}: must be greater than 0")
    return o


class PinHistogram:
    """Counts of one pin. Units are those of the pin."""

    def __init__(self, o: argparse.Namespace):
        import hal
        self.hal, self.o = hal, o
        net = Netlist(json.loads(halcmd("show", "--json")))
        pin = net.pins.get(o.pin)
        if pin is None:
            raise ToolError(f"pin '{o.pin}' does not exist")
        if pin["type"] not in INPUTS:
            raise ToolError(f"pin '{o.pin}' is of type {pin['type']}: must be one of {', '.join(INPUTS)}")
        self.pintype, self.input = INPUTS[pin["type"]]
        self.module = "histobins" if o.legacy else "histobinstream"
        if not hal.component_exists(self.module):
            keys = [] if o.legacy else ["keys=" + ",".join(str(KEY + i) for i in range(INSTANCES))]
            try:
                halcmd("loadrt", self.module, f"count={INSTANCES}", *keys)
            except ToolError:           # another histogram that starts now may load it, too
                if not clock.wait_until(lambda: hal.component_exists(self.module)
                                        and hal.component_is_ready(self.module), 1.0, 0.02):
                    raise
            net = Netlist.running()
        self.component, self.index = self._take_index(net)
        self.prefix = f"{self.module}.{self.index}"
        self.thread = self._thread_of(net, pin)
        self.signal, self.own_signal = pin["signal"], False
        if not self.signal:
            self.signal, self.own_signal = f"hal-histogram.{self.index}", True
            halcmd("net", self.signal, o.pin)
        halcmd("net", self.signal, f"{self.prefix}.{self.input}")
        for name, value in (("pintype", self.pintype), ("nbins", o.nbins), ("binsize", o.binsize),
                            ("minvalue", o.minvalue)):
            halcmd("setp", f"{self.prefix}.{name}", str(value))
        self.stream = None if o.legacy else hal.stream(self.component, KEY + self.index, "u")
        halcmd("addf", self.prefix, self.thread)
        self.low, self.counts, self.high = 0, [], 0
        self.figures = {}
        self.reset()

    def _take_index(self, net: Netlist):
        """The component that owns a free instance, and its number."""
        for i in range(INSTANCES):
            name = f"hal-histogram{i}"
            if f"{self.module}.{i}" in net.order or self.hal.component_exists(name):
                continue
            try:
                component = self.hal.component(name)
            except self.hal.error:      # another one was faster
                continue
            component.ready()
            return component, i
        raise ToolError(f"{INSTANCES} histograms are running already")

    def _thread_of(self, net: Netlist, pin: dict) -> str:
        """The thread of the function that handles the pin, else the slowest."""
        function = net.function_of(pin)
        for thread in net.threads:
            if function in thread["functions"]:
                return thread["name"]
        if not net.threads:
            raise ToolError("there is no thread to count in")
        return net.threads[-1]["name"]

    def _pin(self, name: str):
        return self.hal.get_p(f"{self.prefix}.{name}")

    def reset(self):
        """Forgets what was counted."""
        pulse(f"{self.prefix}.reset")

    def read(self):
        """Fetches counts and figures."""
        if self.o.legacy:
            self._read_bins()
        else:
            self._read_stream()
        self.figures = {name: self._pin(name) for name in ("nsamples", "mean", "variance", "input-min", "input-max")}

    def _read_stream(self):
        values = fetch({self.prefix: self.stream})[0]
        if len(values) == self.o.nbins + 2:
            self.low, *self.counts, self.high = values

    def _read_bins(self):
        counts = []
        for i in range(self.o.nbins):
            self.hal.set_p(f"{self.prefix}.index", str(i))
            if not clock.wait_until(lambda: self._pin("check") == i, 1.0, 0.002):
                raise ToolError(f"{self.prefix} does not answer: is its thread running?")
            counts.append(int(self._pin("binvalue")))
        self.low, self.counts, self.high = int(self._pin("nextra")), counts, int(self._pin("pextra"))

    def summary(self) -> str:
        f = self.figures
        sdev = math.sqrt(max(f.get("variance", 0), 0))
        return (f"samples: {f.get('nsamples', 0)} min: {f.get('input-min', 0):g} max: {f.get('input-max', 0):g} "
                f"mean: {f.get('mean', 0):g} sdev: {sdev:g}")

    def lines(self, elapsed_s: float) -> list[str]:
        """Reads; a line of figures, then 'lower end of bin: count' for bins that are not empty."""
        self.read()
        bins = [f"  {self.o.minvalue + i * self.o.binsize:g}: {count}" for i, count in enumerate(self.counts) if count]
        return [f"{elapsed_s:5d} s {self.summary()} below: {self.low} above: {self.high}", *bins]

    def close(self):
        if not self.hal.component_exists(self.module):      # the session has ended
            return
        for words in (("delf", self.prefix, self.thread), ("unlinkp", f"{self.prefix}.{self.input}")):
            try:
                halcmd(*words)
            except ToolError as problem:
                print(f"hal-histogram: {problem}", file=sys.stderr)
        if self.own_signal:
            halcmd("delsig", self.signal)
        self.component.exit()


def show_window(model: PinHistogram, o: argparse.Namespace):
    from .. import tkstyle
    from .latency_view import Bars, Histograms, run

    def read(_bins):
        model.read()
        text = model.summary() + ("   " + _("off chart: - %d  + %d") % (model.low, model.high) if o.show else "")
        counts = ([model.low + model.counts[0], *model.counts[1:-1], model.high + model.counts[-1]]
                  if len(model.counts) > 1 else model.counts)
        return [Bars(counts, o.minvalue, o.minvalue + o.nbins * o.binsize, "", text)]

    root = tkstyle.open_display("hal-histogram", "Hal-histogram")
    run(Histograms(root, "hal-histogram", [], o.text, [o.pin], read, model.reset, bool(o.logscale)), o.seconds)


def main(arguments: list[str]) -> int:
    o = options(arguments)

    def work():
        model = PinHistogram(o)
        try:
            if o.nox:
                each_second(model.lines, o.seconds, 1.0 - 2 * SETTLE_S)
            else:
                show_window(model, o)
        finally:
            model.close()
    return run_tool("hal-histogram", work, own_session=False)
