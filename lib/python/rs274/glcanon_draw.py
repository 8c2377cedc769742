# SPDX-License-Identifier: GPL-2.0-or-later
"""GlCanonDraw: a preview for screens of any toolkit that have a widget with an OpenGL 3.3 context.

    class View(SomeWidget, GlCanonDraw):
        def __init__(self, ...):
            GlCanonDraw.__init__(self, linuxcnc.stat(), linuxcnc.positionlogger(...))
            self.init_glcanondraw("XYZ")
        def activate(self): ...         # makes the context current; True
        def deactivate(self): ...
        def swapbuffers(self): ...
        def winfo_width(self): ...      # pixels; winfo_height() likewise
        def get_show_extents(self): return False        # and the other get_*(), where the default does not fit

load_preview(file, canon, *initcodes) reads a program, redraw() draws. Lengths are inches where nothing else is said.
The scene and the drawing are those of AXIS (axis.compose, kerf.glpath).
"""

from types import SimpleNamespace

import gcode
import kerf_raster
import numpy as np
from axis.compose import ALPHA, COLOURS, Composer
from axis.dro import Readout
from axis.settings import LETTERS, MM_PER_INCH
from kerf.glpath import Renderer

VIEWS = "x", "y", "z", "p"          # of get_view()
CONE_BASESIZE = 0.5
PLOT = (("jog", (1., 1., 0.), .75), ("traverse", (.3, .5, .5), .25), ("feed", (.75, .25, .25), .75),
        ("arc", (.75, .25, .5), .75), ("toolchange", (1., .65, 0.), .25), ("probing", (.63, .13, .94), .75))
PICK_PX = 5.0
LETTER_PX = 13


def shares(text):
    """#rrggbb as shares of 1."""
    return tuple(int(text[n:n + 2], 16) / 255 for n in (1, 3, 5))


class Recorded:
    """What a canon has recorded, as a composer takes it."""

    def __init__(self, canon):
        record = self.record = canon.program_geometry
        self.n_moves, self.foam_z, self.foam_w = record.n_moves, canon.foam_z, canon.foam_w
        self.extents, self.extents_tool = record.extents, record.extents_notool         # "notool": with the tool offset
        m1xx = canon.colors.get("m1xx")
        marks = [(m1xx is not None and colour == m1xx, (x, y, z, plane)) for _, colour, x, y, z, plane in canon.dwells]
        self.mark_places = tuple(np.array([at for user_m, at in marks if user_m == kind], np.float32).tobytes()
                                 for kind in (False, True))

    def drawings(self, planes):
        """The record's points are placed already."""
        r = self.record
        return [kerf_raster.Drawing(r.positions(plane), r.kinds, r.lines, "XYZ") for plane in range(planes)]


def still_layer(scene, matrix):
    """What the layer is made of that stays while only the tool, the plot and the texts change."""
    items = [(np.asarray(i.vertices, np.float32).tobytes(), bytes(np.asarray(i.kinds, np.uint8)), i.colour, i.width)
             for i in (*scene.before, *scene.after)]
    return (matrix, scene.back, list(scene.drawings), scene.palettes, scene.selected, scene.selected_spans,
            scene.labels, items)


