#!/usr/bin/python3
# Colours that mean different things in the preview, as people see them who do not tell red from green (Machado,
# Oliveira and Fernandes 2009, severity 1).
import numpy as np
from axis.compose import ALPHA, COLOURS, PLOT, plot_colours
from axis import icons, looks
from kerf import tkstyle

EYES = {
    "all colours": np.eye(3),
    "protanopia": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                            [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                              [-0.011820, 0.042940, 0.968881]]),
    "tritanopia": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
                            [0.004733, 0.691367, 0.303900]]),
}
XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                [0.0193339, 0.1191920, 0.9503041]])
LEAST = 20.0         # CIE 1976 difference that is seen at a glance between thin lines
LEAST_CONTRAST = 3.0 # of lines against the ground (WCAG 2, graphics)


def linear(colour):
    """Numbers of #rrggbb (or of a tuple 0..255) as light."""
    c = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)] if isinstance(colour, str) else colour[:3]) / 255
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def seen(colour, eye):
    return np.clip(EYES[eye] @ linear(colour), 0, 1)


def lab(light):
    xyz = XYZ @ light / np.array([0.95047, 1.0, 1.08883])
    f = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def difference(a, b, eye):
    return float(np.linalg.norm(lab(seen(a, eye)) - lab(seen(b, eye))))


def contrast(a, b, eye):
    high, low = sorted((float((XYZ @ seen(c, eye))[1]) for c in (a, b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def on_ground(rgba):
    """A colour with alpha as it lies on the background."""
    ground = [int(COLOURS["back"][i:i + 2], 16) for i in (1, 3, 5)]
    return tuple(g + (c - g) * rgba[3] / 255 for c, g in zip(rgba, ground))


plot = {name: on_ground(c) for name, c in zip(PLOT, plot_colours(COLOURS, ALPHA))}
# What only its colour tells. Axes have letters, labels beyond the limits a box, the selected line is three pixels wide.
PAIRS = [("straight_feed", "traverse"), ("traverse", "selected"), ("straight_feed_xy", "straight_feed_uv"),
         ("straight_feed_xy", "traverse_xy"), ("straight_feed_uv", "traverse_uv"), ("dwell", "m1xx"),
         ("dwell", "straight_feed"), ("limits", "grid"), ("limits", "straight_feed")]
PAIRS = [(a, b, COLOURS[a], COLOURS[b]) for a, b in PAIRS]
PAIRS += [(f"plot of {a}", "program", plot[a], COLOURS["straight_feed"]) for a in ("jog", "feed", "arc", "probing")]
PAIRS += [(f"plot of {a}", f"plot of {b}", plot[a], plot[b])
          for a, b in (("jog", "feed"), ("jog", "traverse"), ("feed", "traverse"), ("arc", "traverse"),
                                                                        ("jog", "probing"), ("traverse", "probing"))]
for eye in EYES:
    rows = [(difference(a, b, eye), one, other) for one, other, a, b in PAIRS]
    print(eye, "too near:", [f"{one} / {other} {d:.0f}" for d, one, other in rows if d < LEAST])
    print("   too dark:", [name
                           for name in ("straight_feed", "traverse", "selected", "limits", "label_ok", "label_limit",
                                        "dwell", "m1xx", "cone", "overlay_foreground", "straight_feed_xy",
                                        "straight_feed_uv")
                         if contrast(COLOURS[name], COLOURS["back"], eye) < LEAST_CONTRAST])
for name in ("LIGHT", "DARK"):
    theme = getattr(tkstyle, name) | getattr(looks, name)
    texts = [("ink", "face"), ("ink", "field"), ("ink", "pressed"), ("dro", "dro_back"), ("number", "field"),
             ("ink", "chosen")]
    print(name.lower(), "text too faint:",
          [f"{a} on {b} {contrast(theme[a], theme[b], 'all colours'):.1f}" for a, b in texts
                                            if contrast(theme[a], theme[b], "all colours") < 4.5],
          "white on the running line:", contrast("#ffffff", theme["running"], "all colours") >= 4.5)
    inks = getattr(icons, name)
    print("   icons too faint:",
          [f"{ink} on {ground}" for ink in ("ink", "bad", "good", "blue", "quiet") for ground in ("face", "chosen")
                                  if contrast(inks[ink], theme[ground], "all colours") < LEAST_CONTRAST])
