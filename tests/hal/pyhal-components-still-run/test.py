"""The older Python interface: components, pins, ports, signals, and what is refused."""
import warnings

with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    import pyhal
print([w.category.__name__ for w in told])
from pyhal import HalException, component, halType, pinDir  # noqa: E402


def show(what, f, *args):
    try:
        print(what, "->", f(*args))
    except HalException as e:
        print(what, "-> HalException:", e)


c = component("c")
for name, kind in (("bit", halType.BIT), ("float", halType.FLOAT), ("s32", halType.SIGNED), ("u32", halType.UNSIGNED)):
    p = c.pinNew(name, kind, pinDir.OUT)
    p.value = 1
    print(p.fullname, p.name, p.type, p.dir, p.value, c.pins[name] is p)
show("same name", c.pinNew, "bit", halType.BIT, pinDir.IN)
show("type", c.pinNew, "x", 6, pinDir.IN)
show("direction", c.pinNew, "x", halType.BIT, 64)
tx, rx = c.pinNew("tx", halType.PORT, pinDir.OUT), c.pinNew("rx", halType.PORT, pinDir.IN)
c.ready()
show("ready twice", c.ready)
show("late", c.pinNew, "late", halType.BIT, pinDir.IN)
show("component", component, "c")
s = c.sigNew("s", halType.PORT)
show("signal", c.sigNew, "s", halType.PORT)
c.sigLink("c.tx", "s")
c.sigLink("c.rx", "s")
show("link", c.sigLink, "c.none", "s")
s.value = 10
show("size again", setattr, s, "value", 20)
print(type(s) is pyhal.signal, s.name, s.type, s.value)
for what, f, args in (("write", tx.write, ("abc",)), ("write", tx.write, (b"defghi",)), ("write", tx.write, ("j",)),
                      ("writable", tx.writable, ()), ("readable", rx.readable, ()), ("peek", rx.peek, (2,)),
                      ("read", rx.read, (4,)), ("read", rx.read, (6,)), ("drop", rx.peek_commit, (1,)),
                      ("size", rx.size, ()), ("wait", rx.waitReadable, (4,)), ("wait", tx.waitWritable, (4,)),
                      ("clear", rx.clear, ()), ("readable", rx.readable, ()), ("read tx", tx.read, (1,)),
                      ("write rx", rx.write, ("x",)), ("value", lambda: tx.value, ())):
    show(what, f, *args)
c.exit()
c.exit()
print(pyhal.hal.component_exists("c"))
