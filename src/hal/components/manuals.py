#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Manual pages, and the list of the components.

manuals.py man FOLDER FILE...   a page of section 9 (1 for programs) for each .comp and
                                .adoc file, in FOLDER/man9 and FOLDER/man1, and a
                                reference to it for every other name of its NAME section
manuals.py list FILE...         docs/components.md, on standard output

Descriptions are the components' own. Each component stands in one group below; a
missing or unknown one is an error.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from halcompile import adoc, man
from halcompile.checker import Component, check
from halcompile.errors import CompError, describe
from halcompile.parser import parse_text

GROUPS = {
    "Gates and bits": """and2 or2 xor2 not logic lut5 maj3 match8 select8 tristate_bit tristate_float flipflop
        bitmerge bitslice bitwise bin2gray gray2bin demux output_buffer""",
    "Buttons, switches and messages": """radiobutton multiswitch toggle toggle2nist momentary2nist multiclick
        matrix_kb sim_matrix_kb enum debounce dbounce message pushmsg lcd mqtt-publisher mtconnect-agent reset sample_hold
        knob2float updown
        xhc_hb04_util joyhandle hal_input sendkeys hal_bridge panelui""",
    "Safety": "estop_latch safety_latch charge_pump watchdog joint_axis_mapper",
    "Arithmetic": """abs abs_s32 abs_s64 constant sum2 mult2 div2 invert scale offset hypot scaled_s32_sums weighted_sum
        blend feedcomp deadzone minmax near comp wcomp led_dim clarke2 clarke3 clarkeinv lincurve modmath
        differential corexy_by_hal supply""",
    "Converting types": "conv_*",
    "Selecting values": "mux2 mux4 mux8 mux16 mux_generic demux_generic",
    "Time": "edge oneshot timedelay ton tof tp time threadtest timedelta",
    "Limits and filters": """limit1 limit2 limit3 limit_axis lowpass ilowpass ddt integ biquad filter_kalman
        simple_tp""",
    "Control": "pid bldc thc thcud plasmac ohmic laserpower raster",
    "Pulses and encoders": "stepgen pwmgen siggen encoder counter encoder_ratio",
    "Spindles and tools": "spindle gearchange spindle_monitor orient carousel boss_plc",
    "Joints and axes": "homemod gantry anglejog eoffset_per_angle moveoff moveoff_gui z_level_compensation",
    "Windows": """halshow halconfig halmeter emccalib tooledit hal_manualtoolchange linuxcnctop debuglevel teach-in mdro tklinuxcnc ngcgui
        monitor-xhc-hb04 image-to-gcode pyvcp pyvcp_demo vismach axis-remote mdi""",
    "Threads and streams": "threads sampler streamer scope_rt halscope",
    "Simulation and tests": """sim-torch sim_pin simulate_probe sim_encoder sim_spindle sim_home_switch
        sim_axis_hardware sim_joint sim_parport sphereprobe
        axistest steptest""",
    "Ladder logic": "classicladder_rt",
    "Statistics": "histobins histobinstream latencybins latencybinstream",
    "Hardware": "hal_parport hal_speaker serport hal_gpio hal_pi_gpio hal_bb_gpio",
    "Boards with HostMot2 firmware": "hostmot2 hm2_eth hm2_pci hm2_spi hm2_spix hm2_rpspi hm2_7i43 hm2_7i90 hm2_test "
                                     "mesa_uart hm2_modbus mesambccc elbpcom",
    "Sensors": "max31855 thermistor",
    "Devices on Modbus and USB": """mb2hal gs2_vfd hy_vfd hy_gt_vfd svd-ps_vfd mitsub_vfd vfs11_vfd vfdb_vfd wj200_vfd
        pi500_vfd pmx485 pmx485-test shuttle xhc-hb04 xhc-whb04b-6
        scorbot-er-3""",
}
TITLE = re.compile(r"^= \S+\((\d)\)$", re.M)
NAMES = re.compile(r"^== NAME\s+([^=]+?) - (.*)$", re.M)


def load(path: Path) -> Component:
    text = path.read_text()
    try:
        return check(parse_text(str(path), text), path.stem)
    except CompError as error:
        sys.exit(describe(error, str(path), text))


def write_pages(folder: Path, files: list[Path]) -> None:
    for path in files:
        if path.suffix == ".adoc":
            text = path.read_text()
            page, section = man.render_page(text, path.name), TITLE.search(text).group(1)
        else:
            component = load(path)
            page, section = man.render(component), adoc.section_number(component)
        target = folder / f"man{section}" / f"{path.stem}.{section}"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(page)
        for name in other_names(path):
            target.with_name(f"{name}.{section}").write_text(f".so man{section}/{target.name}\n")


def other_names(path: Path) -> list[str]:
    """What else than the file is named the page is about: the programs of a family."""
    if path.suffix != ".adoc":
        return []
    return [name for name in re.split(r"[,\s]+", NAMES.search(path.read_text()).group(1)) if name != path.stem]


def summary(path: Path) -> str:
    if path.suffix == ".adoc":
        text = NAMES.search(path.read_text()).group(2)
    else:
        text = (load(path).doc or "").strip().split("\n")[0]
    return text[:1].upper() + text[1:]


def listing(files: list[Path]) -> str:
    summaries = {path.stem: summary(path) for path in files}
    lines = ["# HAL components", "",
             "Made by `src/hal/components/manuals.py` from the components' own descriptions. `man 9 NAME` shows the",
             "pins, parameters and functions of each.", ""]
    for title, names in GROUPS.items():
        members = []
        for name in names.split():
            if name.endswith("*"):
                members += sorted(n for n in summaries if n.startswith(name[:-1]))
            elif name in summaries:
                members.append(name)
        if not members:
            continue
        lines += [f"## {title}", "", "| component | what it does |", "| --- | --- |"]
        lines += [f"| `{name}` | {summaries.pop(name).rstrip('.')} |" for name in members]
        lines.append("")
    if summaries:
        sys.exit(f"manuals.py: in no group: {' '.join(sorted(summaries))}")
    return "\n".join(lines)


def main(words: list[str]) -> None:
    if len(words) >= 3 and words[0] == "man":
        write_pages(Path(words[1]), [Path(f) for f in words[2:]])
    elif len(words) >= 2 and words[0] == "list":
        print(listing([Path(f) for f in words[1:]]), end="")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
