# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws tool paths with OpenGL 3.3, in a widget's context (kerf.gl.Frame) or off screen (kerf.gl.OffScreen).

A picture has two layers. The still layer (grid, program, extents, offsets, limits, the plotted
path so far) is drawn when it or the view changes: at once with few vertices, then, in slices that
leave time for the rest of the screen, exact to a pixel. The frame is a copy of it with what moves:
the end of the plotted path, the tool, the texts.

Inches. Colours are four numbers 0 to 1. Matrices: 16 numbers, row-major, clip = matrix * (x, y, z, 1).
"""

import ctypes
import time
from dataclasses import dataclass, field

import numpy as np

from .gltext import Glyphs
from .pace import Pace

EXACT_PX = 0.7
USUAL_LETTERS_PX = 13        # with lines of one pixel
PLOT_TAIL = 16               # points at the plot's end that may still change
PLOT_RECORD = np.dtype([("p", "f4", 3), ("c", "u1", 4), ("q", "f4", 3), ("d", "u1", 4)])

PATH_VERTEX = """#version 330 core
layout(location = 0) in vec3 p;
layout(location = 1) in uint kind;
uniform mat4 m;
uniform vec4 palette[8];
flat out vec4 colour;
void main() { gl_Position = m * vec4(p, 1.0); colour = palette[min(kind, 7u)]; }
"""
PLOT_VERTEX = """#version 330 core
layout(location = 0) in vec3 p;
layout(location = 1) in vec4 c;
uniform mat4 m;
flat out vec4 colour;
void main() { gl_Position = m * vec4(p, 1.0); colour = c; }
"""
COLOUR_FRAGMENT = """#version 330 core
flat in vec4 colour;
out vec4 result;
void main() { if (colour.a == 0.0) discard; result = colour; }
"""
TEXT_VERTEX = """#version 330 core
layout(location = 0) in vec4 at;
layout(location = 1) in vec4 c;
uniform vec2 window;
out vec2 uv;
out vec4 colour;
void main() { gl_Position = vec4(at.x / window.x * 2.0 - 1.0, 1.0 - at.y / window.y * 2.0, 0.0, 1.0); uv = at.zw; colour = c; }
"""
TEXT_FRAGMENT = """#version 330 core
in vec2 uv;
in vec4 colour;
uniform sampler2D glyphs;
out vec4 result;
void main() { result = vec4(colour.rgb, colour.a * (uv.x < 0.0 ? 1.0 : texture(glyphs, uv).r)); }
"""


@dataclass
class Item:
    """Lines of one colour. vertices: N x 3; kinds: 1 a piece, 0 a jump to its vertex; triangles: no lines but faces."""
    vertices: object
    kinds: object
    colour: tuple
    width: float = 1.0
    triangles: bool = False


@dataclass
class Scene:
    """What is shown. palettes: one for each drawing (traverse, feed, arc)."""
    back: tuple = (0.0, 0.0, 0.0, 1.0)
    drawings: list = field(default_factory=list)
    palettes: list = field(default_factory=list)
    selected: tuple = (0.0, 1.0, 1.0, 1.0)
    selected_spans: list = field(default_factory=list)     # (drawing number, first, last)
    before: list = field(default_factory=list)             # items below the program
    after: list = field(default_factory=list)              # items over it
    blend: bool = False
    labels: list = field(default_factory=list)             # (x, y in pixels, text, colour, box): anchor lower middle
    plot: object = None                                    # (bytes, number of points, second path too) or None
    plot_matrix: tuple = ()                                # its points may be in other units than inches
    live: list = field(default_factory=list)               # items that move
    texts: list = field(default_factory=list)              # (x, y, text, colour, glyph size), upper left corner
    panels: list = field(default_factory=list)             # (x0, y0, x1, y1, colour) below the texts


class Renderer:
    """Draws scenes in the current context."""

    def __init__(self, gl, clock=time.monotonic):
        self.gl, self.clock = gl, clock
        self.path = self.program(PATH_VERTEX, COLOUR_FRAGMENT)
        self.plain = self.program(PLOT_VERTEX, COLOUR_FRAGMENT)
        self.text = self.program(TEXT_VERTEX, TEXT_FRAGMENT)
        self.places = {(program, name): gl.glGetUniformLocation(program, name)
                       for program, names in ((self.path, ("m", "palette")), (self.plain, ("m",)),
                                              (self.text, ("window", "glyphs")))
                       for name in names}
        self.array = gl.glGenVertexArrays(1)
        gl.glBindVertexArray(self.array)
        self.scratch = gl.glGenBuffers(1)
        self.size = (0, 0)
        self.layers = {}             # name -> (frame buffer, colour, depth)
        self.uploads = {}            # id of a drawing -> its buffers
        self.glyphs = {}             # size -> (Glyphs, texture)
        self.steps = None            # the exact drawing that is going on
        self.plotted = 0
        self.exact = True
        self.pace = Pace()
        self.thickness = 1           # pixels of a line, more where pixels are small

    # -- building blocks -------------------------------------------------------------------

    def program(self, vertex, fragment):
        gl = self.gl
        program = gl.glCreateProgram()
        for kind, source in ((gl.GL_VERTEX_SHADER, vertex), (gl.GL_FRAGMENT_SHADER, fragment)):
            shader = gl.glCreateShader(kind)
            gl.glShaderSource(shader, source)
            gl.glCompileShader(shader)
            if not gl.glGetShaderiv(shader, gl.GL_COMPILE_STATUS):
                raise RuntimeError("OpenGL: a shader is refused: " + str(gl.glGetShaderInfoLog(shader)))
            gl.glAttachShader(program, shader)
        gl.glLinkProgram(program)
        if not gl.glGetProgramiv(program, gl.GL_LINK_STATUS):
            raise RuntimeError("OpenGL: a program is refused: " + str(gl.glGetProgramInfoLog(program)))
        return program

    def layer(self, name):
        """The frame buffer of a layer, bound, of the picture's size."""
        gl = self.gl
        if name not in self.layers:
            buffer, colour, depth = gl.glGenFramebuffers(1), gl.glGenRenderbuffers(1), gl.glGenRenderbuffers(1)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffer)
            for store, form, place in ((colour, gl.GL_RGBA8, gl.GL_COLOR_ATTACHMENT0),
                                       (depth, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_ATTACHMENT)):
                gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, store)
                gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, form, *self.size)
                gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, place, gl.GL_RENDERBUFFER, store)
            if gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER) != gl.GL_FRAMEBUFFER_COMPLETE:
                raise RuntimeError("OpenGL: no frame buffer of %d x %d pixels" % self.size)
            self.layers[name] = buffer, colour, depth
        buffer = self.layers[name][0]
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffer)
        gl.glViewport(0, 0, *self.size)
        return buffer

    def resize(self, width, height):
        """True when the picture has a new size: the still layer has to be drawn anew."""
        if (width, height) == self.size:
            return False
        self.size = (width, height)
        self.steps = None
        for buffer, colour, depth in self.layers.values():
            self.gl.glDeleteFramebuffers(1, [buffer])
            self.gl.glDeleteRenderbuffers(2, [colour, depth])
        self.layers.clear()
        return True

    def clear(self, colour):
        gl = self.gl
        gl.glClearColor(*colour[:3], 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_DEPTH_CLAMP)
        gl.glDepthFunc(gl.GL_LEQUAL)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)

    def line(self, width):
        self.gl.glLineWidth(width * self.thickness)

    def use(self, program, matrix=None):
        self.gl.glUseProgram(program)
        if matrix is not None:
            self.gl.glUniformMatrix4fv(self.places[program, "m"], 1, True, np.array(matrix, np.float32))

    def palette(self, colours):
        values = np.zeros((8, 4), np.float32)
        values[:len(colours)] = colours
        self.gl.glUniform4fv(self.places[self.path, "palette"], 8, values)

    def attributes(self, *columns):
        """(size, type, normalized or None for integers, stride, offset) of locations 0, 1."""
        gl = self.gl
        for location, (size, kind, normalized, stride, offset) in enumerate(columns):
            gl.glEnableVertexAttribArray(location)
            if normalized is None:
                gl.glVertexAttribIPointer(location, size, kind, stride, ctypes.c_void_p(offset))
            else:
                gl.glVertexAttribPointer(location, size, kind, normalized, stride, ctypes.c_void_p(offset))

    # -- the program -----------------------------------------------------------------------

    def upload(self, drawing):
        """The drawing's buffers in the driver: points, kinds, levels as they are needed."""
        gl = self.gl
        found = self.uploads.get(id(drawing))
        if found is None:
            points, kinds = gl.glGenBuffers(2)
            for buffer, data in ((points, drawing.vertices), (kinds, drawing.kinds)):
                array = np.asarray(data)
                gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffer)
                gl.glBufferData(gl.GL_ARRAY_BUFFER, array.nbytes, array, gl.GL_STATIC_DRAW)
            found = self.uploads[id(drawing)] = {"drawing": drawing, "points": points, "kinds": kinds, "levels": {}}
        return found

    def forget(self, keep=()):
        """Frees what belongs to drawings that are no longer shown."""
        for key, found in list(self.uploads.items()):
            if not any(found["drawing"] is d for d in keep):
                names = [found["points"], found["kinds"], *found["levels"].values()]
                self.gl.glDeleteBuffers(len(names), names)
                del self.uploads[key]

    def bind_drawing(self, drawing, level=None):
        gl = self.gl
        found = self.upload(drawing)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, found["points"])
        self.attributes((3, gl.GL_FLOAT, False, 12, 0))
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, found["kinds"])
        gl.glEnableVertexAttribArray(1)
        gl.glVertexAttribIPointer(1, 1, gl.GL_UNSIGNED_BYTE, 1, ctypes.c_void_p(0))
        if level:                    # level 0 is the vertices as they are
            if level not in found["levels"]:
                index = np.asarray(drawing.index(level))
                found["levels"][level] = gl.glGenBuffers(1)
                gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, found["levels"][level])
                gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, index.nbytes, index, gl.GL_STATIC_DRAW)
            gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, found["levels"][level])

    def pieces(self, level, first, count):
        for f, n in zip(first, count):
            if level:
                self.gl.glDrawElements(self.gl.GL_LINE_STRIP, n, self.gl.GL_UNSIGNED_INT, ctypes.c_void_p(4 * f))
            else:
                self.gl.glDrawArrays(self.gl.GL_LINE_STRIP, f, n)

    def until_drawn(self):
        """Pauses until the driver has drawn what it was given, and learns how much that may be: what waits in the
        driver takes memory, and keeps the screen waiting that draws its next frame."""
        gl = self.gl
        began, fence = self.clock(), gl.glFenceSync(gl.GL_SYNC_GPU_COMMANDS_COMPLETE, 0)
        try:
            gl.glFlush()
            while gl.glClientWaitSync(fence, 0, 0) == gl.GL_TIMEOUT_EXPIRED:
                yield None
        finally:
            gl.glDeleteSync(fence)
        self.pace.slice_took(self.clock() - began)

    # -- items, texts, plot ----------------------------------------------------------------

    def items(self, items, matrix):
        gl = self.gl
        items = [i for i in items if len(i.vertices) > 1]
        if not items:
            return
        self.use(self.path, matrix)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.scratch)
        for item in items:
            points, kinds = np.ascontiguousarray(item.vertices, np.float32), np.ascontiguousarray(item.kinds, np.uint8)
            gl.glBufferData(gl.GL_ARRAY_BUFFER, points.nbytes + kinds.nbytes, None, gl.GL_STREAM_DRAW)
            gl.glBufferSubData(gl.GL_ARRAY_BUFFER, 0, points.nbytes, points)
            gl.glBufferSubData(gl.GL_ARRAY_BUFFER, points.nbytes, kinds.nbytes, kinds)
            self.attributes((3, gl.GL_FLOAT, False, 12, 0), (1, gl.GL_UNSIGNED_BYTE, None, 1, points.nbytes))
            self.palette([(0, 0, 0, 0), item.colour])
            self.line(item.width)
            gl.glDrawArrays(gl.GL_TRIANGLES if item.triangles else gl.GL_LINE_STRIP, 0, len(points))
        self.line(1)

    def plot(self, plot, first, last, matrix):
        """Points first to last of the plotted path."""
        gl = self.gl
        data, count, second = plot
        if last - first < 2:
            return
        self.use(self.plain, matrix)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.scratch)
        size = PLOT_RECORD.itemsize
        part = np.frombuffer(data, np.uint8, (last - first) * size, first * size)
        gl.glBufferData(gl.GL_ARRAY_BUFFER, part.nbytes, part, gl.GL_STREAM_DRAW)
        self.line(2)
        for at in (0, 16) if second else (0,):
            self.attributes((3, gl.GL_FLOAT, False, size, at), (4, gl.GL_UNSIGNED_BYTE, True, size, at + 12))
            gl.glDrawArrays(gl.GL_LINE_STRIP, 0, last - first)
        if second:                   # the wire: both ends of each record
            self.attributes((3, gl.GL_FLOAT, False, size // 2, 0), (4, gl.GL_UNSIGNED_BYTE, True, size // 2, 12))
            self.line(1)
            gl.glDrawArrays(gl.GL_LINES, 0, 2 * (last - first))
        self.line(1)

    def glyph_sheet(self, pixels):
        gl = self.gl
        if pixels not in self.glyphs:
            sheet = Glyphs(pixels)
            texture = gl.glGenTextures(1)
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_R8, *sheet.size, 0, gl.GL_RED, gl.GL_UNSIGNED_BYTE, sheet.data)
            for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
                gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
            self.glyphs[pixels] = sheet, texture
        return self.glyphs[pixels]

    def texts(self, texts, panels=(), boxes=()):
        """Texts (x, y, text, colour, size) over panels (x0, y0, x1, y1, colour); boxes: outlines likewise."""
        gl = self.gl
        gl.glDisable(gl.GL_DEPTH_TEST)
        self.use(self.text)
        gl.glUniform2f(self.places[self.text, "window"], *self.size)
        gl.glUniform1i(self.places[self.text, "glyphs"], 0)
        gl.glActiveTexture(gl.GL_TEXTURE0)
        flat = [(a, b, -1, -1, *c) for x0, y0, x1, y1, c in panels
                for a, b in ((x0, y0), (x1, y0), (x0, y1), (x0, y1), (x1, y0), (x1, y1))]
        self.quads(np.array(flat, np.float32), gl.GL_TRIANGLES)
        edges = [(a, b, -1, -1, *c) for x0, y0, x1, y1, c in boxes
                 for a, b in ((x0, y0), (x1, y0), (x1, y0), (x1, y1), (x1, y1), (x0, y1), (x0, y1), (x0, y0))]
        self.quads(np.array(edges, np.float32), gl.GL_LINES)
        for size in sorted({t[4] for t in texts}):
            sheet, texture = self.glyph_sheet(size)
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            parts = []
            for x, y, text, colour, own in texts:
                if own == size and text:
                    quads = sheet.quads(text, round(x), round(y))
                    parts.append(np.hstack([quads, np.broadcast_to(np.array(colour, np.float32), (len(quads), 4))]))
            if parts:
                self.quads(np.vstack(parts), gl.GL_TRIANGLES)
        gl.glEnable(gl.GL_DEPTH_TEST)

    def quads(self, data, mode):
        gl = self.gl
        if len(data) == 0:
            return
        data = np.ascontiguousarray(data, np.float32)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, self.scratch)
        gl.glBufferData(gl.GL_ARRAY_BUFFER, data.nbytes, data, gl.GL_STREAM_DRAW)
        self.attributes((4, gl.GL_FLOAT, False, 32, 0), (4, gl.GL_FLOAT, False, 32, 16))
        gl.glDrawArrays(mode, 0, len(data))

    def label_texts(self, labels, size):
        """Texts and boxes of labels, whose place is their lower middle."""
        sheet = self.glyph_sheet(size)[0]
        texts, boxes = [], []
        for x, y, text, colour, box in labels:
            w, h = sheet.extent(text)
            left, top = x - w / 2, y - h
            texts.append((left, top, text, colour, size))
            if box:
                boxes.append((left - 3, top - 1, left + w + 3, top + h, colour))
        return texts, boxes

    # -- layers ----------------------------------------------------------------------------

    def still_steps(self, name, scene, matrix, budget, label_size):
        """Draws the still layer; pauses after each slice of the program. Ends with its exactness."""
        self.layer(name)
        self.clear(scene.back)
        self.items(scene.before, matrix)
        exact = True
        for drawing, palette in zip(scene.drawings, scene.palettes):
            level, first, count, vertices, good = drawing.choose(matrix, *self.size, EXACT_PX, budget)
            exact = exact and good
            for part in [(first, count)] if budget else self.pace.slices(first, count):
                self.layer(name)
                self.use(self.path, matrix)
                self.palette(palette)
                self.bind_drawing(drawing, level)
                self.pieces(level, *part)
                if not budget:
                    yield from self.until_drawn()
                    yield None
        self.layer(name)
        for number, first, last in scene.selected_spans:
            self.use(self.path, matrix)
            self.palette([scene.selected] * 3)
            self.bind_drawing(scene.drawings[number])
            self.gl.glDepthFunc(self.gl.GL_ALWAYS)
            self.line(3)
            self.gl.glDrawArrays(self.gl.GL_LINE_STRIP, first, last - first)
            self.line(1)
            self.gl.glDepthFunc(self.gl.GL_LEQUAL)
        self.items(scene.after, matrix)
        texts, boxes = self.label_texts(scene.labels, label_size)
        self.texts(texts, boxes=boxes)
        yield exact

    def draw_still(self, scene, matrix, label_size=13, exact=False):
        """Draws the still layer now, quickly; step() makes it exact. exact: at once. Lines grow with the letters."""
        self.thickness = max(1, round(label_size / USUAL_LETTERS_PX))
        self.line(1)
        self.forget(scene.drawings)
        self.steps = None
        self.plotted = 0
        last = None
        for last in self.still_steps("still", scene, matrix, 0 if exact else self.pace.budget, label_size):
            pass
        self.exact = bool(last)
        if not self.exact:
            self.steps = self.still_steps("fine", scene, matrix, 0, label_size)

    def took(self, seconds):
        """Tells how long a quick drawing took until it was seen: the next ones have more or fewer vertices."""
        self.pace.frame_took(seconds, self.exact)

    def step(self):
        """One slice of the exact still layer. True: it is complete now and the frame should be drawn."""
        if self.steps is None:
            return False
        done = next(self.steps)
        if done is None:
            return False
        self.steps = None
        self.exact = True
        self.layers["still"], self.layers["fine"] = self.layers["fine"], self.layers["still"]
        self.plotted = 0
        return True

    def draw_frame(self, scene, matrix):
        """The still layer with what moves. False: the still layer must be drawn anew first."""
        gl = self.gl
        if scene.plot is not None:
            count = scene.plot[1]
            if count < self.plotted:
                return False
            if count - PLOT_TAIL > self.plotted + 1:
                self.layer("still")
                self.plot(scene.plot, max(0, self.plotted - 1), count - PLOT_TAIL, scene.plot_matrix)
                self.plotted = count - PLOT_TAIL
        self.layer("still")
        self.layer("frame")
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, self.layers["still"][0])
        self.copy(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        self.layer("frame")
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_BLEND)
        if scene.plot is not None:
            self.plot(scene.plot, max(0, self.plotted - 1), scene.plot[1], scene.plot_matrix)
        self.items(scene.live, matrix)
        self.texts(scene.texts, scene.panels)
        return True

    def copy(self, buffers):
        w, h = self.size
        self.gl.glBlitFramebuffer(0, 0, w, h, 0, 0, w, h, buffers, self.gl.GL_NEAREST)

    def present(self):
        """The frame into the window's own buffer."""
        gl = self.gl
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, self.layers["frame"][0])
        gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, 0)
        self.copy(gl.GL_COLOR_BUFFER_BIT)

    def pixels(self):
        """The frame as an array, height x width x 3."""
        gl = self.gl
        self.layer("frame")
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        data = gl.glReadPixels(0, 0, *self.size, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
        return np.frombuffer(data, np.uint8).reshape(self.size[1], self.size[0], 3)[::-1]

    def check(self):
        """Draws one colour and reads it back. Raises RuntimeError when it is another."""
        self.resize(16, 16)
        scene = Scene(back=(1.0, 0.5, 0.0, 1.0), texts=[(0, 0, "1", (1.0, 1.0, 1.0, 1.0), 8)])
        matrix = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
        self.draw_still(scene, matrix, exact=True)
        self.draw_frame(scene, matrix)
        self.present()
        if abs(int(self.pixels()[15, 15, 0]) - 255) > 2:
            raise RuntimeError("OpenGL draws a wrong colour")
