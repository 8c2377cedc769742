#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Buttons of a panel: scan codes of a sampler channel become HAL pins and commands.

panelui [-c CHANNEL] [-n SAMPLES] [-t] [-d] [-v] [FILE]

Buttons are described in _panelui.ini, in $CONFIG_DIR, else here, else in the home directory.
"""

import importlib.util
import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock
from panelui import config, keys, panel

NAME, OWNER = "panelui", "_panel_ui_py_"
POLL_S, PERIODIC_S = 0.01, 0.1
CHANNELS = 8
HANDLERS = ("panelui_handler.py", "handler.py")


def fail(text):
    print(f"ERROR: {text}", file=sys.stderr)
    sys.exit(1)


class Options:
    """channel, samples (0: without end), debug (0 to 2), file"""

    def __init__(self, words):
        self.channel, self.samples, self.debug, self.file = 0, 0, 0, None
        words = list(words)
        while words:
            word = words.pop(0)
            if word in ("-c", "-n"):
                self.count(word, words.pop(0) if words else "")
            elif word == "-d":
                self.debug = max(self.debug, 1)
            elif word == "-v":
                self.debug = 2
            elif word == "-t":
                pass
            elif word.startswith("-"):
                fail(f"unknown option {word}: -c CHANNEL, -n SAMPLES, -t, -d and -v are known")
            elif self.file is None:
                self.file = word
            else:
                fail(f"{word}: one output file is enough ({self.file})")

    def count(self, word, text):
        if not text.isdigit() or (word == "-c" and int(text) >= CHANNELS) or (word == "-n" and int(text) == 0):
            fail(f"{word} {text}: {f'a channel from 0 to {CHANNELS - 1}' if word == '-c' else 'a number above 0'} is expected")
        setattr(self, "channel" if word == "-c" else "samples", int(text))


def find_config():
    places = [os.environ["CONFIG_DIR"]] if os.environ.get("CONFIG_DIR") else []
    places += [os.getcwd(), os.path.expanduser("~")]
    for place in places:
        if os.path.isfile(os.path.join(place, "_panelui.ini")):
            return os.path.join(place, "_panelui.ini")
    fail(f"no _panelui.ini in {', '.join(places)}")


class Caller:
    """Carries out commands: those of the user's handler file first, then our own."""

    def __init__(self, folder, say):
        import linuxcnc
        from panelui.commands import Commands
        self.say = say
        self.commands = Commands(linuxcnc.stat(), linuxcnc.command())
        self.handlers = []
        for name in HANDLERS:
            path = os.path.join(folder, name)
            if os.path.isfile(path):
                self.handlers = self.load(path)
                break

    def load(self, path):
        """get_handlers(stat, command, commands, this) gives objects whose functions are commands."""
        spec = importlib.util.spec_from_file_location("panelui_handler", path)
        module = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
            if not hasattr(module, "get_handlers"):
                fail(f"{path}: a function get_handlers(linuxcnc_stat, linuxcnc_cmd, commands, master) is expected")
            return list(module.get_handlers(self.commands._stat, self.commands._cmd, self.commands, self))
        except Exception as error:
            import traceback
            traceback.print_exc()
            fail(f"{path}: {type(error).__name__}: {error}")

    def find(self, name):
        for owner in (*self.handlers, self.commands):
            for own in dir(owner):
                if own.lower() == name and not own.startswith("_") and callable(getattr(owner, own)):
                    return getattr(owner, own)
        return None

    def check(self, settings):
        """Every command of the file has somebody who knows it."""
        for button in settings.buttons:
            for action in button.commands:
                if button.output == "COMMAND" and action and self.find(action[0].lower()) is None:
                    fail(f"button {button.name}: there is no command {action[0]}")

    def __call__(self, button, name, argument):
        self.say(1, f"{button.name}: {name} {'' if argument is None else argument}")
        try:
            self.find(name)(button, argument)
        except Exception as error:      # of a command, or the user's own: the other buttons live on
            print(f"panelui: {button.name}: {name}: {error}", file=sys.stderr, flush=True)

    def periodic(self):
        for owner in self.handlers:
            if callable(getattr(owner, "periodic", None)):
                try:
                    owner.periodic()
                except Exception as error:
                    print(f"panelui: periodic: {type(error).__name__}: {error}", file=sys.stderr, flush=True)


def make_zmq(settings):
    if not settings.zmq:
        return None
    try:
        return panel.Zmq(settings.topic, settings.socket)
    except ImportError:
        print("panelui: the Python module zmq is missing (python3-zmq): nothing is sent", file=sys.stderr)
    except Exception as error:
        fail(f"[ZMQ_SETUP]SOCKET = {settings.socket}: {error}")


def run(options, stream, board, caller, say):
    keypad = keys.Keypad()
    taken, last = 0, clock.now()
    while not options.samples or taken < options.samples:
        fresh = False
        while not (options.samples and taken >= options.samples) and (record := stream.read()):
            fresh = True
            taken += 1
            try:
                change = keypad.take(record[0])
            except keys.CodeError as error:
                print(f"panelui: {error}", file=sys.stderr, flush=True)
                continue
            if change:
                say(2, f"row {change[0]} column {change[1]} {'pressed' if change[2] else 'released'}")
                board.key(*change)
        if caller:
            caller.commands.periodic()
            if fresh and clock.now() - last >= PERIODIC_S:
                last = clock.now()
                caller.periodic()
        clock.sleep(POLL_S)


def main():
    options = Options(sys.argv[1:])
    path = find_config()
    try:
        settings = config.load(path)
    except (config.ConfigError, OSError) as error:
        fail(error)
    if options.file:
        sys.stdout = open(options.file, "w")

    def say(level, text):
        if options.debug >= level:
            print(f"panelui: {text}", flush=True)

    caller = Caller(os.path.dirname(path), say)
    caller.check(settings)
    # component panelui reads the stream, the other one owns the pins
    component, owner = hal.component(NAME), hal.component(OWNER, settings.prefix)
    try:
        stream = hal.stream(component, hal.sampler_base + options.channel, "u")
    except Exception as error:
        fail(f"channel {options.channel}: {error}: a sampler with cfg=u must be loaded (loadrt sampler "
             "depth=1024 cfg=u)")
    panel.make_pins(owner, settings)
    board = panel.Panel(owner, settings, caller, make_zmq(settings))
    owner.ready()
    component.ready()
    clock.join(NAME, 500)
    run(options, stream, board, caller, say)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
