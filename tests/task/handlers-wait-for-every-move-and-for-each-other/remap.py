from interpreter import *


def m6(self):
    self.execute("G53 G0 Z0")
    self.execute("M6")
    yield INTERP_EXECUTE_FINISH
    self.execute("G1 X[#<_x>+1] F3000")
    yield INTERP_EXECUTE_FINISH
    self.execute("(debug,T%d#5400 at X%.3f#<_x> pin %.3f#<_hal[joint.0.motor-pos-cmd]>)")


def m400(self):
    for tool in 1, 2:
        self.execute(f"T{tool} M6")
        yield INTERP_EXECUTE_FINISH
        self.execute("G1 Y[#<_y>+2] F3000")
        yield INTERP_EXECUTE_FINISH
        self.execute("(debug,Y%.3f#<_y> pin %.3f#<_hal[joint.1.motor-pos-cmd]>)")
