# SPDX-License-Identifier: GPL-2.0-or-later
"""The XML documents of MTConnect 1.7: probe, streams, assets, errors."""

import re
import xml.etree.ElementTree as ET

from . import models
from .items import agent_items, all_items, rounded
from .observations import SIZE, timestamp
from .settings import LINEAR

VERSION, SENDER, ASSETS = "1.7", "linuxcnc-mtconnect", 1024
EXTENSION = "urn:linuxcnc:mtconnect:1"
SCHEMA = "mtconnect-linuxcnc-1.xsd"
# Modules whose axes stand as their letters say.
STRAIGHT = ("trivkins", "5axiskins", "xyzac-trt-kins", "xyzbc-trt-kins")
VECTORS = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1), "A": (1, 0, 0), "B": (0, 1, 0), "C": (0, 0, 1),
           "U": (1, 0, 0), "V": (0, 1, 0), "W": (0, 0, 1)}


def add(parent, tag, text=None, /, **attributes):
    """A child with those attributes that have a value."""
    child = ET.SubElement(parent, tag,
                          {key: str(value) for key, value in attributes.items() if value not in (None, "")})
    if text is not None:
        child.text = text
    return child


NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # in a program's name, say


def serialize(root):
    ET.indent(root)
    text = NO_XML.sub("\ufffd", ET.tostring(root, encoding="unicode"))
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + text + "\n"


