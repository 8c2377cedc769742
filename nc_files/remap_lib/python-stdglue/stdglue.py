# SPDX-License-Identifier: GPL-2.0-or-later
"""Prologs and epilogs for remapped T, M6, M61, S, F and cycles.

In the INI file:
    [PYTHON]
    TOPLEVEL = python/toplevel.py
    PATH_PREPEND = ./python
    PATH_APPEND = .../nc_files/remap_lib/python-stdglue
    [RS274NGC]
    REMAP=T  prolog=prepare_prolog  ngc=prepare epilog=prepare_epilog
    REMAP=M6 modalgroup=6 prolog=change_prolog ngc=change epilog=change_epilog
    REMAP=M61 modalgroup=6 prolog=settool_prolog ngc=settool epilog=settool_epilog
    REMAP=S  prolog=setspeed_prolog ngc=setspeed epilog=setspeed_epilog
    REMAP=F  prolog=setfeed_prolog  ngc=setfeed  epilog=setfeed_epilog
    REMAP=G84.2 modalgroup=1 argspec=xyzqpr prolog=cycle_prolog ngc=... epilog=cycle_epilog
and python/remap.py says: from stdglue import *

A procedure says with its return value how it went: more than 0 is success.
"""
import functools
import inspect

import emccanon
from interpreter import *

throw_exceptions = 1  # handlers raise what self.execute() finds


class _Refusal(Exception):
    """The code fails with this text."""


def _told(self, error, where):
    self.set_errormsg(str(error) if isinstance(error, _Refusal) or not where else where % error)
    return INTERP_ERROR


def _named(code, end=""):
    """What goes wrong inside a handler is told with the code and the handler's name; a refusal as it stands."""
    def wrap(handler):
        where = code and f"{code}/{handler.__name__}: %s{end}"
        if inspect.isgeneratorfunction(handler):
            @functools.wraps(handler)
            def guarded(self, **words):
                try:
                    yield from handler(self, **words)
                except Exception as e:
                    yield _told(self, e, where)
        else:
            @functools.wraps(handler)
            def guarded(self, **words):
                try:
                    return handler(self, **words)
                except Exception as e:
                    return _told(self, e, where)
        return guarded
    return wrap


def _block(self):
    return self.blocks[self.remap_level]


def _index(self, tool):
    """Place of a tool in the interpreter's table, -1 when it is not there."""
    if tool == 0 and not self.random_toolchanger:
        return 0
    for idx in range(1, len(self.tool_table)):
        if self.tool_table[idx].toolno == tool:
            return idx
    return 0 if self.tool_table[0].toolno == tool else -1


def _pocket(self, tool, text):
    status, pocket = self.find_tool_pocket(tool)
    if status != INTERP_OK:
        raise _Refusal(text)
    return pocket


def _word(self, letter, text):
    block = _block(self)
    if not getattr(block, letter + "_flag"):
        raise _Refusal(text)
    return getattr(block, letter + "_number")


def _no_compensation(self):
    if self.cutter_comp_side:
        raise _Refusal("Cannot change tools with cutter radius compensation on")


def _answer(self):
    """What the procedure returned; None when the built-in code has done the work already."""
    if not self.value_returned:
        r = _block(self).executing_remap
        raise _Refusal(f"the {r.name} remap procedure {r.remap_ngc or r.remap_py} did not return a value")
    return None if _block(self).builtin_used else self.return_value


# ---- T ------------------------------------------------------------------------------------

@_named("T")
def prepare_prolog(self, **words):
    tool = int(_word(self, "t", "T requires a tool number"))
    self.params["pocket"] = _pocket(self, tool, "T%d: pocket not found" % tool) if tool else -1
    self.params["tool"] = tool
    return INTERP_OK


@_named("T")
def prepare_epilog(self, **words):
    answer = _answer(self)
    if answer is None:
        return INTERP_OK
    tool = int(self.params["tool"])
    if answer <= 0:
        raise _Refusal("T%d: aborted (return code %.1f)" % (tool, answer))
    self.selected_tool = tool
    self.selected_pocket = _index(self, tool)
    emccanon.SELECT_TOOL(tool)
    return INTERP_OK


# ---- M6 -----------------------------------------------------------------------------------

@_named("M6")
def change_prolog(self, **words):
    if self.selected_pocket < 0:
        raise _Refusal("M6: no tool prepared")
    _no_compensation(self)
    self.params["tool_in_spindle"] = self.current_tool
    self.params["selected_tool"] = self.selected_tool
    self.params["current_pocket"] = self.current_pocket
    self.params["selected_pocket"] = self.selected_pocket
    return INTERP_OK


@_named("M6")
def change_epilog(self, **words):
    answer = _answer(self)
    if answer is None:
        yield INTERP_OK
        return
    if answer <= 0:
        yield INTERP_EXECUTE_FINISH  # what the procedure said to the operator comes first
        raise _Refusal("M6 aborted (return code %.1f)" % answer)
    _change_to_selected(self)
    self.set_tool_parameters()
    yield INTERP_EXECUTE_FINISH


