# SPDX-License-Identifier: GPL-2.0-or-later
"""What a button may ask of LinuxCNC. Every public function of Commands is called with the button and its argument:
nothing (None), one word, or a list of words. ValueError says what is wrong with them."""

import linuxcnc

START_RPM, STEP_RPM = 100, 100
LETTERS = "xyzabcuvw"
ANGULAR = (3, 4, 5)
TEXT_WORDS = {"true": 1, "on": 1, "yes": 1, "false": 0, "off": 0, "no": 0}


def number(argument, what, default=None):
    if argument is None and default is not None:
        return default
    try:
        value = float(argument)
        if value == value and abs(value) != float("inf"):
            return value
    except (TypeError, ValueError):
        pass
    raise ValueError(f"{what} is expected, not {argument!r}")


def flag(argument):
    """0 or 1, or None: the other state is wanted."""
    if argument is None:
        return None
    word = str(argument).lower()
    return TEXT_WORDS[word] if word in TEXT_WORDS else int(bool(number(argument, "0 or 1")))


def words(argument, count, what):
    if not isinstance(argument, list) or len(argument) != count:
        raise ValueError(f"{what} are expected, not {argument!r}")
    return argument


def axis_number(word):
    """0 to 8, or a letter."""
    if str(word).lower() in LETTERS:
        return LETTERS.index(str(word).lower())
    value = number(word, "an axis (0 to 8 or its letter)")
    if value not in range(9):
        raise ValueError(f"an axis (0 to 8 or its letter) is expected, not {word!r}")
    return int(value)


