# SPDX-License-Identifier: GPL-2.0-or-later
"""The preview with OpenGL: a widget of kerf.gl, drawn by kerf.glpath."""

import time

from kerf import gl
from kerf.glpath import Renderer


class GLPicture(gl.Frame):
    """Shows scenes (kerf.glpath.Scene). Making it raises RuntimeError or ImportError where OpenGL does not work."""
    kind = "OpenGL"
    began = None             # when the still layer was drawn that is not yet seen

    def __init__(self, parent):
        super().__init__(parent, borderwidth=0, highlightthickness=0, background="", width=300, height=200)
        try:
            library = gl.library()
            self.open()
            self.renderer = Renderer(library)
        except Exception:
            self.destroy()
            raise

    @property
    def exact(self):
        return self.renderer.exact

    def draw_still(self, scene, matrix, width, height, label_size):
        self.window.make_current()
        if self.renderer.resize(width, height):
            self.window.resize(width, height)
        self.began = time.monotonic()
        self.renderer.draw_still(scene, matrix, label_size)

    def step(self):
        """One slice of the exact drawing; True when it is complete."""
        self.window.make_current()
        return self.renderer.step()

    def release(self, drawings):
        """Gives back the driver's copies of the drawings, which the next drawing makes anew. drawings: these are gone
        too, the picture stays as it is."""
        self.window.make_current()
        self.renderer.forget()
        if drawings:
            self.renderer.steps, self.renderer.exact = None, True        # as exact as it will be

    def draw_frame(self, scene, matrix):
        self.window.make_current()
        if not self.renderer.draw_frame(scene, matrix):
            return False
        self.renderer.present()
        self.window.swap()
        if self.began is not None:
            self.renderer.took(time.monotonic() - self.began)
            self.began = None
        return True

    def exposed(self):
        return self.window is not None and self.window.exposed()
