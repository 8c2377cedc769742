# SPDX-License-Identifier: GPL-2.0-or-later
"""The preview as a widget: mouse, views, when what is drawn.

Scenes are made by compose; a picture shows them: with OpenGL (glpicture) or drawn in memory (drawn).
"""

import tkinter as tk

from .camera import LATHE
from .compose import Composer, plot_colours, rgb

SETTLE_MS = 120          # after the last change of the view the exact picture begins
STEP_MS = 2


class Preview(Composer, tk.Frame):
    """options: an object with the screen's variables; logger: linuxcnc.positionlogger; text_px: height of letters."""

    def __init__(self, parent, settings, options, logger, text_px=13):
        # X resources: *Togl.NAME
        tk.Frame.__init__(self, parent, class_="Togl", background="#000000", width=300, height=200, borderwidth=0)
        Composer.__init__(self, settings, options, logger, text_px)
        self.read_resources()
        self.scene.back = rgb(self.colours["back"])
        self.dirty = True
        self.pending = self.settling = None
        self.on_select = lambda line: None
        self.picture = None
        self.show_with(None)

    def show_with(self, reason):
        """Uses OpenGL when `reason` is None, else the drawn picture. Returns why OpenGL is not used."""
        from .drawn import DrawnPicture
        made = None
        if reason is None and self.picture is not None:
            try:
                from .glpicture import GLPicture
                made = GLPicture(self)
            except (ImportError, RuntimeError, AttributeError, tk.TclError) as e:
                reason = str(e)
        if made is None and self.picture is not None:
            return reason
        if self.picture is not None:
            self.picture.destroy()
        self.picture = made or DrawnPicture(self)
        self.picture.place(x=0, y=0, relwidth=1, relheight=1)
        self.bind_mouse(self.picture)
        self.picture.bind("<Configure>", lambda event: self.invalidate())
        self.picture.bind("<Expose>", lambda event: self.redraw_soon())
        self.invalidate()
        return reason

    def read_resources(self):
        for name in self.colours:
            given = self.option_get(name, name.capitalize())
            if given:
                try:
                    self.colours[name] = "#%02x%02x%02x" % tuple(c >> 8 for c in self.winfo_rgb(given))
                except tk.TclError:
                    print(f"axis: *Togl.{name}: {given} is no colour")
        for name in self.alpha:
            try:
                self.alpha[name] = min(1.0,
                                       max(0.0, float(self.option_get(name, name.capitalize()) or self.alpha[name])))
            except ValueError:
                print(f"axis: *Togl.{name} is no number")
        self.logger.set_colors(*plot_colours(self.colours, self.alpha))

    # -- mouse -----------------------------------------------------------------------------

    def bind_mouse(self, widget):
        self.drag = None
        for button, kind in ((1, "left"), (2, "rotate"), (3, "zoom")):
            widget.bind(f"<Button-{button}>", lambda e, k=kind: self.press(e, k))
            widget.bind(f"<B{button}-Motion>", self.move)
            widget.bind(f"<ButtonRelease-{button}>", self.release)
        widget.bind("<Button-4>", lambda e: self.zoomin())
        widget.bind("<Button-5>", lambda e: self.zoomout())

    def press(self, event, kind):
        turning = bool(self.options.rotate_mode)
        if kind == "left":
            kind = "rotate" if turning else "pan"
            if event.state & 1:
                kind = "pan" if turning else "rotate"
            elif event.state & 4:
                kind = "zoom"
        elif kind == "rotate" and turning:
            kind = "pan"
        if kind == "rotate" and self.s.lathe:
            kind = "pan"
        self.drag = [kind, event.x, event.y, event.num == 1]

    def move(self, event):
        if not self.drag:
            return
        kind, x, y, _ = self.drag
        dx, dy = event.x - x, event.y - y
        if self.drag[3] and abs(dx) + abs(dy) < 3:
            return
        self.drag[1:] = [event.x, event.y, False]
        if kind == "pan":
            self.camera.pan(dx, dy, self.winfo_width(), self.winfo_height())
        elif kind == "rotate":
            self.camera.rotate(dx, dy)
        else:
            self.camera.zoom_by_drag(dy)
        self.view_changed()

    def release(self, event):
        drag, self.drag = self.drag, None
        if drag and drag[0] == "rotate" and not drag[3]:
            self.camera.end_rotation()
            self.view_changed()
        elif drag and drag[3]:
            self.on_select(self.line_at(event.x, event.y))

    def line_at(self, x, y):
        """Program line under a pixel, or -1."""
        if not self.options.show_program:
            return -1
        w, h = self.winfo_width(), self.winfo_height()
        shown = 7 if self.options.show_rapids else 6
        for drawing in self.drawings:
            line = drawing.pick(self.camera.matrix(w, h), w, h, x, y, 5.0, shown)
            if line >= 0:
                return line
        return -1

    # -- views -----------------------------------------------------------------------------

    def set_view(self, name):
        self.camera.set_view(LATHE.get(name, name) if self.s.lathe else name)
        self.fit()

    def fit(self):
        """Centres on the program, or on the machine's limits when there is none."""
        self.camera.fit(*self.shown_box())
        self.view_changed()

    def view_changed(self):
        self.options.view_type = self.camera.number
        self.invalidate()

    def centre_on_line(self, line):
        """Moves the centre of the view to the mean of the ends of what a source line draws."""
        ends = [d.vertices[v, i] for d in self.drawings for first, last in d.spans(line) for v in (first, last - 1)
                for i in range(3)]
        if ends:
            self.camera.centre = [sum(ends[i::3]) / (len(ends) // 3) for i in range(3)]
            self.view_changed()

    def zoomin(self):
        self.camera.zoom_in()
        self.view_changed()

    def zoomout(self):
        self.camera.zoom_out()
        self.view_changed()

    # -- drawing ---------------------------------------------------------------------------

    def set_program(self, program, drawings, boxed=False):
        Composer.set_program(self, program, drawings, boxed)
        self.view_changed()

    def drop_program(self, drawings):
        """Before another program is read: only one of a million lines is in memory at a time. drawings: also what
        the picture is made of, which stays as it is until it has to be drawn anew."""
        if drawings:
            self.drawings = []
            self.scene.drawings = self.scene.palettes = []
        self.picture.release(drawings)

    def clear_plot(self):
        self.logger.clear()
        self.invalidate()

    def invalidate(self):
        """The still layer must be drawn anew."""
        self.dirty = True
        self.redraw_soon()

    def redraw_soon(self):
        if self.pending is None:
            self.pending = self.after_idle(self.redraw)

    def redraw(self):
        self.pending = None
        w, h = self.winfo_width(), self.winfo_height()
        if w < 10 or h < 10 or not self.winfo_viewable():
            return
        matrix = self.camera.matrix(w, h)
        for _ in range(2):
            if self.dirty:
                self.dirty = False
                self.compose(w, h, matrix)
                self.picture.draw_still(self.scene, matrix, w, h, self.text_px)
                self.settle()
            user_plot = getattr(self, "user_plot", None)
            if user_plot:
                try:
                    user_plot()
                except Exception:       # a user's drawing never stops the screen
                    pass
            self.compose_live(w, h, matrix)
            if self.picture.draw_frame(self.scene, matrix):
                return
            self.dirty = True           # the plot was shortened

    def settle(self):
        """After a while without changes the exact picture is drawn, slice by slice."""
        if self.settling is not None:
            self.after_cancel(self.settling)
            self.settling = None
        if not self.picture.exact:
            self.settling = self.after(SETTLE_MS, self.refine)

    def refine(self):
        self.settling = None
        if self.dirty or self.picture.exact:
            return
        if self.picture.step():
            self.redraw_soon()
        else:
            self.settling = self.after(STEP_MS, self.refine)

    def look(self):
        """For the update cycle: parts of the window that were covered are drawn again."""
        if self.picture.exposed():
            self.redraw_soon()

    def destroy(self):
        for waiting in (self.pending, self.settling):
            if waiting is not None:
                self.after_cancel(waiting)
        self.pending = self.settling = None
        super().destroy()
