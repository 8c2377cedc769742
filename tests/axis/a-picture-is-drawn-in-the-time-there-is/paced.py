#!/usr/bin/python3
"""A driver of OSMesa, and the picture without one, whose time is counted: each vertex takes `dear` seconds of a clock
that nothing else moves."""
from types import SimpleNamespace

import kerf_raster
import numpy as np
from axis import drawn
from axis.camera import Camera
from kerf import gl
from kerf.glpath import Renderer, Scene
from kerf.pace import FRAME_S, SLICE_S, Pace
from kerf_raster import Drawing

SIZE = 320, 240
COUNT = 40000


class Counted:
    """OpenGL: a fence ends when as much time has passed as what was drawn before it takes."""

    def __init__(self, library, dear):
        self.library, self.dear, self.now, self.waiting, self.slices = library, dear, 0.0, 0.0, []

    def __getattr__(self, name):
        return getattr(self.library, name)

    def glDrawArrays(self, mode, first, count):
        self.waiting += count * self.dear
        self.library.glDrawArrays(mode, first, count)

    def glDrawElements(self, mode, count, *rest):
        self.waiting += count * self.dear
        self.library.glDrawElements(mode, count, *rest)

    def glFenceSync(self, *what):
        self.slices.append(self.waiting)
        return self.library.glFenceSync(*what)

    def glClientWaitSync(self, fence, *how):
        if self.waiting <= 0:
            return self.library.GL_ALREADY_SIGNALED
        step = min(self.waiting, 0.002)
        self.now, self.waiting = self.now + step, self.waiting - step
        return self.library.GL_TIMEOUT_EXPIRED

    def taken(self):
        """Everything that was given is drawn: how long that took."""
        seconds, self.waiting = self.waiting, 0.0
        self.now += seconds
        return seconds


def crossing():
    """Lines of half the picture's width in all directions: no level has fewer vertices."""
    points = np.random.default_rng(3).uniform(-2, 2, (COUNT, 3)).astype(np.float32)
    return Drawing(points, np.ones(COUNT, np.uint8), np.arange(COUNT, dtype=np.int32))


def quarters(picture):
    """How much is drawn in each quarter of the picture."""
    h, w, _ = picture.shape
    drawn = picture.any(axis=2)
    return [round(float(part.mean()), 3) for part in (drawn[:h // 2, :w // 2], drawn[:h // 2, w // 2:],
                                                      drawn[h // 2:, :w // 2], drawn[h // 2:, w // 2:])]


class CountedRaster:
    """A picture in memory."""

    def __init__(self, dear):
        self.raster, self.dear, self.now, self.slices = kerf_raster.Raster(*SIZE), dear, 0.0, []

    def __getattr__(self, name):
        return getattr(self.raster, name)

    def draw_pieces(self, drawing, colours, matrix, level, first, count):
        self.slices.append(sum(count) * self.dear)
        self.now += self.slices[-1]
        self.raster.draw_pieces(drawing, colours, matrix, level, first, count)


def pixels(raster):
    return np.frombuffer(raster.ppm(), np.uint8)[-3 * SIZE[0] * SIZE[1]:].reshape(SIZE[1], SIZE[0], 3)


def without_opengl(drawing, camera):
    scene = Scene(drawings=[drawing], palettes=[[(1.0, 1.0, 1.0, 1.0)] * 3])
    for name, dear in (("a fast computer", 1e-7), ("a slow one", 3e-5)):
        raster, pace = CountedRaster(dear), Pace()
        drawn.time = SimpleNamespace(monotonic=lambda: raster.now)
        frames = []
        for _ in range(20):
            camera.rotate(3, 1)
            matrix, began = camera.matrix(*SIZE), raster.now
            *_, exact = drawn.still_steps(raster, scene, matrix, pace, pace.budget)
            frames.append(raster.now - began)
            pace.frame_took(frames[-1], exact)
        print(f"{name}: frames in time:", max(frames[8:]) <= 1.4 * FRAME_S or frames, "all that there is time for:",
              exact or min(frames[8:]) > 0.5 * FRAME_S or frames)
        shown = quarters(pixels(raster))
        print("  everywhere:", min(shown) > 0.6 * max(shown) or shown)
        raster.slices.clear()
        for done in drawn.still_steps(raster, scene, matrix, pace):
            pass
        print("  slices in time:", max(raster.slices) <= 1.5 * SLICE_S or raster.slices, "exact:", done)
        whole = kerf_raster.Raster(*SIZE)
        whole.clear((0, 0, 0, 255))
        whole.draw_drawing(drawing, [(255,) * 4] * 3 + [(0,) * 4], matrix)
        print("  as drawn at once:", whole.ppm() == raster.ppm())
    for wrong in ((0, [COUNT - 1], [2]), (0, [-1], [2]), (7, [0], [2]), (0, [0, 0], [2])):
        try:
            whole.draw_pieces(drawing, [(255,) * 4], matrix, *wrong)
            print("accepted:", wrong)
        except IndexError:
            pass


def main():
    drawing, camera = crossing(), Camera()
    camera.set_view("z")
    camera.fit(*drawing.extents)
    with gl.OffScreen(*SIZE) as off:
        for name, dear in (("a fast driver", 1e-7), ("software", 5e-6), ("slow software", 3e-5)):
            counted = Counted(off.gl, dear)
            renderer = Renderer(counted, lambda: counted.now)
            renderer.resize(*SIZE)
            scene = Scene(drawings=[drawing], palettes=[[(1.0, 1.0, 1.0, 1.0)] * 3])
            frames = []
            for _ in range(20):
                camera.rotate(3, 1)
                matrix = camera.matrix(*SIZE)
                renderer.draw_still(scene, matrix)
                renderer.draw_frame(scene, matrix)
                frames.append(counted.taken())
                renderer.took(frames[-1])
            late = max(frames[8:])
            print(f"{name}: frames in time:", late <= 1.4 * FRAME_S or late, "all that there is time for:",
                  renderer.exact or min(frames[8:]) > 0.5 * FRAME_S or frames)
            shown = quarters(renderer.pixels())
            print("  everywhere:", min(shown) > 0.6 * max(shown) or shown)
            counted.slices.clear()
            steps = 0
            while not renderer.exact:
                renderer.step()
                steps += 1
            print("  slices in time:", max(counted.slices, default=0) <= 1.5 * SLICE_S or counted.slices)
            renderer.draw_frame(scene, matrix)
            stepped = renderer.pixels().copy()
            renderer.draw_still(scene, matrix, exact=True)
            renderer.draw_frame(scene, matrix)
            print("  exact:", bool((stepped == renderer.pixels()).all()))
    without_opengl(drawing, camera)


main()
