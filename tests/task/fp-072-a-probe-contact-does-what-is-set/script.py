# FP-072: what a contact in a rapid move or a feed does. FP-076: outside probe moves a glitch may be filtered; a probe
# move latches the first edge whatever the filter, and its bounce, or a contact that it leaves closed, is no fault of
# the next move.
import hal
from mill import *

on()


def probe(value):
    hal.set_p("motion.probe-input", str(value))


def contact(line, duration):
    mdi("G53 G0 X0")
    messages()
    c.mdi(line)
    sleep(0.5)
    probe(1)
    sleep(duration)
    probe(0)
    need(lambda s: s.inpos and s.queue == 0 and s.interp_state == INTERP_IDLE, "rest")
    return f"{'reached' if abs(s.joint_position[0] - 90) < 1e-3 else 'stopped'} {messages()}"


for name, line in (("rapid", "G0 X90"), ("feed", "G1 F3000 X90")):
    for duration in (0.02, 0.2):
        print(f"{name}, {duration} s: {contact(line, duration)}")
mdi("G53 G0 X0")
c.mdi("G38.2 F600 X50")
sleep(0.7)
at = poll().joint_position[0]
for value in (1, 0, 1, 0, 1):  # it bounces, then stays closed while the tool goes back
    probe(value)
    sleep(0.003)
need(lambda s: s.inpos and s.queue == 0 and s.interp_state == INTERP_IDLE, "rest")
error = abs(s.probed_position[0] - at)
mdi("G91 G1 F600 X-1")
sleep(0.1)
probe(0)
print("probe move:", s.probe_tripped, "within 0.03" if error < 0.03 else error, messages())
