# A component that POSTGUI loads and that is none of the screen's.
import time

import hal

component = hal.component("beside")
component.newpin("in", hal.HAL_BIT, hal.HAL_IN)
component.ready()
try:
    time.sleep(1000)
except KeyboardInterrupt:
    pass
