# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes a panel of widgets with HAL pins from an XML file (PyVCP).

    vcpparse.filename = "panel.xml"
    vcpparse.create_vcp(frame, component)       # then component.ready()

Mistakes in the file end the program (SystemExit) with a text that names file and line.
"""

import inspect
import os
import sys
import time
import tkinter
from xml.parsers import expat

import hal
import pyvcp_widgets

POLL_MS = 100
EVALUATED = "{[(\"'"       # an attribute that begins with one of these is a Python expression

filename = None             # of the next create_vcp()
numbers = {}                # what its widgets begin with instead of initval, by full name of the pin


class Element:
    """An element of the file: name, attributes, text, children, and the line where it begins."""

    def __init__(self, name, attributes, line):
        self.name, self.attributes, self.line = name, attributes, line
        self.text, self.children = "", []


class NoPanel(Exception):
    """The root element of the file is no pyvcp."""


def read(path):
    """The root element pyvcp of a file. Raises OSError, NoPanel, and SystemExit where the XML is broken."""
    parser = expat.ParserCreate()
    top = Element("", {}, 0)
    opened = [top]

    def start(name, attributes):
        element = Element(name, attributes, parser.CurrentLineNumber)
        opened[-1].children.append(element)
        opened.append(element)

    def end(_name):
        opened.pop()

    def text(data):
        opened[-1].text += data
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, text
    with open(path, "rb") as file:
        try:
            parser.ParseFile(file)
        except expat.ExpatError as error:
            raise SystemExit(f"Error: could not open {path} !\n{path}:{error.lineno}:{error.offset + 1}: "
                             f"{expat.ErrorString(error.code)}") from None
    root = top.children[0]
    if root.name != "pyvcp":
        raise NoPanel("Error: no pyvcp element in file!")
    return root


def names():
    """What expressions of the file may use: all of tkinter without its name before it, some modules."""
    modules = {"hal": hal, "os": os, "pyvcp_widgets": pyvcp_widgets, "sys": sys, "time": time, "tkinter": tkinter,
               "Tkinter": tkinter}
    return {n: value for n, value in vars(tkinter).items() if not n.startswith("_")} | modules


def attribute(text):
    if text[:1] and text[0] in EVALUATED:
        return eval(text, names())          # the file's author may run Python: that is how options are written
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def as_numbers(make, options):
    """The options with numbers where the widget wants numbers: they may stand in quotes, like Tk's own."""
    maybe = getattr(make, "NUMBERS", ())
    for name, parameter in inspect.signature(make).parameters.items():
        if (type(parameter.default) in (int, float) or name in maybe) and isinstance(options.get(name), str):
            value = float(options[name])
            options[name] = int(value) if value.is_integer() else value
    return options


class Builder:
    """Makes the widgets of a file and of those it includes."""

    def __init__(self, component):
        self.component = component
        self.panel = pyvcp_widgets.Panel(component, self.include, numbers)
        self.files = []

    def place(self, element):
        return f"{self.files[-1]}:{element.line}"

    def build(self, path, master, container=None):
        """All widgets of a file in master, or in a container with add()."""
        if os.path.abspath(path) in map(os.path.abspath, self.files):
            raise SystemExit(f"{path}: includes itself")
        root = read(path)
        self.files.append(path)
        for element in root.children:
            self.element(element, master, container)
        self.files.pop()

    def options(self, element):
        """Attributes and option elements, evaluated."""
        found = {}
        steps = [(name, text, attribute) for name, text in element.attributes.items()]
        steps += [(child.name, child.text.strip(), lambda text: eval(text, names())) for child in element.children
                  if child.name not in pyvcp_widgets.ELEMENTS]
        for name, text, value_of in steps:
            try:
                found[name] = value_of(text)
            except Exception as error:
                raise SystemExit(f"Error evaluating xml file:\nWidget {element.name}, Property {name}\n"
                                 f"{type(error).__name__}: {error}\n{self.place(element)}") from None
        return found

    def warn(self, element, text):
        print(f"{self.place(element)}: {text}", file=sys.stderr)

    def element(self, element, master, container):
        """A widget with its children, or what a directive says. Between widgets, what is no element of a panel is
        passed over."""
        make = pyvcp_widgets.ELEMENTS.get(element.name)
        if make is None:
            self.warn(element, f"<{element.name}> is no element of panels, it and all in it are left out; known: "
                      f"{', '.join(sorted(pyvcp_widgets.ELEMENTS))}")
            return
        options = self.options(element)
        try:
            self.made(element, make(master, self.panel, **as_numbers(make, dict(options))), options, container)
        except SystemExit:
            raise
        except Exception as error:
            raise SystemExit(f"Error constructing {element.name}({options}):\n{error}\n{self.place(element)}") from None

    def made(self, element, widget, options, container):
        """Places a widget and makes its children."""
        if unknown := getattr(widget, "unknown", None):
            self.warn(element, f"<{element.name}> has no option {', '.join(unknown)}")
        if isinstance(widget, pyvcp_widgets.Directive):
            if container is not None:
                widget.apply(container)
        elif isinstance(widget, tkinter.Misc):
            if container is None:
                widget.pack(side="top", fill="both", expand="yes")
            else:
                container.add(widget)
            pyvcp_widgets.keep_readable(widget, options)
            self.panel.widgets.append(widget)
        inner = [child for child in element.children if child.name in pyvcp_widgets.ELEMENTS]
        if inner and not hasattr(widget, "add"):
            raise SystemExit(f"{self.place(inner[0])}: <{inner[0].name}> cannot stand in "
                             f"<{element.name}>: a vbox, hbox, "
                             "labelframe, table or tabs around both holds them")
        for child in inner:
            self.element(child, widget.holder(), widget)

    def include(self, widget, source, prefix):
        """Fills an include with the panel of another file."""
        beside = os.path.join(os.path.dirname(self.files[-1]), source)
        path = beside if os.path.exists(beside) else source
        before = self.component.getprefix()
        if prefix:
            self.component.setprefix(prefix)
        try:
            self.build(path, widget, widget)
        except (OSError, NoPanel) as error:
            raise ValueError(f"{path}: {getattr(error, 'strerror', None) or error}") from None
        finally:
            self.component.setprefix(before)


def gone(window):
    """The window was closed, or its display."""
    try:
        return not window.winfo_exists()
    except tkinter.TclError:
        return True


def create_vcp(master, component=None, path=None):
    """Makes the panel of `filename` in master and keeps it up to date. The component gets the pins; without one, a
    component pyvcp is made. Raises SystemExit (mistakes in the file), NoPanel, OSError."""
    if component is None:
        component = hal.component("pyvcp")
    builder = Builder(component)
    builder.build(path or filename, master)

    def poll():
        for widget in builder.panel.widgets:
            try:
                if hasattr(widget, "follow"):
                    widget.follow()
                if hasattr(widget, "tint"):
                    widget.tint()
            except (RuntimeError, hal.error) as error:      # the component has left HAL
                print(f"pyvcp: {error}")
                return
            except Exception as error:      # one widget's fault stops no other
                if gone(master):
                    return
                if widget not in told:
                    told.add(widget)
                    print(f"pyvcp: {type(widget).__name__.lower()}: {error}", file=sys.stderr)
        waiting[:] = [master.after(POLL_MS, poll)]

    def ended(event):
        """The panel goes: nothing is looked at any more."""
        if event.widget is master and waiting:
            master.after_cancel(waiting.pop())
    waiting, told = [], set()
    poll()
    master.bind("<Destroy>", ended, "+")
    return component