def _change_to_selected(self):
    emccanon.CHANGE_TOOL()
    self.current_pocket = self.selected_pocket
    self.selected_pocket = -1
    self.selected_tool = -1
    self.toolchange_flag = True


def ignore_m6(self, **words):
    """REMAP=M6 python=ignore_m6: T alone changes tools."""
    return INTERP_OK


# ---- M61 ----------------------------------------------------------------------------------

def _requested(self):
    """(tool, P number) of the Q word."""
    tool = int(_word(self, "q", "M61 requires a Q parameter"))
    if tool < 0:
        raise _Refusal("M61: Q value < 0")
    return tool, _pocket(self, tool, "M61 failed: requested tool %d not in table" % tool) if tool else 0


def _use_tool(self, tool):
    idx = _index(self, tool)
    self.current_tool = tool
    self.current_pocket = idx
    emccanon.CHANGE_TOOL_NUMBER(idx)
    self.set_tool_parameters()
    self.toolchange_flag = True


@_named("M61", ")")
def settool_prolog(self, **words):
    self.params["tool"], self.params["pocket"] = _requested(self)
    return INTERP_OK


@_named("M61", ")")
def settool_epilog(self, **words):
    answer = _answer(self)
    if answer is None:
        yield INTERP_OK
        return
    if answer <= 0:
        raise _Refusal("M61 aborted (return code %.1f)" % answer)
    _use_tool(self, int(self.params["tool"]))
    yield INTERP_EXECUTE_FINISH


@_named("M61", ")")
def set_tool_number(self, **words):
    """REMAP=M61 modalgroup=6 python=set_tool_number"""
    _use_tool(self, _requested(self)[0])
    yield INTERP_EXECUTE_FINISH


# ---- S and F ------------------------------------------------------------------------------

def _value_answered(self, code):
    """True: the value of the word is to be used."""
    answer = _answer(self)
    if answer is not None and answer < 0:
        raise _Refusal("%s: remap procedure returned %f" % (code, answer))
    return answer is not None


@_named("S", ")")
def setspeed_prolog(self, **words):
    self.params["speed"] = _word(self, "s", "S requires a value")
    return INTERP_OK


@_named("S", ")")
def setspeed_epilog(self, **words):
    if _value_answered(self, "S"):
        self.speed[0] = self.params["speed"]
        emccanon.enqueue_SET_SPINDLE_SPEED(0, self.speed[0])
    return INTERP_OK


@_named("F", ")")
def setfeed_prolog(self, **words):
    self.params["feed"] = _word(self, "f", "F requires a value")
    return INTERP_OK


@_named("F", ")")
def setfeed_epilog(self, **words):
    if _value_answered(self, "F"):
        self.feed_rate = self.params["feed"]
        emccanon.enqueue_SET_FEED_RATE(self.feed_rate)
    return INTERP_OK


# ---- cycles ---------------------------------------------------------------------------------

# By plane: name, the words that stay from line to line, axes that have no place in the cycle.
_PLANES = {1: ("XY", "zr", "uvw"), 2: ("YZ", "xr", "uvw"), 3: ("XZ", "yr", "uvw"), 4: ("UV", "wr", "xyz"),
           5: ("VW", "ur", "xyz"), 6: ("UW", "vr", "xyz")}


def init_stdglue(self):
    """Call it in the toplevel module's __init__(self)."""
    self.sticky_params = {}


@_named("cycle")
def cycle_prolog(self, **words):
    block = _block(self)
    remap = block.executing_remap
    name, sticky, foreign = _PLANES[int(self.plane)]
    code = block.g_modes[1]
    if code > -1:  # the line with the G code begins a new series
        self.sticky_params[remap.name] = {}
    self.params["motion_code"] = code
    known = self.sticky_params.setdefault(remap.name, {})
    for axis in foreign:
        if getattr(block, axis + "_flag"):
            raise _Refusal("%s: Cannot put a %s in a canned cycle in the %s plane" % (remap.name, axis.upper(), name))
    known.update((k, v) for k, v in words.items() if k in sticky or k not in "abcuvwxyzn")
    for word, value in known.items():
        if word not in words:
            self.params[word] = value
    if "r" not in known:
        raise _Refusal("%s: cycle requires R word" % remap.name)
    if known["r"] <= 0.0:
        raise _Refusal("%s: R word must be > 0 if used (%.4f)" % (remap.name, known["r"]))
    if "p" in known and known["p"] < 0.0:
        raise _Refusal("%s: P word must be >= 0 if used (%.4f)" % (remap.name, known["p"]))
    if self.feed_rate == 0.0:
        raise _Refusal("%s: feed rate must be > 0" % remap.name)
    if self.feed_mode == INVERSE_TIME:
        raise _Refusal("%s: Cannot use inverse time feed with canned cycles" % remap.name)
    if self.cutter_comp_side:
        raise _Refusal("%s: Cannot use canned cycles with cutter compensation on" % remap.name)
    return INTERP_OK


