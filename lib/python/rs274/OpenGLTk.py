# SPDX-License-Identifier: GPL-2.0-or-later
"""Tk widgets with an OpenGL 3.3 context, for previews of one's own:

    class View(OpenGLTk.Opengl, GlCanonDraw):
        def __init__(self, master):
            OpenGLTk.Opengl.__init__(self, master, width=400, height=300)
            GlCanonDraw.__init__(self, linuxcnc.stat())

redraw() of the class that has both is called when the window shows and when the mouse has moved the view.
"""

from kerf import gl

# of other widgets for OpenGL: the context has what is needed
TOGL_OPTIONS = ("accum", "alpha", "auxbuffers", "depth", "double", "ident", "indirect", "overlay", "rgba",
                "sharecontext", "sharelist", "stencil", "stereo", "time")


class RawOpengl(gl.Frame):
    """A window that redraw() draws. Opening it raises RuntimeError where there is no OpenGL."""

    def __init__(self, master=None, cnf=None, **kw):
        wanted = {name.lstrip("-"): value for name, value in ((cnf or {}) | kw).items()}
        super().__init__(master, background="",
                         **{name: value for name, value in wanted.items() if name not in TOGL_OPTIONS})
        self.bind("<Map>", self.tkMap)
        self.bind("<Expose>", self.tkExpose)
        self.bind("<Configure>", self.tkExpose)

    def makecurrent(self):
        if self.window is None:
            self.open()
        self.window.make_current()
        self.window.resize(max(self.winfo_width(), 1), max(self.winfo_height(), 1))

    def swapbuffers(self):
        self.window.swap()

    def tkMap(self, *_event):
        self.tkRedraw()

    def tkExpose(self, *_event):
        self.tkRedraw()

    def tkRedraw(self, *_event):
        redraw = getattr(self, "redraw", None)
        if redraw is not None and self.winfo_ismapped():
            self.makecurrent()
            redraw()


class Opengl(RawOpengl):
    """The mouse moves the view: left drag pans, middle or Shift and left rotates, right or Control and left and the
    wheel zoom; the class that draws has pan(dx, dy) and rotate(dx, dy) in pixels, zoom(factor). A click calls
    select(x, y)."""

    def __init__(self, master=None, cnf=None, **kw):
        super().__init__(master, cnf, **kw)
        self.mouse = self.pressed = None
        for button in (1, 2, 3):
            self.bind(f"<ButtonPress-{button}>", self.tkRecordMouse)
        self.bind("<B1-Motion>", self.tkTranslate)
        self.bind("<Shift-B1-Motion>", self.tkRotate)
        self.bind("<B2-Motion>", self.tkRotate)
        self.bind("<Control-B1-Motion>", self.tkScale)
        self.bind("<B3-Motion>", self.tkScale)
        self.bind("<Button-4>", self.tkZoomin)
        self.bind("<Button-5>", self.tkZoomout)
        self.bind("<ButtonRelease-1>", self.tkHandlePick)

    def activate(self):
        self.makecurrent()
        return True

    def deactivate(self):
        """The next one that draws makes its own context current."""

    def tkRecordMouse(self, event):
        self.mouse = self.pressed = event.x, event.y

    def drag(self, event, name, *values):
        """Calls a method of the class that draws, if it has it, and draws."""
        action = getattr(self, name, None)
        if action is not None:
            action(*values)
            self.tkRedraw()
        self.mouse = event.x, event.y

    def tkTranslate(self, event):
        self.drag(event, "pan", event.x - self.mouse[0], event.y - self.mouse[1])

    def tkRotate(self, event):
        self.drag(event, "rotate", event.x - self.mouse[0], event.y - self.mouse[1])

    def tkScale(self, event):
        self.drag(event, "zoom", 1.25 ** ((event.y - self.mouse[1]) / 16))

    def tkZoomin(self, event):
        self.drag(event, "zoom", 1 / 1.1)

    def tkZoomout(self, event):
        self.drag(event, "zoom", 1.1)

    def tkHandlePick(self, event):
        if self.pressed == (event.x, event.y):
            self.drag(event, "select", event.x, event.y)