class Commands:
    """stat, command: of the module linuxcnc. periodic() ends what takes time."""

    def __init__(self, stat=None, command=None):
        self._stat, self._cmd = stat or linuxcnc.stat(), command or linuxcnc.command()
        self._line = 0
        self._single = False
        self._linear, self._angular = 15.0 / 60, 3600.0 / 60     # units/s, degrees/s
        self._jogged = set()            # (joint mode, number) of continuous jogs
        self._mode_after = None         # to return to when MDI is done
        self._mdi_serial = None

    # -- state ---------------------------------------------------------------------

    def jogging(self, _button=None, _argument=None):
        """Whether a continuous jog of the panel goes on."""
        return bool(self._jogged)

    def mdi_active(self, _button=None, _argument=None):
        """Whether a line of MDI is carried out."""
        self._stat.poll()
        return self._stat.task_mode == linuxcnc.MODE_MDI and self._stat.interp_state != linuxcnc.INTERP_IDLE

    def periodic(self):
        """Goes back to the mode before mdi_and_return once its line is done."""
        if self._mode_after is None:
            return
        self._stat.poll()
        if self._stat.task_mode != linuxcnc.MODE_MDI:        # someone else changed it
            self._mode_after = None
        elif self._stat.echo_serial_number >= self._mdi_serial and self._stat.interp_state == linuxcnc.INTERP_IDLE \
                and self._stat.exec_state == linuxcnc.EXEC_DONE:
            self._cmd.mode(self._mode_after)
            self._mode_after = None

    def _running(self):
        self._stat.poll()
        return self._stat.task_mode == linuxcnc.MODE_AUTO and self._stat.interp_state != linuxcnc.INTERP_IDLE

    def _to_mode(self, mode):
        """The mode, unless a program or MDI line is at work."""
        self._stat.poll()
        if self._stat.task_mode == mode:
            return
        if self._stat.interp_state != linuxcnc.INTERP_IDLE:
            raise ValueError("not while a program or an MDI line is at work")
        self._cmd.mode(mode)
        self._cmd.wait_complete()
        self._stat.poll()

    # -- machine -------------------------------------------------------------------

    def estop(self, _button, _argument):
        self._cmd.state(linuxcnc.STATE_ESTOP)

    def estop_reset(self, _button, _argument):
        self._cmd.state(linuxcnc.STATE_ESTOP_RESET)

    def machine_on(self, _button, _argument):
        self._cmd.state(linuxcnc.STATE_ON)

    def machine_off(self, _button, _argument):
        self._cmd.state(linuxcnc.STATE_OFF)

    def mist_on(self, _button, _argument):
        self._cmd.mist(1)

    def mist_off(self, _button, _argument):
        self._cmd.mist(0)

    def flood_on(self, _button, _argument):
        self._cmd.flood(1)

    def flood_off(self, _button, _argument):
        self._cmd.flood(0)

    def reload_tooltable(self, _button, _argument):
        self._cmd.load_tool_table()

    # -- joints --------------------------------------------------------------------

    def _home(self, joint, function):
        self._to_mode(linuxcnc.MODE_MANUAL)
        self._cmd.teleop_enable(0)
        self._cmd.wait_complete()
        function(joint)

    def home_all(self, _button, _argument):
        self._home(-1, self._cmd.home)

    def unhome_all(self, _button, _argument):
        self._home(-1, self._cmd.unhome)

    def home_selected(self, _button, argument):
        self._home(int(number(argument, "a joint")), self._cmd.home)

    def unhome_selected(self, _button, argument):
        self._home(int(number(argument, "a joint")), self._cmd.unhome)

    def override_limits(self, _button, _argument):
        self._cmd.override_limits()

    def set_linear_jog_velocity(self, _button, argument):
        """units a minute"""
        self._linear = abs(number(argument, "a velocity (units/min)")) / 60

    def set_angular_jog_velocity(self, _button, argument):
        """degrees a minute"""
        self._angular = abs(number(argument, "a velocity (degrees/min)")) / 60

    def _jog_target(self, axis):
        """(1 for a joint or 0 for an axis, its number) as motion moves now."""
        self._to_mode(linuxcnc.MODE_MANUAL)
        joint = self._stat.motion_mode == linuxcnc.TRAJ_MODE_FREE
        return int(joint), axis

    def _velocity(self, axis, direction):
        speed = self._angular if axis in ANGULAR else self._linear
        return speed if direction > 0 else -speed

    def continuous_jog(self, _button, argument):
        """[axis, direction]: 1 or -1, and 0 to stop."""
        axis, direction = words(argument, 2, "axis and direction")
        axis, direction = axis_number(axis), number(direction, "a direction (1, 0 or -1)")
        if direction == 0:
            for target in [t for t in self._jogged if t[1] == axis]:
                self._cmd.jog(linuxcnc.JOG_STOP, *target)
                self._jogged.discard(target)
            return
        target = self._jog_target(axis)
        self._jogged.add(target)
        self._cmd.jog(linuxcnc.JOG_CONTINUOUS, *target, self._velocity(axis, direction))

    def incremental_jog(self, _button, argument):
        """[axis, direction, distance]"""
        axis, direction, distance = words(argument, 3, "axis, direction and distance")
        axis, direction = axis_number(axis), number(direction, "a direction (1 or -1)")
        if direction == 0:
            return
        self._cmd.jog(linuxcnc.JOG_INCREMENT, *self._jog_target(axis), self._velocity(axis, direction),
                      abs(number(distance, "a distance")))

    def quill_up(self, _button, _argument):
        """Z to the machine's zero."""
        self.mdi_and_return(_button, "G53 G0 Z0")

    # -- spindle -------------------------------------------------------------------

    def _spindle_speed(self):
        self._stat.poll()
        return self._stat.spindle[0]["speed"]

    def _spindle(self, direction, argument):
        rpm = abs(number(argument, "a speed (rpm)", START_RPM))
        self._cmd.spindle(linuxcnc.SPINDLE_FORWARD if direction > 0 else linuxcnc.SPINDLE_REVERSE, rpm)

    def spindle_forward(self, _button, argument):
        self._spindle(1, argument)

    def spindle_reverse(self, _button, argument):
        self._spindle(-1, argument)

    def spindle_forward_adjust(self, _button, argument):
        """Starts forward; faster when it runs so, slower when it runs backward."""
        self._adjust(1, argument)

    def spindle_reverse_adjust(self, _button, argument):
        self._adjust(-1, argument)

    def _adjust(self, direction, argument):
        speed = self._spindle_speed()
        if speed == 0:
            self._spindle(direction, argument)
        elif speed * direction > 0:
            self.spindle_faster(None, None)
        else:
            self.spindle_slower(None, None)

    def spindle_stop(self, _button, _argument):
        self._cmd.spindle(linuxcnc.SPINDLE_OFF)

    def spindle_faster(self, _button, _argument):
        speed = self._spindle_speed()
        if speed:
            self._spindle(speed, abs(speed) + STEP_RPM)

    def spindle_slower(self, _button, _argument):
        """Not below one step."""
        speed = self._spindle_speed()
        if speed:
            self._spindle(speed, max(abs(speed) - STEP_RPM, STEP_RPM))

    # -- overrides -----------------------------------------------------------------

    def feed_hold(self, _button, argument):
        wanted = flag(argument)
        self._stat.poll()
        self._cmd.set_feed_hold(int(not self._stat.feed_hold_enabled) if wanted is None else wanted)

    def feed_override(self, _button, argument):
        self._cmd.feedrate(number(argument, "a rate (1 is 100 %)"))

    def rapid_override(self, _button, argument):
        self._cmd.rapidrate(number(argument, "a rate (1 is 100 %)"))

    def spindle_override(self, _button, argument):
        self._cmd.spindleoverride(number(argument, "a rate (1 is 100 %)"))

    def max_velocity(self, _button, argument):
        self._cmd.maxvel(number(argument, "a velocity (units/s)"))

    def optional_stop(self, _button, argument):
        wanted = flag(argument)
        self._stat.poll()
        self._cmd.set_optional_stop(int(not self._stat.optional_stop) if wanted is None else wanted)

    def block_delete(self, _button, argument):
        wanted = flag(argument)
        self._stat.poll()
        self._cmd.set_block_delete(int(not self._stat.block_delete) if wanted is None else wanted)

    # -- programs ------------------------------------------------------------------

    def abort(self, _button, _argument):
        self._jogged.clear()
        self._cmd.abort()

    def pause(self, _button, _argument):
        self._cmd.auto(linuxcnc.AUTO_PAUSE)

    def resume(self, _button, _argument):
        self._cmd.auto(linuxcnc.AUTO_RESUME)

    def single_block(self, _button, argument):
        wanted = flag(argument)
        self._single = not self._single if wanted is None else bool(wanted)

    def set_restart_line(self, _button, argument):
        """Where the next start begins."""
        self._line = int(number(argument, "a line"))

    def smart_cycle_start(self, _button, _argument):
        """Starts the program; in single block mode, or paused, goes on."""
        self._stat.poll()
        running, paused = self._running(), bool(self._stat.paused)
        if self._single:
            if not running:
                self._to_mode(linuxcnc.MODE_AUTO)
            self._cmd.auto(linuxcnc.AUTO_STEP)
        elif running and paused:
            self._cmd.auto(linuxcnc.AUTO_RESUME)
        elif not running:
            self.re_start(None, self._line)
            self._line = 0

    def re_start(self, _button, argument):
        """Runs from a line."""
        line = int(number(argument, "a line"))
        if self._running():
            return
        self._to_mode(linuxcnc.MODE_AUTO)
        self._cmd.auto(linuxcnc.AUTO_RUN, line)

    def _line_of(self, argument):
        """A line of G-code; commas had made a list of it."""
        if not argument:
            raise ValueError("a line of G-code is expected")
        return ",".join(map(str, argument)) if isinstance(argument, list) else str(argument)

    def mdi(self, _button, argument):
        line = self._line_of(argument)
        self._to_mode(linuxcnc.MODE_MDI)
        self._cmd.mdi(line)

    def mdi_and_return(self, _button, argument):
        """The mode comes back when the line is done."""
        line = self._line_of(argument)
        self._stat.poll()
        before = self._stat.task_mode if self._mode_after is None else self._mode_after
        self._to_mode(linuxcnc.MODE_MDI)
        self._cmd.mdi(line)
        self._mdi_serial = self._cmd.serial
        self._mode_after = before if before != linuxcnc.MODE_MDI else None
