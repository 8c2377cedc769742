# SPDX-License-Identifier: GPL-2.0-or-later
"""The window of a machine: camera, mouse, trace of the tool."""

import math
import os
import signal
import sys
import tkinter as tk

import hal
import numpy as np
from kerf import gl, tkfit, tkstyle
from OpenGL import GL, GLU

from .hud import Hud
from .parts import invert, tell, visit

REDRAW_MS = 100
MAX_TRACE = 16000
TRACE_COLOR, TRACE_WIDTH = (1, .5, .5), 2
BACKGROUND = 0.08, 0.1, 0.14, 1
SIZE_PX = 600           # of the window, on a usual screen
FIELD_DEG = 30          # of view
ZOOM_STEP = 1.1
MIN_ZOOM, MAX_ZOOM = 0.02, 50


class Camera:
    """Looks at a centre from a distance. lat, lon: degrees about the two vectors; 0 looks down along z, lat -90 along
    y with z up."""

    def __init__(self, size, lat=0, lon=0, vectors=None):
        self.size, self.lat, self.lon = size, lat, lon
        self.vectors = vectors or ((1, 0, 0), (0, 0, 1))
        self.zoom, self.pan_x, self.pan_y = 1.0, 0.0, 0.0
        self.least, self.most = -180, 180

    def rotate(self, dx, dy):
        """Pixels of the mouse."""
        self.lat = min(max(self.lat + dy * 0.5, self.least), self.most)
        self.lon = (self.lon + dx * 0.5) % 360

    def pan(self, dx, dy, height):
        scale = 2 * 3 * self.size * math.tan(math.radians(FIELD_DEG / 2)) / max(height, 1) / self.zoom
        self.pan_x += dx * scale
        self.pan_y -= dy * scale

    def change_zoom(self, factor):
        self.zoom = min(max(self.zoom * factor, MIN_ZOOM), MAX_ZOOM)

    def apply(self, width, height):
        distance = 3 * self.size
        GL.glMatrixMode(GL.GL_PROJECTION)
        GL.glLoadIdentity()
        field = math.degrees(2 * math.atan(math.tan(math.radians(FIELD_DEG / 2)) / self.zoom))
        GLU.gluPerspective(field, width / max(height, 1), 0.01 * self.size, 10 * self.size)
        GL.glMatrixMode(GL.GL_MODELVIEW)
        GL.glLoadIdentity()
        for lamp, place in ((GL.GL_LIGHT0, (1, 2, 3, 0)), (GL.GL_LIGHT1, (-2, -1, 1, 0))):      # go with the eye
            GL.glLightfv(lamp, GL.GL_POSITION, place)
        GL.glTranslated(self.pan_x, self.pan_y, -distance)
        GL.glRotated(self.lat, *self.vectors[0])
        GL.glRotated(self.lon, *self.vectors[1])


