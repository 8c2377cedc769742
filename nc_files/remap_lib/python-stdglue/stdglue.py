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


def _named(code, end=""):
    """What goes wrong inside a handler is told with the code and the handler's name."""
    def wrap(handler):
        if inspect.isgeneratorfunction(handler):
            @functools.wraps(handler)
            def guarded(self, **words):
                try:
                    yield from handler(self, **words)
                except Exception as e:
                    self.set_errormsg(f"{code}/{handler.__name__}: {e}{end}")
                    yield INTERP_ERROR
        else:
            @functools.wraps(handler)
            def guarded(self, **words):
                try:
                    return handler(self, **words)
                except Exception as e:
                    self.set_errormsg(f"{code}/{handler.__name__}: {e}{end}")
                    return INTERP_ERROR
        return guarded
    return wrap


def _fail(self, text):
    self.set_errormsg(text)
    return INTERP_ERROR


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


def _unanswered(self):
    r = _block(self).executing_remap
    return f"the {r.name} remap procedure {r.remap_ngc or r.remap_py} did not return a value"


# ---- T ------------------------------------------------------------------------------------

@_named("T")
def prepare_prolog(self, **words):
    block = _block(self)
    if not block.t_flag:
        return _fail(self, "T requires a tool number")
    tool = int(block.t_number)
    pocket = -1
    if tool:
        status, pocket = self.find_tool_pocket(tool)
        if status != INTERP_OK:
            return _fail(self, "T%d: pocket not found" % tool)
    self.params["tool"] = tool
    self.params["pocket"] = pocket
    return INTERP_OK


@_named("T")
def prepare_epilog(self, **words):
    if not self.value_returned:
        return _fail(self, _unanswered(self))
    if _block(self).builtin_used:
        return INTERP_OK
    tool = int(self.params["tool"])
    if self.return_value > 0:
        self.selected_tool = tool
        self.selected_pocket = _index(self, tool)
        emccanon.SELECT_TOOL(tool)
        return INTERP_OK
    return _fail(self, "T%d: aborted (return code %.1f)" % (tool, self.return_value))


# ---- M6 -----------------------------------------------------------------------------------

@_named("M6")
def change_prolog(self, **words):
    if self.selected_pocket < 0:
        return _fail(self, "M6: no tool prepared")
    if self.cutter_comp_side:
        return _fail(self, "Cannot change tools with cutter radius compensation on")
    self.params["tool_in_spindle"] = self.current_tool
    self.params["selected_tool"] = self.selected_tool
    self.params["current_pocket"] = self.current_pocket
    self.params["selected_pocket"] = self.selected_pocket
    return INTERP_OK


@_named("M6")
def change_epilog(self, **words):
    if not self.value_returned:
        self.set_errormsg(_unanswered(self))
        yield INTERP_ERROR
        return
    if _block(self).builtin_used:
        yield INTERP_OK
        return
    code = self.return_value
    if code > 0:
        emccanon.CHANGE_TOOL()
        self.current_pocket = self.selected_pocket
        self.selected_pocket = -1
        self.selected_tool = -1
        self.set_tool_parameters()
        self.toolchange_flag = True
        yield INTERP_EXECUTE_FINISH
        return
    yield INTERP_EXECUTE_FINISH  # what the procedure said to the operator comes first
    self.set_errormsg("M6 aborted (return code %.1f)" % code)
    yield INTERP_ERROR


def ignore_m6(self, **words):
    """REMAP=M6 python=ignore_m6: T alone changes tools."""
    return INTERP_OK


# ---- M61 ----------------------------------------------------------------------------------

def _requested(self):
    """(tool, P number) of the Q word, or None after the error is set."""
    block = _block(self)
    if not block.q_flag:
        self.set_errormsg("M61 requires a Q parameter")
        return None
    tool = int(block.q_number)
    if tool < 0:
        self.set_errormsg("M61: Q value < 0")
        return None
    pocket = 0
    if tool:
        status, pocket = self.find_tool_pocket(tool)
        if status != INTERP_OK:
            self.set_errormsg("M61 failed: requested tool %d not in table" % tool)
            return None
    return tool, pocket


def _use_tool(self, tool):
    idx = _index(self, tool)
    self.current_tool = tool
    self.current_pocket = idx
    emccanon.CHANGE_TOOL_NUMBER(idx)
    self.set_tool_parameters()
    self.toolchange_flag = True


