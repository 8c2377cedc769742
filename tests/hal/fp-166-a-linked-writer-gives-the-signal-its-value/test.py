"""Links pins of every type and direction in every order; the signal's value and what pins
keep at unlinking must be the documented ones, at full width."""
import hal

LIMITS = {hal.HAL_BIT: (True, False), hal.HAL_FLOAT: (1.5e300, -2.25), hal.HAL_S32: (-2**31, 7),
          hal.HAL_U32: (2**32 - 1, 9), hal.HAL_S64: (-2**63, 2**62 + 3), hal.HAL_U64: (2**64 - 1, 2**63 + 5)}
checked = 0
for n, (kind, (first, second)) in enumerate(LIMITS.items()):
    c = hal.component("c%d" % n)
    reader, writer, both = (c.newpin(s, kind, d) for s, d in
                            (("reader", hal.HAL_IN), ("writer", hal.HAL_OUT), ("both", hal.HAL_IO)))
    c.ready()
    sig = "sig%d" % n
    assert not hal.new_sig(sig, kind)
    # A first pin of any direction gives its value; a writer wins over readers.
    reader.value = second
    assert not hal.connect("c%d.reader" % n, sig) and hal.get_s(sig) == second
    writer.value = first
    assert not hal.connect("c%d.writer" % n, sig)
    assert hal.get_s(sig) == first and reader.value == first and writer.value == first
    # The pin keeps the value at its full width, the signal keeps its own.
    writer.value = second
    assert not hal.disconnect("c%d.reader" % n)
    writer.value = first
    assert reader.value == second and hal.get_s(sig) == first
    assert not hal.disconnect("c%d.writer" % n) and writer.value == first
    # Without a writer the value stays; a later reader takes it.
    assert not hal.connect("c%d.both" % n, sig) and hal.get_s(sig) == both.value
    both.value = second
    assert not hal.connect("c%d.reader" % n, sig) and reader.value == second
    assert hal.connect("c%d.writer" % n, sig) and writer.value == first  # refused: there is an I/O pin
    c.exit()
    assert hal.get_s(sig) == second
    checked += 1
print("%d types" % checked)
