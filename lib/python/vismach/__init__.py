# SPDX-License-Identifier: GPL-2.0-or-later
"""Moving pictures of machines (Vismach): `from vismach import *` in a script that is run by loadusr.

parts   groups, transforms, colours, captures     shapes  primitives of numbers or pins
meshes  STL and OBJ files                         guides  lines, planes and grids that follow pins
hud     texts over the picture                    view    main(): the window, mouse, trace of the tool
"""

import os
import sys
from math import *

import tkinter

import hal
from kerf import gl as _gl

_gl.library()           # PyOpenGL's platform is chosen before its names are taken
from OpenGL.GL import *
from OpenGL.GLU import *

from .guides import (HalCoordsFromNormalAndDirection, HalGrid, HalGridFromNormal,
                     HalGridFromNormalAndDirection, HalLine, HalPlaneFromNormal)
from .hud import Hud
from .meshes import AsciiOBJ, AsciiSTL
from .parts import (Capture, Collection, Color, HalRotate, HalRotateEuler, HalScale, HalShow, HalTranslate,
                    HalVectorRotate, HalVectorTranslate, Rotate, Scale, Track, Translate, invert)
from .shapes import (ArcX, Box, BoxCentered, BoxCenteredXY, CylinderX, CylinderY, CylinderZ, Sphere,
                     TriangleXY, TriangleXZ, TriangleYZ)
from .view import main
