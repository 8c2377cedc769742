# SPDX-License-Identifier: GPL-2.0-or-later
"""Configuration files of the oscilloscope: lines `KEYWORD value`, # begins a comment.

load() returns warnings; a line that cannot be used changes nothing. `resolve(kind, name)` tells
the hal_type_t of a source, 0 when there is none.
"""

from kerf import files

from . import settings as st

LONGEST = 98


class _Bad(Exception):
    """Why the value of a line cannot be used."""


def _number(kind, low, high, text):
    def read(word):
        try:
            value = kind(word)
        except ValueError:
            raise _Bad(text) from None
        if not low <= value <= high:
            raise _Bad(text)
        return value
    return read


def _reader(s, resolve):
    """Keyword: function of the value. They share which channel CHAN chose."""
    chosen = [None]
    any_float = float("inf")

    def channel():
        if chosen[0] is None:
            raise _Bad("no channel selected (CHAN comes first)")
        return s.channel(chosen[0])

    def choose(word):
        chosen[0] = _number(int, 1, st.CHANNELS, "channel must be 1 to 16")(word)
        s.selected = chosen[0]

    def source(kind):
        def read(word):
            c = channel()
            found = resolve(kind, word)
            if not found:
                raise _Bad({"pin": "pin", "sig": "signal", "param": "parameter"}[kind] + " not found")
            c.kind, c.name, c.type, c.enabled = kind, word, found, True
            low, high = c.limits()
            c.vscale = min(max(c.vscale, low), high)
        return read

    def off(_word):
        channel().enabled = False

    def put(of, name, read):
        return lambda word: setattr(of() if callable(of) else of, name, read(word))

    def vscale(word):
        c = channel()
        low, high = c.limits()
        c.vscale = _number(int, low, high, f"scale must be {low} to {high}")(word)

    def offset(ac):
        def read(word):
            c = channel()
            c.voff, c.ac = _number(float, -any_float, any_float, "bad offset")(word), ac
        return read

    share = _number(float, 0, 1, "position must be 0 to 1")
    flag = _number(int, 0, 1, "value must be 0 or 1")
    return {
        "samples": put(s, "samples",
                       _number(int, st.MIN_SAMPLES, st.MAX_SAMPLES,
                               f"samples must be {st.MIN_SAMPLES} to {st.MAX_SAMPLES}")),
        "thread": put(s, "thread", str),
        "maxchan": _number(int, 1, st.CHANNELS, "channels must be 1 to 16"),
        "hmult": put(s, "mult", _number(int, 1, st.MAX_MULT, f"multiplier must be 1 to {st.MAX_MULT}")),
        "hzoom": put(s, "zoom", _number(int, 1, st.MAX_ZOOM, f"zoom must be 1 to {st.MAX_ZOOM}")),
        "hpos": put(s, "pos", share),
        "chan": choose, "pin": source("pin"), "sig": source("sig"), "param": source("param"), "choff": off,
        "vscale": vscale, "vpos": put(channel, "vpos", share), "voff": offset(False), "vac": offset(True),
        "tsource": put(s.trigger, "source", _number(int, 0, st.CHANNELS, "trigger source must be 1 to 16")),
        "tlevel": put(s.trigger, "level", share), "tpos": put(s.trigger, "pos", share),
        "tpolar": put(s.trigger, "rising", lambda word: bool(flag(word))),
        "tmode": put(s.trigger, "auto", lambda word: bool(flag(word))),
        "rmode": put(s, "run_mode", _number(int, 0, 3, "run mode must be 0 to 3")),
    }


def parse(lines, settings, resolve):
    """Reads lines into settings; returns warnings."""
    known, warnings = _reader(settings, resolve), []
    for line in lines:
        line = line.strip()
        words = line.split(None, 1)
        if line.startswith("#"):         # older programs take the number of samples for a comment
            words = line[1:].split(None, 1)
            if len(words) != 2 or words[0].lower() != "samples" or not words[1].strip().isdigit():
                continue
        if not words:
            continue
        if len(line) > LONGEST:
            warnings.append(f"line too long: '{line}'")
            continue
        read = known.get(words[0].lower())
        if read is None:
            warnings.append(f"unknown config command: '{words[0]}'")
            continue
        value = words[1].strip() if len(words) == 2 else ""
        try:
            if not value and words[0].lower() != "choff":
                raise _Bad("value missing")
            read(value)
        except _Bad as bad:
            warnings.append(f"{bad}: '{line}'")
    if settings.selected and not settings.channel(settings.selected).enabled:
        settings.selected = 0
    if settings.trigger.source and not settings.channel(settings.trigger.source).enabled:
        settings.trigger.source = 0
    return warnings


def load(path, settings, resolve):
    """Reads a file into settings. Returns warnings; OSError when it cannot be read."""
    with open(path, encoding="utf-8", errors="replace") as f:
        return parse(f, settings, resolve)


def text(s):
    """The configuration as the text of a file."""
    out = [f"# SAMPLES {s.samples or st.DEFAULT_SAMPLES}", f"MAXCHAN {st.CHANNELS}"]
    if s.thread:
        out.append(f"THREAD {s.thread}")
    out += [f"HMULT {s.mult}", f"HZOOM {s.zoom}", f"HPOS {s.pos:e}"]

    def one(n):
        c = s.channel(n)
        out.extend([f"CHAN {n}", f"{c.kind.upper()} {c.name}", f"VSCALE {c.vscale}", f"VPOS {c.vpos:f}",
                    f"{'VAC' if c.ac else 'VOFF'} {c.voff:e}"])
        if not c.enabled:
            out.append("CHOFF")
    numbers = [n for n in range(1, st.CHANNELS + 1) if s.channel(n).kind in st.KINDS]
    for n in [n for n in numbers if not s.channel(n).enabled]:
        one(n)
    for n in [n for n in numbers if s.channel(n).enabled and n != s.selected]:
        one(n)
    if s.selected in numbers:
        one(s.selected)
    t = s.trigger
    if t.source:
        out += [f"TSOURCE {t.source}", f"TLEVEL {t.level:f}", f"TPOS {t.pos:f}", f"TPOLAR {int(t.rising)}"]
    out += [f"TMODE {int(t.auto)}", f"RMODE {s.run_mode}"]
    return "\n".join(out) + "\n"


def save(path, settings):
    files.replace(path, text(settings))
