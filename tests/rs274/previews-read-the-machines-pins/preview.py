import gcode
import hal  # the process is in HAL

r = gcode.load("pin.ngc", "/nonexistent.var", ini="pin.ini")
print(r.error or f"X{memoryview(r.positions).tolist()[-1][0] * 25.4:.4f}")