class Trace:
    """Where the tool has been in the frame of the work: the last MAX_TRACE points, a block less when it was full."""

    def __init__(self, size):
        """Points nearer than a hundred thousandth of the size are the same (matrices of OpenGL are that exact)."""
        self.rows, self.count, self.near = np.zeros((MAX_TRACE, 3)), 0, size * 1e-5

    @property
    def points(self):
        """Array (n, 3)."""
        return self.rows[:self.count]

    def add(self, tool, work):
        try:
            point = (invert(work.t) @ tool.t @ (0, 0, 0, 1))[:3]
        except np.linalg.LinAlgError:       # the work is scaled to nothing
            return
        if not np.isfinite(point).all() or self.count and (abs(point - self.points[-1]) <= self.near).all():
            return
        if self.count == MAX_TRACE:
            self.count -= MAX_TRACE // 10
            self.rows[:self.count] = self.rows[MAX_TRACE // 10:].copy()
        self.rows[self.count] = point
        self.count += 1

    def clear(self):
        self.count = 0

    def draw(self, work, width=TRACE_WIDTH):
        if self.count < 2:
            return
        GL.glPushAttrib(GL.GL_ENABLE_BIT | GL.GL_CURRENT_BIT | GL.GL_LINE_BIT)
        GL.glDisable(GL.GL_LIGHTING)
        GL.glLineWidth(width)
        GL.glColor3d(*TRACE_COLOR)
        GL.glPushMatrix()
        GL.glLoadMatrixd(np.ascontiguousarray(work.t.T))
        GL.glEnableClientState(GL.GL_VERTEX_ARRAY)
        GL.glVertexPointer(3, GL.GL_DOUBLE, 0, self.rows)
        GL.glDrawArrays(GL.GL_LINE_STRIP, 0, self.count)
        GL.glDisableClientState(GL.GL_VERTEX_ARRAY)
        GL.glPopMatrix()
        GL.glPopAttrib()


class View:
    """The picture in a frame. Raises RuntimeError where there is no OpenGL."""

    def __init__(self, root, model, tool, work, size, hud, lat, lon, vectors=None):
        self.scale = hud.scale = tkstyle.screen_scale(root)
        self.model, self.tool, self.work, self.hud = model, tool, work, hud
        self.camera, self.trace = Camera(size, lat, lon, vectors), Trace(size)
        side = min(round(SIZE_PX * self.scale), *tkfit.room_of(root))
        self.frame = gl.Frame(root, width=side, height=side)
        self.frame.pack(fill="both", expand=True)
        self.frame.open(classic=True)
        self.mouse = None
        for button in (1, 2, 3):
            self.frame.bind(f"<ButtonPress-{button}>", self.grip)
        self.frame.bind("<B1-Motion>", lambda e: self.drag(e, self.camera.rotate if e.state & 1 else
                                                           self.drag_zoom if e.state & 4 else self.pan))
        self.frame.bind("<B2-Motion>", lambda e: self.drag(e, self.camera.rotate))
        self.frame.bind("<B3-Motion>", lambda e: self.drag(e, self.drag_zoom))
        for event in ("<Button-4>", "<Button-5>", "<MouseWheel>"):
            self.frame.bind(event, self.wheel)
        self.frame.bind("<Configure>", lambda _: self.redraw())

    def grip(self, event):
        self.mouse = event.x, event.y

    def drag(self, event, action):
        if self.mouse:
            action(event.x - self.mouse[0], event.y - self.mouse[1])
            self.grip(event)
            self.redraw()

    def pan(self, dx, dy):
        self.camera.pan(dx, dy, self.frame.winfo_height())

    def drag_zoom(self, _dx, dy):
        self.camera.change_zoom(ZOOM_STEP ** (-dy / 10))

    def wheel(self, event):
        self.camera.change_zoom(ZOOM_STEP if event.num == 4 or event.delta > 0 else 1 / ZOOM_STEP)
        self.redraw()

    def paint(self, width, height):
        """Draws all into the present buffer."""
        while GL.glGetIntegerv(GL.GL_MODELVIEW_STACK_DEPTH) > 1:        # a part that failed left its matrix there
            GL.glPopMatrix()
        GL.glViewport(0, 0, width, height)
        GL.glClearColor(*BACKGROUND)
        GL.glClear(GL.GL_COLOR_BUFFER_BIT | GL.GL_DEPTH_BUFFER_BIT)
        for what in (GL.GL_DEPTH_TEST, GL.GL_LIGHTING, GL.GL_LIGHT0, GL.GL_LIGHT1, GL.GL_COLOR_MATERIAL,
                     GL.GL_NORMALIZE, GL.GL_BLEND):
            GL.glEnable(what)
        GL.glBlendFunc(GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA)
        GL.glLightModeli(GL.GL_LIGHT_MODEL_TWO_SIDE, 1)
        GL.glLightModelfv(GL.GL_LIGHT_MODEL_AMBIENT, (.35, .35, .35, 1))
        GL.glLightfv(GL.GL_LIGHT0, GL.GL_DIFFUSE, (.75, .75, .75, 1))
        GL.glLightfv(GL.GL_LIGHT1, GL.GL_DIFFUSE, (.3, .3, .3, 1))
        GL.glLightfv(GL.GL_LIGHT1, GL.GL_SPECULAR, (0, 0, 0, 1))
        GL.glColorMaterial(GL.GL_FRONT_AND_BACK, GL.GL_AMBIENT_AND_DIFFUSE)
        GL.glColor3d(.7, .7, .7)
        self.camera.apply(width, height)
        visit(self.model)
        self.trace.add(self.tool, self.work)
        self.trace.draw(self.work, TRACE_WIDTH * self.scale)
        self.hud.draw(height)

    def redraw(self):
        if self.frame.window is None:
            return
        width, height = max(self.frame.winfo_width(), 1), max(self.frame.winfo_height(), 1)
        self.frame.window.resize(width, height)
        self.frame.window.make_current()
        self.paint(width, height)
        self.frame.window.swap()


def wait_without_a_screen():
    """Keeps the pins of the machine until SIGTERM or SIGINT, so that a configuration starts the same way."""
    print("vismach: no display: pins without a picture", file=sys.stderr)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: sys.exit(0))
    while True:
        signal.pause()


def main(model, tool, work, size=10, hud=0, rotation_vectors=None, lat=0, lon=0):
    """Shows a machine until its window is closed, or SIGTERM or SIGINT come.

    tool, work: captures; their distance is traced. size: of the machine. hud: a Hud, or anything else for none.
    lat, lon: degrees that the view is turned about rotation_vectors (default: x of the screen, z of the machine).
    """
    if not os.environ.get("DISPLAY"):
        wait_without_a_screen()
    try:
        root = tk.Tk(className="vismach")
        root.title(os.path.basename(sys.argv[0]) or "vismach")
        view = View(root, model, tool, work, size, hud if isinstance(hud, Hud) else Hud(), lat, lon, rotation_vectors)
        component = hal.component("vismach")
    except (tk.TclError, RuntimeError, ImportError) as error:
        sys.exit(f"vismach: {error}")
    except hal.error:
        sys.exit("vismach: another vismach program is running: only one can")
    component.newpin("plotclear", hal.HAL_BIT, hal.HAL_IN)
    component.ready()
    ended, was_clear = [], [False]
    for number in (signal.SIGTERM, signal.SIGINT):
        # poll() ends: a signal comes in the middle of anything
        signal.signal(number, lambda *_: ended.append(number))

    def poll():
        if ended:
            root.destroy()
            return
        try:
            clear = component["plotclear"]
            if clear and not was_clear[0]:
                view.trace.clear()
            was_clear[0] = clear
        except RuntimeError as error:       # HAL was unloaded
            print(f"vismach: {error}", file=sys.stderr)
            root.destroy()
            return
        try:
            view.redraw()
        except Exception as error:
            tell(error)
        root.after(REDRAW_MS, poll)
    root.protocol("WM_DELETE_WINDOW", root.destroy)
    poll()
    try:
        root.mainloop()
    finally:
        component.exit()
