# SPDX-License-Identifier: GPL-2.0-or-later
"""The buttons: what a key changes, the pins that show it, and the actions that follow."""

import json

import hal

TYPES = {"S32": hal.HAL_S32, "U32": hal.HAL_U32, "FLOAT": hal.HAL_FLOAT, "BIT": hal.HAL_BIT}


def make_pins(component, config):
    """All pins, with the values of buttons that nobody has touched."""
    def new(name, kind):
        component.newpin(name, kind, hal.HAL_OUT)
    for button in config.buttons:
        if button.output in TYPES:
            new(button.name, TYPES[button.output])
            new(button.name + "-not", TYPES[button.output])
        if button.status_pin:
            new(button.name + "-state", hal.HAL_BIT)
            new(button.name + "-state-not", hal.HAL_BIT)
    for group in config.groups:
        new(group.name, TYPES[group.output])
        new(group.name + "-not", TYPES[group.output])


def wrap(value, output):
    """The value as a pin of that type holds it: whole numbers wrap round."""
    if output == "U32":
        return value % 2**32
    return (value + 2**31) % 2**32 - 2**31 if output == "S32" else value


class Zmq:
    """Publishes functions: two parts, the topic and JSON."""

    def __init__(self, topic, address):
        """Raises ImportError, zmq.ZMQError."""
        import zmq
        self.topic = topic.encode()
        self.socket = zmq.Context.instance().socket(zmq.PUB)
        self.socket.bind(address)

    def send(self, name, arguments):
        text = json.dumps({"FUNCTION": name, "ARGS": arguments})
        self.socket.send_multipart([self.topic, text.encode()])


def argument(words):
    """Nothing, one word, or a list: what a command is called with."""
    return None if not words else words[0] if len(words) == 1 else words


class Panel:
    """States of all buttons. command(button, name, argument) and zmq (or None) carry out."""

    def __init__(self, component, config, command, zmq=None):
        self.pins, self.config, self.command, self.zmq = component, config, command, zmq
        self.state = {button.name: button.default for button in config.buttons}
        self.by_key = {button.key: button for button in config.buttons if button.key}
        self.group_of = {button.name: group for group in config.groups for button in group.buttons}
        for button in config.buttons:
            self.show(button)
        for group in config.groups:
            self.show_group(group)

    def key(self, row, column, pressed):
        """A key went down or up."""
        button = self.by_key.get((row, column))
        if button is None:
            return
        if button.kind == "momentary":
            self.change(button, pressed)
        elif pressed and button.kind == "toggle":
            self.toggle(button)
        elif pressed:
            self.choose(button)

    def toggle(self, button):
        """Toggle buttons of one GROUP other than 0 exclude each other."""
        on = not self.state[button.name]
        if on and button.group != "0":
            for other in self.config.buttons:
                if (other.kind == "toggle" and other.group == button.group and other is not button
                        and self.state[other.name]):
                    self.change(other, False)
        self.change(button, on)

    def choose(self, button):
        """One of a group of radio buttons."""
        if self.state[button.name]:
            return
        group = self.group_of[button.name]
        for other in group.buttons:
            if self.state[other.name]:
                self.change(other, False)
        self.change(button, True)
        self.show_group(group)

    def change(self, button, on):
        self.state[button.name] = on
        self.show(button)
        self.act(button, on)

    def act(self, button, on):
        if button.output == "COMMAND" and button.commands[on]:
            name, words = button.commands[on]
            self.command(button, name.lower(), argument(words))
        elif button.output == "ZMQ" and button.functions[on] and self.zmq:
            name, words = button.functions[on]
            self.zmq.send(name, words)

    def show(self, button):
        on = self.state[button.name]
        if button.output in TYPES:
            self.pins[button.name] = button.states[on]
            self.pins[button.name + "-not"] = button.states[not on]
        if button.status_pin:
            self.pins[button.name + "-state"] = on
            self.pins[button.name + "-state-not"] = not on

    def show_group(self, group):
        value = next(b.group_output for b in group.buttons if self.state[b.name])
        self.pins[group.name] = value
        self.pins[group.name + "-not"] = wrap(-value, group.output)
