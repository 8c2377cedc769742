# FP-030: G33 and G76 switch overrides off for the cut; an abort in each of their phases gives them back.
# FP-039: words that repeat what is in force do not stop a path.
from mill import *


def shown():
    poll()
    return f"feed {int(s.feed_override_enabled)} spindle {int(s.spindle[0]['override_enabled'])}"


on()
for modal in ("M48", "M49", "M48 M50 P0"):
    for word in modal.split(" ", 1):
        mdi(word)
    before = shown()
    for code, waits in (("G33 Z-10 K1", (0.0, 0.05, 0.6, 1.0)),
                        ("G76 P1 Z-10 I-1 J0.2 R1 K1 Q30 H1 E0 L0", (0.1, 1.0, 3.0))):
        wrong = []
        for wait in waits:
            mdi("G53 G0 Z0")
            program(f"M3 S300\nG0 X0 Z0\n{code}\nG0 Z0\nM2\n")
            c.auto(AUTO_RUN, 0)
            sleep(1.0 + wait)
            c.abort()
            sleep(0.5)
            if shown() != before:
                wrong.append((wait, shown()))
        print(f"{modal:10} {code.split()[0]}: before {before}, others after aborts {wrong}", messages())

for words in ("S1000", "M3", "F600", "G64 P0.05", "G21 G17 G90", "M8", "S1000 M3 F600 G64 P0.05 G21 G17 G90 M8"):
    mdi("G0 X0")
    program("M3 S1000\nG64 P0.05\nM8\nF600\nG1 X0 Y0 Z0\n" + "".join(f"G1 X{i * 0.5} {words}\n" for i in range(1, 61))
            + "M2\n")
    c.auto(AUTO_RUN, 0)
    sleep(1.0)
    low = 1e9
    for _ in range(1500):
        sleep(0.001)
        poll()
        low = min(low, s.current_vel)
    print(f"slowest with {words} in each line: {low:.3f}")
    c.abort()
    sleep(0.5)