@_named("cycle")
def cycle_epilog(self, **words):
    self.motion_mode = _block(self).executing_remap.motion_code  # following lines with axis words repeat it
    return INTERP_OK


# ---- lathe tools with wear, tool probing ------------------------------------------------------

@_named("")
def index_lathe_tool_with_wear(self, **words):
    """REMAP=T python=index_lathe_tool_with_wear: Txxyy loads tool xx, with the wear of entry 10000+yy."""
    if not self.task:
        yield INTERP_OK
        return
    word = int(_word(self, "t", "T requires a tool number"))
    if word < 100:
        word *= 100
    tool, wear = word // 100, 10000 + word % 100 if word % 100 else 0
    if tool == 0:
        raise _Refusal("T0 not valid")
    _no_compensation(self)
    _pocket(self, tool, "T%d: tool entry not found" % tool)
    if wear:
        _pocket(self, wear, "Tool change aborted - No wear %d entry found in tool table" % wear)
    self.params["tool"] = tool
    self.params["wear"] = wear
    try:
        self.selected_tool = tool
        self.selected_pocket = _index(self, tool)
        emccanon.SELECT_TOOL(tool)
        if self.current_pocket != self.selected_pocket or self.current_tool != tool:
            _change_to_selected(self)
            yield INTERP_EXECUTE_FINISH
            self.set_tool_parameters()
        self.execute("G43 H%d" % tool)
        if wear:
            self.execute("G43.2 H%d" % wear)
    except InterpreterException:
        raise _Refusal("Tool change aborted (return code %.1f)" % self.return_value)
    component = getattr(self, "hal_tool_comp", None)
    if component is not None:
        component["tool"], component["wear"] = tool, wear
    yield INTERP_OK


@_named("")
def tool_probe_m6(self, **words):
    """REMAP=M6 modalgroup=6 python=tool_probe_m6: change, then measure the tool on the sensor of
    [TOOLSENSOR]; #5000 is the height of the work below the sensor's zero."""
    if not self.task:
        yield INTERP_OK
        return
    try:
        for number, value in zip((4999, 4998, 4997), (self.params["_x"], self.params["_y"], self.params["_z"])):
            self.parameters[number] = value
        self.params["tool"] = self.selected_tool
        self.execute("M5")
        yield INTERP_EXECUTE_FINISH
        self.execute("T%d M6" % int(self.params["tool"]))
        yield INTERP_EXECUTE_FINISH
        if self.current_tool <= 0:
            yield INTERP_OK
            return
        sensor = {k: self.params["_ini[TOOLSENSOR]" + k]
                  for k in ("X", "Y", "Z", "MAXPROBE", "SEARCH_VEL", "PROBE_VEL", "PROBEHEIGHT")}
        # The values of the INI file are in its units, #5000 is in those of the program.
        metric = self.params["_metric_machine"] != 0
        work = self.parameters[5000] * (1 if metric == bool(self.params["_metric"]) else 25.4 if metric else 1 / 25.4)
        step = 4.0 if metric else 0.25
        self.execute("M70")
        self.execute("G21" if metric else "G20")
        self.execute("G90 G94 G49 G92.1")
        self.execute("G53 G0 Z%f" % sensor["Z"])
        self.execute("G53 G0 X%f Y%f" % (sensor["X"], sensor["Y"]))
        for feed, distance in (sensor["SEARCH_VEL"], sensor["MAXPROBE"]), (sensor["PROBE_VEL"], -2 * step):
            self.execute("F%f" % feed)
            self.execute("G91 G38.2 Z%f" % distance)
            yield INTERP_EXECUTE_FINISH
            if self.parameters[5070] == 0 or self.return_value > 0.0:
                self.execute("G90")
                raise _Refusal("tool_probe_m6 remap error:")
            if distance == sensor["MAXPROBE"]:
                self.execute("G91 G0 Z%f" % step)
        self.execute("G90 G53 G0 Z%f" % sensor["Z"])
        self.execute("G10 L1 P#5400 Z%f" % (self.parameters[5063] - sensor["PROBEHEIGHT"] + work))
        self.execute("M72")
        self.execute("G43")
    except _Refusal:
        raise
    except Exception as e:
        print("tool_probe_m6:", e)
        raise _Refusal("tool_probe_m6 remap error.")
    yield INTERP_OK


def build_hal(self):
    """HAL component remapStat with pins tool and wear, for the toplevel module's __init__(self)."""
    if not self.task:
        return
    import hal
    component = hal.component("remapStat")
    component.newpin("tool", hal.HAL_S32, hal.HAL_OUT)
    component.newpin("wear", hal.HAL_S32, hal.HAL_OUT)
    component.ready()
    self.hal_tool_comp = component
