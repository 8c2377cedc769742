# SPDX-License-Identifier: GPL-2.0-or-later
"""OpenGL for screens: whether it works here, in a Tk widget, and off screen.

    reason = gl.Probe().result()        # None: it works, else the reason why not
    frame = gl.Frame(parent); frame.open()
    with gl.OffScreen(640, 480): ...    # tests, thumbnails: no display needed

Drawing itself is done with PyOpenGL (python3-opengl) in a core context of version 3.3.
Environment: KERF_OPENGL=0 never uses it, KERF_OPENGL=1 uses it without the probe.
"""

import os
import subprocess
import sys
import tkinter as tk

PROBE_S = 8.0            # a driver that needs longer is taken as broken


def library(platform="glx"):
    """PyOpenGL's module GL for a platform; the first call of a process decides which."""
    os.environ.setdefault("PYOPENGL_PLATFORM", platform)
    import OpenGL
    OpenGL.ERROR_CHECKING = False
    OpenGL.ERROR_LOGGING = False
    from OpenGL import GL
    return GL


class Probe:
    """Tries OpenGL in a process of its own: a driver that crashes or hangs does no harm to the screen."""

    def __init__(self, against=""):
        """against: a reason not to use it, unless the user insists."""
        choice = os.environ.get("KERF_OPENGL", "")
        self.answer = {"0": "KERF_OPENGL=0", "1": None}.get(choice, against)
        self.child = None
        if self.answer == "":
            path = os.pathsep.join(filter(None, sys.path))       # it finds the modules that we find
            self.child = subprocess.Popen([sys.executable, "-m", "kerf.gl"], stdin=subprocess.DEVNULL,
                                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                          errors="replace", env=os.environ | {"PYTHONPATH": path})

    def result(self):
        """None when it works, else why not. Waits at most PROBE_S."""
        if self.child is not None:
            try:
                told = self.child.communicate(timeout=PROBE_S)[1].strip()
            except subprocess.TimeoutExpired:
                self.child.kill()
                self.child.communicate()
                self.answer = f"no answer within {PROBE_S:g} s"
            else:
                status = self.child.returncode
                self.answer = (None if status == 0 else told.splitlines()[-1] if told
                               else f"the driver ended with status {status}")
            self.child = None
        return self.answer


class Frame(tk.Frame):
    """A widget whose window OpenGL draws in."""

    def __init__(self, parent, **options):
        super().__init__(parent, **options)
        self.window = None

    def open(self, classic=False):
        """Makes the context; a classic one has fixed functions and depth. Raises RuntimeError,
        which says why there is none."""
        import kerf_glx
        self.update_idletasks()
        parent = self.winfo_id()         # made now, if it was not
        self.winfo_pointerx()            # an answer of the X server: it knows the window
        self.window = kerf_glx.Window(self.winfo_screen(), parent, classic)
        self.window.make_current()

    def close(self):
        if self.window is not None:
            self.window.close()
            self.window = None

    def destroy(self):
        self.close()
        super().destroy()


class OffScreen:
    """A context without a display, by OSMesa."""

    def __init__(self, width, height):
        self.size = width, height
        self.gl = library("osmesa")
        from OpenGL import arrays, osmesa
        attributes = arrays.GLintArray.asArray([osmesa.OSMESA_FORMAT, osmesa.OSMESA_RGBA, osmesa.OSMESA_DEPTH_BITS, 24,
                                                osmesa.OSMESA_PROFILE, osmesa.OSMESA_CORE_PROFILE,
                                                osmesa.OSMESA_CONTEXT_MAJOR_VERSION, 3,
                                                osmesa.OSMESA_CONTEXT_MINOR_VERSION, 3, 0])
        self.context = osmesa.OSMesaCreateContextAttribs(attributes, None)
        if not self.context:
            raise RuntimeError("OSMesa makes no context of OpenGL 3.3")
        self.buffer = arrays.GLubyteArray.zeros((height, width, 4))
        self.osmesa = osmesa

    def __enter__(self):
        if not self.osmesa.OSMesaMakeCurrent(self.context, self.buffer, self.gl.GL_UNSIGNED_BYTE, *self.size):
            raise RuntimeError("OSMesa: the context cannot be made current")
        return self

    def __exit__(self, *what):
        self.osmesa.OSMesaDestroyContext(self.context)


def main():
    """The probe: draws one colour and looks whether it arrived."""
    try:
        root = tk.Tk()
        root.withdraw()
        frame = Frame(root, width=16, height=16)
        frame.pack()
        frame.open()
        from kerf.glpath import Renderer
        Renderer(library()).check()
        frame.window.swap()
    except (ImportError, RuntimeError, tk.TclError, AttributeError) as e:
        print(str(e) or type(e).__name__, file=sys.stderr)
        return 1
    os._exit(0)          # drivers that crash while they are unloaded did their work before


if __name__ == "__main__":
    sys.exit(main())