class GlCanonDraw:
    """The hooks get_*() have defaults; a widget says activate, deactivate, swapbuffers, winfo_width and winfo_height.

    Its own names begin with _preview_: widgets have most others already.
    """

    colors = {name: shares(text) for name, text in COLOURS.items()} | ALPHA | {
        f"{name}_{plane}": colour for name in ("straight_feed", "arc_feed")
        for plane, colour in (("xy", (.2, 1., .2)), ("uv", (.2, .2, 1.)))} | {
        f"backplot{name}": colour for name, colour, _ in PLOT} | {f"backplot{name}_alpha": alpha
                                                                  for name, _, alpha in PLOT} | {"tool_ambient":
                                                                      (.4,) * 3}

    def __init__(self, s=None, lp=None, g=None):
        """s: linuxcnc.stat(); lp: linuxcnc.positionlogger() or None; g: the canon shown first."""
        self.stat, self.lp, self.canon = s, lp, g
        self.colors = dict(type(self).colors)
        self.highlight_line = None
        self.current_line = 0
        self.cone_basesize = CONE_BASESIZE
        self._preview_renderer = self._preview_scenes = self._preview_shown = self._preview_still = None
        self.init_glcanondraw()

    def init_glcanondraw(self, trajcoordinates="XYZABCUVW", kinsmodule="trivkins", msg=""):
        """The machine's letters, and the name of its kinematics, which does not change the picture."""
        self.trajcoordinates, self.kinsmodule = trajcoordinates.upper().replace(" ", ""), kinsmodule
        self._preview_scenes = None

    # -- hooks ---------------------------------------------------------------------------------

    def activate(self):
        return True

    def deactivate(self):
        pass

    def swapbuffers(self):
        pass

    def winfo_width(self):
        return 640

    def winfo_height(self):
        return 480

    def user_plot(self):
        """Draws more, over the program, with the context current."""

    def is_lathe(self): return False
    def is_foam(self): return False
    def get_foam_z(self): return 0.0
    def get_foam_w(self): return 1.5
    def get_geometry(self): return "XYZABCUVW"
    def get_joints_mode(self): return False
    def get_num_joints(self): return len(self.trajcoordinates)
    def get_show_commanded(self): return True
    def get_show_extents(self): return True
    def get_show_limits(self): return True
    def get_show_live_plot(self): return True
    def get_show_machine_speed(self): return True
    def get_show_metric(self): return True
    def get_show_program(self): return True
    def get_show_rapids(self): return True
    def get_show_relative(self): return True
    def get_show_tool(self): return True
    def get_show_distance_to_go(self): return False
    def get_show_offsets(self): return False
    def get_program_alpha(self): return False
    def get_grid_size(self): return 0.0
    def get_view(self): return 3
    def get_a_axis_wrapped(self): return False
    def get_b_axis_wrapped(self): return False
    def get_c_axis_wrapped(self): return False

    def get_font_info(self):
        """(width of a letter, height of a line, unused) in pixels."""
        return 0.6 * LETTER_PX, LETTER_PX, None

    def get_current_tool(self):
        """Entry of the tool table, or None."""
        return self.stat.tool_table[0] if self.stat is not None and self.stat.tool_in_spindle > 0 else None

    def get_highlight_line(self):
        return self.highlight_line

    # -- units ---------------------------------------------------------------------------------

    def _preview_units(self, unit=None):
        """unit: machine units a mm; None: the machine's."""
        return ((self.stat.linear_units if unit is None and self.stat is not None else unit) or 1.0) * MM_PER_INCH

    def to_internal_linear_unit(self, v, unit=None):
        return v / self._preview_units(unit)

    def to_internal_units(self, pos, unit=None):
        """Nine machine coordinates in inches and degrees."""
        scale = self._preview_units(unit)
        return [v if 3 <= i <= 5 else v / scale for i, v in enumerate(pos)]

    def from_internal_units(self, pos, unit=None):
        scale = self._preview_units(unit)
        return [v if 3 <= i <= 5 else v * scale for i, v in enumerate(pos)]

    # -- programs ------------------------------------------------------------------------------

    def set_canon(self, canon):
        self.canon, self._preview_shown = canon, None

    def load_preview(self, f, canon, *args):
        """Reads a program into a canon: (result, last line) of gcode.parse. Ctrl-C and
        (AXIS,stop) keep the part so far."""
        self.set_canon(canon)
        result, line = 0, 0
        try:
            result, line = gcode.parse(f, canon, *args)
        except KeyboardInterrupt:
            canon.preview_incomplete = True
        if result <= gcode.MIN_ERROR:
            canon.calc_extents()
        self._preview_shown = None
        return result, line

    def set_highlight_line(self, line):
        """Shows a line of the program, None: none."""
        self.highlight_line = line
        self.update_highlight_variable(line)
        if self.canon is not None:
            self.canon.highlight_line = line

    def set_current_line(self, line):
        self.current_line = line

    def update_highlight_variable(self, line):
        """For a subclass that shows the line elsewhere."""

    def select(self, x, y):
        """Highlights the line of the program at a pixel; where there is none, none."""
        scenes, size = self._preview_composed(), self._preview_size()
        kinds = 7 if self.get_show_rapids() else 6
        found = next((line for line in (d.pick(scenes.camera.matrix(*size), *size, x, y, PICK_PX, kinds)
                                        for d in scenes.drawings) if line >= 0), None)
        self.set_highlight_line(found)

    # -- the view ------------------------------------------------------------------------------

    def pan(self, dx, dy):
        """By pixels."""
        self._preview_composed().camera.pan(dx, dy, *self._preview_size())

    def rotate(self, dx, dy):
        """By pixels of the mouse; lathes are not turned."""
        if not self.is_lathe():
            self._preview_composed().camera.rotate(dx, dy)

    def zoom(self, factor):
        """More than 1: farther away."""
        self._preview_composed().camera.zoom(factor)

    def fit(self):
        """Shows all of the program."""
        scenes = self._preview_composed()
        scenes.camera.fit(*scenes.shown_box())

    def set_cone_basesize(self, size):
        """Of the tool's cone; out of .025 to 2: the default."""
        self.cone_basesize = size if 0.025 <= size <= 2 else CONE_BASESIZE

    def stale_dlist(self, name):
        """Nothing is kept that could be stale but the program."""
        if name in ("program_rapids", "program_norapids", "select_rapids", "select_norapids"):
            self._preview_shown = None

    # -- the picture ---------------------------------------------------------------------------

    def _preview_size(self):
        return max(int(self.winfo_width()), 1), max(int(self.winfo_height()), 1)

    def _preview_find(self, _section, _name, default=None):
        return default

    def _preview_settings(self):
        """As the composer and the readout of AXIS want them."""
        wrapped = {c for c in "ABC" if getattr(self, f"get_{c.lower()}_axis_wrapped")()}
        return SimpleNamespace(
            units_per_mm=(self.stat.linear_units if self.stat is not None else 0) or 1.0, foam=bool(self.is_foam()),
            foam_z=self.get_foam_z(), foam_w=self.get_foam_w(), lathe=bool(self.is_lathe()),
            geometry=self.get_geometry().upper(), coordinates=self.trajcoordinates,
            axes="".join(c for c in LETTERS if c in self.trajcoordinates), joints=self.get_num_joints(),
            find=self._preview_find, flag=lambda section, name: section[-1] in wrapped and name == "WRAPPED_ROTARY")

    def _preview_options(self):
        line = self.get_highlight_line()
        return SimpleNamespace(
            show_program=self.get_show_program(), show_rapids=self.get_show_rapids(),
            program_alpha=self.get_program_alpha(), show_live_plot=self.get_show_live_plot(),
            show_tool=self.get_show_tool(), show_extents=self.get_show_extents(),
            show_offsets=self.get_show_offsets(), show_machine_limits=self.get_show_limits(),
            grid_size=self.get_grid_size() or 0.0, highlight_line=line if line is not None else -1,
            metric=self.get_show_metric(), coord_type=self.get_show_relative(),
            display_type=self.get_show_commanded(), dro_large_font=False, cone_size=self.cone_basesize,
            cone_scaling=True, min_tool_diameter=0.0)

    def _preview_composed(self):
        """The scenes, with the program that the canon has now."""
        settings = self._preview_settings()
        # units are 0 before the first poll
        what = {name: value for name, value in vars(settings).items() if not callable(value)}
        if self._preview_scenes is None or what != self._preview_settings_made:
            self._preview_scenes = Composer(settings, self._preview_options(), self.lp, round(self.get_font_info()[1]))
            self._preview_settings_made, self._preview_shown, self._preview_view = what, None, None
            self._preview_scenes.current_tool = lambda: self.get_current_tool()
        scenes = self._preview_scenes
        scenes.stat, scenes.options = self.stat, self._preview_options()
        for name, value in self.colors.items():
            if "_alpha" in name:
                scenes.alpha[name] = value
            elif name in scenes.colours:
                scenes.colours[name] = "#%02x%02x%02x" % tuple(round(255 * v) for v in value[:3])
        scenes.scene.back = scenes.colour("back")
        view = self.get_view()
        if view != self._preview_view:
            self._preview_view = view
            scenes.camera.set_view("lathe" if scenes.s.lathe and view != 3 else VIEWS[view]
                                   if view in range(len(VIEWS)) else "p")
            scenes.camera.fit(*scenes.shown_box())
        if self._preview_shown is None:
            recorded = Recorded(self.canon) if self.canon is not None else None
            scenes.set_program(recorded, recorded.drawings(2 if scenes.s.foam else 1) if recorded else [])
            self._preview_shown = True
        return scenes

    def _preview_readout(self):
        return SimpleNamespace(relative=self.get_show_relative(), commanded=self.get_show_commanded(),
                               metric=self.get_show_metric(), joints=self.get_joints_mode(),
                               offsets=self.get_show_offsets(), speed=self.get_show_machine_speed(),
                               distance_to_go=self.get_show_distance_to_go(),
                               extra_joints=max(0, self.get_num_joints() - len(self.trajcoordinates)))

    def posstrs(self):
        """(on a limit by line, homed by line, lines of the short list, lines of the long list)."""
        view, readout = self._preview_readout(), Readout(self._preview_settings())
        view.offsets = False
        short = readout.lines(self.stat, view)
        view.offsets = True
        long = readout.lines(self.stat, view)
        joints = self.get_num_joints()
        homed, limits = list(self.stat.homed[:joints]), [bool(v) for v in self.stat.limit[:joints]]
        return limits, homed, short, long

    def realize(self):
        """Makes what is needed in the current context; redraw() does it, too."""
        if self._preview_renderer is None:
            from kerf import gl
            self._preview_renderer = Renderer(gl.library())

    def redraw(self):
        """Draws everything and shows it."""
        if not self.activate():
            return
        try:
            self.realize()
            scenes, size = self._preview_composed(), self._preview_size()
            if self.stat is not None:
                limits, homed, short, long = self.posstrs()
                scenes.readout_lines = long if self.get_show_offsets() else short
                scenes.marks = list(zip(homed, limits))[:len(short)]
            matrix = scenes.camera.matrix(*size)
            scenes.compose(*size, matrix)
            scenes.compose_live(*size, matrix)
            renderer, scene = self._preview_renderer, scenes.scene
            still = still_layer(scene, matrix)
            if renderer.resize(*size) or still != self._preview_still or not renderer.draw_frame(scene, matrix):
                self._preview_still = still
                renderer.draw_still(scene, matrix, scenes.text_px, exact=True)
                renderer.draw_frame(scene, matrix)
            self.user_plot()
            renderer.present()
            self.swapbuffers()
        finally:
            self.deactivate()

    def redraw_perspective(self, *_args, **_options):
        self.redraw()

    redraw_ortho = redraw_perspective