@_named("M61", ")")
def settool_prolog(self, **words):
    found = _requested(self)
    if found is None:
        return INTERP_ERROR
    self.params["tool"], self.params["pocket"] = found
    return INTERP_OK


@_named("M61", ")")
def settool_epilog(self, **words):
    if not self.value_returned:
        self.set_errormsg(_unanswered(self))
        yield INTERP_ERROR
        return
    if _block(self).builtin_used:
        yield INTERP_OK
        return
    if self.return_value > 0:
        _use_tool(self, int(self.params["tool"]))
        yield INTERP_EXECUTE_FINISH
        return
    self.set_errormsg("M61 aborted (return code %.1f)" % self.return_value)
    yield INTERP_ERROR


@_named("M61", ")")
def set_tool_number(self, **words):
    """REMAP=M61 modalgroup=6 python=set_tool_number"""
    found = _requested(self)
    if found is None:
        yield INTERP_ERROR
        return
    _use_tool(self, found[0])
    yield INTERP_EXECUTE_FINISH


# ---- S and F ------------------------------------------------------------------------------

@_named("S", ")")
def setspeed_prolog(self, **words):
    block = _block(self)
    if not block.s_flag:
        return _fail(self, "S requires a value")
    self.params["speed"] = block.s_number
    return INTERP_OK


@_named("S", ")")
def setspeed_epilog(self, **words):
    if not self.value_returned:
        return _fail(self, _unanswered(self))
    if self.return_value < 0:
        return _fail(self, "S: remap procedure returned %f" % self.return_value)
    if not _block(self).builtin_used:
        self.speed[0] = self.params["speed"]
        emccanon.enqueue_SET_SPINDLE_SPEED(0, self.speed[0])
    return INTERP_OK


@_named("F", ")")
def setfeed_prolog(self, **words):
    block = _block(self)
    if not block.f_flag:
        return _fail(self, "F requires a value")
    self.params["feed"] = block.f_number
    return INTERP_OK


@_named("F", ")")
def setfeed_epilog(self, **words):
    if not self.value_returned:
        return _fail(self, _unanswered(self))
    if self.return_value < 0:
        return _fail(self, "F: remap procedure returned %f" % self.return_value)
    if not _block(self).builtin_used:
        self.feed_rate = self.params["feed"]
        emccanon.enqueue_SET_FEED_RATE(self.feed_rate)
    return INTERP_OK


# ---- cycles ---------------------------------------------------------------------------------

# By plane: name, the words that stay from line to line, axes that have no place in the cycle.
_PLANES = {1: ("XY", "zr", "uvw"), 2: ("YZ", "xr", "uvw"), 3: ("XZ", "yr", "uvw"), 4: ("UV", "wr", "xyz"), 5: ("VW", "ur", "xyz"), 6: ("UW", "vr", "xyz")}


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
            return _fail(self, "%s: Cannot put a %s in a canned cycle in the %s plane" % (remap.name, axis.upper(), name))
    known.update((k, v) for k, v in words.items() if k in sticky or k not in "abcuvwxyzn")
    for word, value in known.items():
        if word not in words:
            self.params[word] = value
    if "r" not in known:
        return _fail(self, "%s: cycle requires R word" % remap.name)
    if known["r"] <= 0.0:
        return _fail(self, "%s: R word must be > 0 if used (%.4f)" % (remap.name, known["r"]))
    if "p" in known and known["p"] < 0.0:
        return _fail(self, "%s: P word must be >= 0 if used (%.4f)" % (remap.name, known["p"]))
    if self.feed_rate == 0.0:
        return _fail(self, "%s: feed rate must be > 0" % remap.name)
    if self.feed_mode == INVERSE_TIME:
        return _fail(self, "%s: Cannot use inverse time feed with canned cycles" % remap.name)
    if self.cutter_comp_side:
        return _fail(self, "%s: Cannot use canned cycles with cutter compensation on" % remap.name)
    return INTERP_OK


@_named("cycle")
def cycle_epilog(self, **words):
    self.motion_mode = _block(self).executing_remap.motion_code  # following lines with axis words repeat it
    return INTERP_OK


# ---- lathe tools with wear, tool probing ------------------------------------------------------

