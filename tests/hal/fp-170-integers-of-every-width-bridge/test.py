"""Old and new names of integer types mean the same; every value survives pins, signals,
parameters, queries and text at its full width, and a wrong one is refused with a reason."""
import subprocess
import hal
import hal.query

assert (hal.HAL_SINT, hal.HAL_UINT, hal.HAL_REAL, hal.HAL_BOOL) == (hal.HAL_S64, hal.HAL_U64,
                                                                    hal.HAL_FLOAT, hal.HAL_BIT)
assert hal.Type.S32 == hal.HAL_S32 and hal.Type.SINT.HAL_S64 == hal.HAL_S64
RANGES = {"s32": (hal.HAL_S32, -2**31, 2**31 - 1), "u32": (hal.HAL_U32, 0, 2**32 - 1),
          "s64": (hal.HAL_SINT, -2**63, 2**63 - 1), "u64": (hal.HAL_UINT, 0, 2**64 - 1)}


def halcmd(*words):
    return subprocess.run(("halcmd",) + words, capture_output=True, text=True).stdout.strip()


c = hal.component("c")
for name, (kind, low, high) in RANGES.items():
    c.newpin(name, kind, hal.HAL_IO)
    c.newparam(name + "-par", kind, hal.HAL_RW)
c.ready()
for name, (kind, low, high) in RANGES.items():
    hal.new_sig(name, kind)
    hal.connect("c." + name, name)
    for value in (low, high, 0, 1, high // 3, low // 3):
        for place in (name, name + "-par"):
            c[place] = value
            assert c[place] == value, (place, value)
            assert hal.get_p("c." + place) == value
            assert halcmd("getp", "c." + place) == str(value)
        assert hal.get_s(name) == value and hal.query.signal(name)["value"] == value
        assert halcmd("gets", name) == str(value)
        halcmd("setp", "c.%s-par" % name, hex(value))
        assert c[name + "-par"] == value
    for value in (low - 1, high + 1):
        try:
            c[name] = value
        except OverflowError as e:
            assert "c." + name in "".join(e.__notes__)
        else:
            raise AssertionError("%s took %d" % (name, value))
    assert halcmd("stype", name) == name
print("good")