class Documents:
    """Writes all documents of one agent."""

    def __init__(self, settings, meshes, instance):
        self.settings, self.meshes, self.instance = settings, meshes, instance
        self.device_items, self.agent_items = all_items(settings), agent_items(settings)

    def root(self, kind, **header):
        urn = f"urn:mtconnect.org:MTConnect{kind}:{VERSION}"
        root = ET.Element(f"MTConnect{kind}",
                          {"xmlns": urn, "xmlns:m": urn, "xmlns:x": EXTENSION,
                           "xmlns:xsi": "http://www.w3.org/2001/XMLSchema-instance",
                                               "xsi:schemaLocation": f"{EXTENSION} /schemas/{SCHEMA}"})
        add(root, "Header", creationTime=timestamp(), sender=SENDER, instanceId=self.instance, version=VERSION,
            bufferSize=SIZE, assetBufferSize=ASSETS, **header)
        return root

    # ---- probe ----

    def probe(self, asset_count=0):
        settings, root = self.settings, self.root("Devices", assetCount=asset_count)
        devices = add(root, "Devices")
        agent = add(devices, "Agent", id=f"agent_{settings.plain_name}", name="Agent", uuid=f"{settings.uuid}-agent",
                    mtconnectVersion=VERSION)
        self.data_items(agent, self.agent_items)
        device = add(devices, "Device", id=settings.id, name=settings.name, uuid=settings.uuid)
        self.kinematics(add(device, "Description", manufacturer="LinuxCNC"))
        configuration = add(device, "Configuration")
        systems = add(configuration, "CoordinateSystems")
        add(systems, "CoordinateSystem", id="world", type="WORLD")
        add(systems, "CoordinateSystem", id="machine", type="MACHINE", parentIdRef="world")
        self.solid_model(configuration, models.BASE)
        self.data_items(device, self.of(settings.id))
        components = add(device, "Components")
        controller = add(components, "Controller", id="ctrl", name="controller")
        self.data_items(controller, self.of("ctrl"))
        self.data_items(add(add(controller, "Components"), "Path", id="path", name="path"), self.of("path"))
        axes = add(add(components, "Axes", id="axes", name="axes"), "Components")
        for letter in settings.axes:
            self.axis(axes, letter)
        self.spindle(axes)
        self.data_items(add(add(add(components, "Systems", id="systems", name="systems"), "Components"), "Coolant",
                            id="coolant", name="coolant"), self.of("coolant"))
        if self.of("sensors"):
            auxiliaries = add(components, "Auxiliaries", id="auxiliaries", name="auxiliaries")
            self.data_items(add(add(auxiliaries, "Components"), "Sensor", id="sensors", name="sensors"),
                            self.of("sensors"))
        return serialize(root)

    def of(self, component):
        return [item for item in self.device_items if item.component == component]

    def data_items(self, parent, items):
        if not items:
            return
        group = add(parent, "DataItems")
        for item in items:
            add(group, "DataItem", category=item.category, id=item.id, name=item.name, type=item.type,
                subType=item.subtype, units=item.units, nativeUnits=item.native,
                representation="TABLE" if item.table else "")

    def kinematics(self, description):
        s, straight = self.settings, self.settings.module in STRAIGHT
        native = "INCH" if abs(s.mm - 1) > 1e-9 else "MILLIMETER"
        kinematics = add(description, "x:Kinematics", module=s.module, coordinates=s.axes, joints=len(s.joints),
                         linearUnits="MILLIMETER", nativeLinearUnits=native,
                         params=s.module_words)
        joints = add(kinematics, "x:JointMap")
        plain = lambda value: None if value is None else rounded(value)
        for j in s.joints:
            add(joints, "x:Joint", number=j.number, kind=j.kind, axis=j.axis if straight else "",
                min=plain(j.limits[0]), max=plain(j.limits[1]), home=plain(j.home),
                homeOffset=plain(j.home_offset))
        for letter in s.axes:
            low, high = s.axis_limits[letter]
            add(kinematics, "x:Axis", name=letter, kind="LINEAR" if letter in LINEAR else "ROTARY",
                vector=self.vector(letter) if straight else "", min=plain(low), max=plain(high))

    def vector(self, letter):
        sign = -1 if letter in self.meshes.inverted else 1
        return " ".join(str(sign * n + 0) for n in VECTORS[letter])

    def axis(self, parent, letter):
        low, linear = letter.lower(), letter in LINEAR
        component = add(parent, "Linear" if linear else "Rotary", id=f"axis_{low}", name=letter)
        configuration = add(component, "Configuration")
        carrier = self.meshes.parent(letter)
        motion = add(configuration, "Motion", id=f"motion_{low}", type="PRISMATIC" if linear else "REVOLUTE",
                     actuation="DIRECT", coordinateSystemIdRef="machine",
                     parentIdRef=f"motion_{carrier.lower()}" if carrier else "")
        if self.settings.module in STRAIGHT:
            add(motion, "Axis", self.vector(letter))
        self.solid_model(configuration, letter)
        minimum, maximum = self.settings.axis_limits[letter]
        self.specification(configuration, f"axis_{low}_travel", "POSITION" if linear else "ANGLE",
                           "MILLIMETER" if linear else "DEGREE", minimum, maximum)
        self.data_items(component, self.of(f"axis_{low}"))

    def spindle(self, parent):
        component = add(parent, "Rotary", id="spindle", name="S")
        configuration = ET.Element("Configuration")
        carrier = self.meshes.parent(models.SPINDLE)
        if self.meshes.file(models.SPINDLE):
            add(configuration, "Motion", id="motion_spindle", type="CONTINUOUS", actuation="DIRECT",
                coordinateSystemIdRef="machine", parentIdRef=f"motion_{carrier.lower()}" if carrier else "")
            self.solid_model(configuration, models.SPINDLE)
        self.specification(configuration, "spdl_speed_spec", "ROTARY_VELOCITY", "REVOLUTION/MINUTE",
                           *self.settings.spindle_limits)
        if len(configuration):
            component.append(configuration)
        self.data_items(component, self.of("spindle"))

    def specification(self, configuration, identifier, kind, units, low, high):
        if low is None and high is None:
            return
        specification = add(add(configuration, "Specifications"), "Specification", id=identifier,
                            type=kind, units=units)
        if high is not None:
            add(specification, "Maximum", rounded(high))
        if low is not None:
            add(specification, "Minimum", rounded(low))

    def solid_model(self, configuration, part):
        if name := self.meshes.file(part):
            add(configuration, "SolidModel", id=f"model_{part.lower()}", coordinateSystemIdRef="machine",
                mediaType=models.media(name), href=f"/models/{name}", units="MILLIMETER")

    # ---- streams ----

    def streams(self, observations, first, last, following):
        root = self.root("Streams", firstSequence=first, lastSequence=last, nextSequence=following)
        streams = add(root, "Streams")
        by_component = {}
        for seen in observations:
            by_component.setdefault(seen.item.component, []).append(seen)
        agent = f"agent_{self.settings.plain_name}"
        for name, uuid, mine in (("Agent", f"{self.settings.uuid}-agent", lambda c: c == agent),
                                 (self.settings.name, self.settings.uuid, lambda c: c != agent)):
            stream = None
            for component, its in by_component.items():
                if not mine(component):
                    continue
                if stream is None:
                    stream = add(streams, "DeviceStream", name=name, uuid=uuid)
                self.component_stream(stream, component, its)
        return serialize(root)

    def component_stream(self, stream, component, observations):
        kind, name = self.component(component)
        element = add(stream, "ComponentStream", component=kind, name=name, componentId=component)
        for category, tag in (("SAMPLE", "Samples"), ("EVENT", "Events")):
            its = [seen for seen in observations if seen.item.category == category]
            if not its:
                continue
            group = add(element, tag)
            for seen in its:
                self.observation(group, seen)

    def observation(self, group, seen):
        item = seen.item
        attributes = dict(dataItemId=item.id, timestamp=seen.time, sequence=seen.sequence, name=item.name,
                          subType=item.subtype)
        if not isinstance(seen.value, dict):
            add(group, item.element, seen.value, **attributes)
            return
        table = add(group, item.element, count=len(seen.value), **attributes)
        for key, cells in seen.value.items():
            entry = add(table, "Entry", key=key)
            for cell, value in cells.items():
                add(entry, "Cell", value, key=cell)

    def component(self, identifier):
        """(element, name) of a component id."""
        fixed = {self.settings.id: ("Device", self.settings.name), "ctrl": ("Controller", "controller"),
                 "path": ("Path", "path"), "spindle": ("Rotary", "S"),
                 "coolant": ("Coolant", "coolant"), "sensors": ("Sensor", "sensors"),
                 f"agent_{self.settings.plain_name}": ("Agent", "Agent")}
        if identifier in fixed:
            return fixed[identifier]
        letter = identifier.removeprefix("axis_").upper()
        return ("Linear" if letter in LINEAR else "Rotary"), letter

    # ---- assets and errors ----

    def assets(self, tools):
        root = self.root("Assets", assetCount=len(tools))
        group = add(root, "Assets")
        for tool in tools:
            self.cutting_tool(group, tool)
        return serialize(root)

    def asset(self, tool):
        return self.assets([tool])

    def cutting_tool(self, parent, tool):
        s, number = self.settings, tool["toolno"]
        element = add(parent, "CuttingTool", assetId=f"tool-{number}", serialNumber=number, toolId=number,
                      deviceUuid=s.uuid, timestamp=timestamp())
        if tool["comment"].strip():
            add(element, "Description", tool["comment"].strip())
        life = add(element, "CuttingToolLifeCycle")
        add(add(life, "CutterStatus"), "Status", "USED" if tool["used"] else "AVAILABLE")
        add(life, "Location", str(tool["pocketno"]), type="SPINDLE" if tool["used"] else "POT")
        if not (tool["zoffset"] or tool["diameter"]):
            return
        measures = add(life, "Measurements")
        if tool["zoffset"]:
            add(measures, "FunctionalLength", rounded(tool["zoffset"] / s.mm), code="LF", units="MILLIMETER")
        if tool["diameter"]:
            add(measures, "CuttingDiameter", rounded(tool["diameter"] / s.mm), code="DC", units="MILLIMETER")

    def error(self, code, text):
        root = self.root("Error")
        add(add(root, "Errors"), "Error", text, errorCode=code)
        return serialize(root)
