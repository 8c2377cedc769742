#!/usr/bin/env python3
# a part drawn with OpenGL by the user's own class
from vismach import *
import hal
c = hal.component("m08")
c.newpin("x", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("load", hal.HAL_FLOAT, hal.HAL_IN)
c.ready()


class Gauge(object):
    """A bar that grows with the load, green to red."""
    def __init__(self, comp, pin):
        self.comp, self.pin = comp, pin

    def draw(self):
        load = min(max(self.comp[self.pin], 0), 1)
        glPushMatrix()
        glDisable(GL_LIGHTING)
        glColor3f(load, 1 - load, 0)
        glBegin(GL_QUADS)
        for x, z in ((0, 0), (5, 0), (5, 50 * load), (0, 50 * load)):
            glVertex3f(x, 0, z)
        glEnd()
        glEnable(GL_LIGHTING)
        glPopMatrix()

    def volume(self):
        return 0.0


class Blink(Collection):
    def __init__(self, parts):
        Collection.__init__(self, parts)
        self.n = 0

    def traverse(self):
        self.n += 1
        if self.n % 2:
            Collection.traverse(self)


work, tooltip = Capture(), Capture()
model = Collection([work, Gauge(c, "load"), Blink([Sphere(30, 0, 0, 5)]), HalTranslate([tooltip], c, "x", 1, 0, 0)])
main(model, tooltip, work, 100)