def index_lathe_tool_with_wear(self, **words):
    """REMAP=T python=index_lathe_tool_with_wear: Txxyy loads tool xx, with the wear of entry 10000+yy."""
    if not self.task:
        yield INTERP_OK
        return
    block = _block(self)
    if not block.t_flag:
        self.set_errormsg("T requires a tool number")
        yield INTERP_ERROR
        return
    word = int(block.t_number)
    if word < 100:
        word *= 100
    tool, wear = word // 100, 10000 + word % 100 if word % 100 else 0
    if tool == 0:
        self.set_errormsg("T0 not valid")
        yield INTERP_ERROR
        return
    if self.cutter_comp_side:
        self.set_errormsg("Cannot change tools with cutter radius compensation on")
        yield INTERP_ERROR
        return
    if self.find_tool_pocket(tool)[0] != INTERP_OK:
        self.set_errormsg("T%d: tool entry not found" % tool)
        yield INTERP_ERROR
        return
    if wear and self.find_tool_pocket(wear)[0] != INTERP_OK:
        self.set_errormsg("Tool change aborted - No wear %d entry found in tool table" % wear)
        yield INTERP_ERROR
        return
    self.params["tool"] = tool
    self.params["wear"] = wear
    try:
        self.selected_tool = tool
        self.selected_pocket = _index(self, tool)
        emccanon.SELECT_TOOL(tool)
        if self.current_pocket != self.selected_pocket or self.current_tool != tool:
            emccanon.CHANGE_TOOL()
            self.current_pocket = self.selected_pocket
            self.selected_pocket = -1
            self.selected_tool = -1
            self.toolchange_flag = True
            yield INTERP_EXECUTE_FINISH
            self.set_tool_parameters()
        self.execute("G43 H%d" % tool)
        if wear:
            self.execute("G43.2 H%d" % wear)
    except InterpreterException:
        self.set_errormsg("Tool change aborted (return code %.1f)" % self.return_value)
        yield INTERP_ERROR
        return
    component = getattr(self, "hal_tool_comp", None)
    if component is not None:
        component["tool"], component["wear"] = tool, wear
    yield INTERP_OK


def tool_probe_m6(self, **words):
    """REMAP=M6 modalgroup=6 python=tool_probe_m6: change, then measure the tool on the sensor of
    [TOOLSENSOR]; #5000 is the height of the work below the sensor's zero."""
    if not self.task:
        yield INTERP_OK
        return
    imperial = self.params["_imperial"] == 1
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
        sensor = {k: self.params["_ini[TOOLSENSOR]" + k] for k in ("X", "Y", "Z", "MAXPROBE", "SEARCH_VEL", "PROBE_VEL", "PROBEHEIGHT")}
        self.execute("M70")
        self.execute("G90 G94 G49 G92.1")
        self.execute("G53 G0 Z[#<_ini[TOOLSENSOR]Z>]")
        self.execute("G53 G0 X[#<_ini[TOOLSENSOR]X>] Y[#<_ini[TOOLSENSOR]Y>]")
        self.execute("F%f" % sensor["SEARCH_VEL"])
        self.execute("G91 G38.2 Z%f" % sensor["MAXPROBE"])
        yield INTERP_EXECUTE_FINISH
        if self.parameters[5070] == 0 or self.return_value > 0.0:
            self.execute("G90")
            self.set_errormsg("tool_probe_m6 remap error:")
            yield INTERP_ERROR
            return
        step = 0.25 if imperial else 4.0
        self.execute("G91 G0 Z%f" % step)
        self.execute("F%f" % sensor["PROBE_VEL"])
        self.execute("G91 G38.2 Z%f" % (-2 * step))
        yield INTERP_EXECUTE_FINISH
        if self.parameters[5070] == 0:
            self.execute("G90")
            self.set_errormsg("tool_probe_m6 remap error:")
            yield INTERP_ERROR
            return
        self.execute("G90 G53 G0 Z[#<_ini[TOOLSENSOR]Z>]")
        height = self.parameters[5063] - sensor["PROBEHEIGHT"] + self.parameters[5000]
        self.execute("G10 L1 P#5400 Z%f" % height)
        self.execute("M72")
        self.execute("G43")
    except Exception as e:
        print("tool_probe_m6:", e)
        self.set_errormsg("tool_probe_m6 remap error.")
        yield INTERP_ERROR
        return
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
