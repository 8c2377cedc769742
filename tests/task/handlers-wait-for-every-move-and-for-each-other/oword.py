from interpreter import *


def fetch(self, tool):
    self.execute("T%d M6" % tool)
    yield INTERP_EXECUTE_FINISH
    self.execute("G1 Y[#<_y>+3] F3000")
    yield INTERP_EXECUTE_FINISH
    yield self.params["_y"]
