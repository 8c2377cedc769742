# SPDX-License-Identifier: GPL-2.0-or-later
from interpreter import *
def change(self, **words):
    print("python change runs", flush=True)
    self.execute("(debug, my python change)")
    self.execute("G53 G0 Z120")
    yield INTERP_EXECUTE_FINISH
    self.execute("M6")
    yield INTERP_EXECUTE_FINISH
    return
