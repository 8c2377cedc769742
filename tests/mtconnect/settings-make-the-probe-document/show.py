# SPDX-License-Identifier: GPL-2.0-or-later
"""A probe document as lines: element and attributes, without what belongs to every machine."""
import sys
import xml.etree.ElementTree as ET

SHOWN = {"Joint", "Axis", "Kinematics", "Motion", "SolidModel", "Specification", "Maximum", "Minimum", "Sensor",
         "Device", "Agent"}
ITEMS = {"t1", "t2", "t3", "t4", "pos_x", "pos_a", "pathfeed", "feedovr", "xyrotation"}
for element in ET.parse(sys.argv[1]).getroot().iter():
    tag = element.tag.rsplit("}", 1)[-1]
    if tag in SHOWN or element.get("id") in ITEMS:
        print(tag, dict(element.attrib), (element.text or "").strip())
