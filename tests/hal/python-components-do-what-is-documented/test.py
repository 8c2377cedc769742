"""Components, pins, parameters, ports and streams from Python: results and every error."""
import hal


def show(what, f, *args):
    try:
        print(what, "->", f(*args))
    except Exception as e:
        print(what, "->", type(e).__name__ + ":", e, *("(%s)" % n for n in getattr(e, "__notes__", ())))


c = hal.component("c")
p = {}
for name, kind, way in (("in", hal.HAL_FLOAT, hal.HAL_IN), ("s32", hal.HAL_S32, hal.HAL_OUT),
                        ("u32", hal.HAL_U32, hal.HAL_IO), ("s64", hal.HAL_S64, hal.HAL_OUT),
                        ("u64", hal.HAL_U64, hal.HAL_OUT), ("bit", hal.HAL_BIT, hal.HAL_IO),
                        ("tx", hal.HAL_PORT, hal.HAL_OUT), ("rx", hal.HAL_PORT, hal.HAL_IN)):
    p[name] = c.newpin(name, kind, way)
par = c.newparam("par", hal.HAL_FLOAT, hal.HAL_RO)
c.setprefix("other")
p["x"] = c.newpin("x", hal.HAL_BIT, hal.HAL_IN)
print(c.getprefix(), hal.get_info_pins()[-1]["NAME"], len(c))
c.setprefix("c")
show("duplicate pin", c.newpin, "in", hal.HAL_BIT, hal.HAL_IN)
show("duplicate param", c.newparam, "in", hal.HAL_BIT, hal.HAL_RW)
show("bad type", c.newpin, "y", 9, hal.HAL_IN)
show("port param", c.newparam, "y", hal.HAL_PORT, hal.HAL_RW)
show("bad direction", c.newpin, "y", hal.HAL_BIT, hal.HAL_RW)
show("long name", c.newpin, "y" * 54, hal.HAL_BIT, hal.HAL_IN)
show("longest name", lambda: c.newpin("y" * 53, hal.HAL_BIT, hal.HAL_IN).name)
show("exists", hal.component_exists, "c")
show("is ready", hal.component_is_ready, "c")
c.ready()
show("is ready", hal.component_is_ready, "c")
show("ready twice", c.ready)
show("late", c.newpin, "late", hal.HAL_BIT, hal.HAL_IN)
c.unready()
show("unready twice", c.unready)
c.ready()
show("same name", hal.component, "c")
print(c.getitem("in"), c.getitem("par"), par.name, par.type, par.dir, par.is_pin(), p["s32"].get_name())

for name, value in (("bit", True), ("bit", "Yes"), ("bit", "off"), ("bit", "2"), ("bit", 0.0),
                    ("bit", 1.0), ("bit", 0.5), ("bit", 7), ("bit", "maybe"), ("bit", None), ("in", 1), ("in", "2.5"),
                    ("in", "x"), ("in", None), ("in", float("inf")), ("s32", 2.9), ("s32", "-5"), ("s32", "0x10"),
                    ("s32", 2**31), ("s32", -2**31 - 1), ("s32", 2**80), ("u32", -1), ("u32", 2**32 - 1),
                    ("u32", 2**32), ("s64", -2**63), ("s64", 2**63),
                    ("u64", 2**64 - 1), ("u64", -1), ("u64", 2**64), ("s64", []), ("par", 3), ("tx", 3)):
    show("%s = %r" % (name, value), lambda: (c.__setitem__(name, value), c[name])[1])
c.bit = False
p["bit"].value = True
print(c.bit, p["bit"].get(), c["bit"], par.value, c.getpins()["bit"])
show("unknown", lambda: c["none"])
show("unknown", lambda: c.none)
show("unknown", lambda: c.__setitem__("none", 1))
show("unknown", lambda: setattr(c, "none", 1))
show("unknown", c.getpin, "none")
show("not a param", c.getparam, "in")
show("not a pin", c.getpin, "par")
show("delete", lambda: c.__delitem__("in"))
show("wrap", hal.Pin, c.getitem("par"))
show("wrap", hal.Param, c.getitem("in"))
show("wrap", hal.Pin, 5)
show("no port", lambda: p["in"].write("x"))
show("raw no port", lambda: c.getitem("in").write("x"))
show("raw param", lambda: c.getitem("par").write("x"))

hal.new_sig("port", hal.HAL_PORT), hal.connect("c.tx", "port"), hal.connect("c.rx", "port")
show("size", hal.set_s, "port", 10)
show("size again", hal.set_s, "port", 20)
for what, f, args in (("write", p["tx"].write, ("abc",)), ("write", p["tx"].write, (b"defghi",)),
                      ("write", p["tx"].write, ("j",)), ("write", p["tx"].write, ("",)), ("write", p["tx"].write, (5,)),
                      ("readable", p["rx"].readable, ()), ("writable", p["tx"].writable, ()),
                      ("peek", p["rx"].peek, (4,)), ("read", p["rx"].read, (10,)),
                      ("read", p["rx"].read, (2,)), ("peek_commit", p["rx"].peek_commit, (1,)),
                      ("read", p["rx"].read, ("x",)), ("read tx", p["tx"].read, (1,)),
                      ("write rx", p["rx"].write, ("x",)), ("read", p["rx"].read, (6,)),
                      ("clear", p["rx"].clear, ()), ("size", p["rx"].size, ()), ("writable rx", p["rx"].writable, ()),
                      ("readable tx", p["tx"].readable, ())):
    show("%s%r" % (what, args), f, *args)

print(hal.new_sig("s", hal.HAL_FLOAT), hal.new_sig("s", hal.HAL_FLOAT), hal.connect("c.in", "s"),
      hal.connect("c.in", "zz"))
print(hal.pin_has_writer("c.in"), hal.pin_has_writer("c.tx"), hal.disconnect("c.in"), hal.disconnect("none"))
show("has writer", hal.pin_has_writer, "none")
show("bad signal", hal.new_sig, "q", 8)
for name, value in (("c.u32", 5), ("c.u32", "6"), ("c.u32", "x"), ("c.u32", "0xFF"), ("c.u32", "0xG"), ("c.u32", "0x1FFFFFFFF"), ("c.in", "0x10"), ("c.s32", 5), ("none", 5), ("c.rx", 5), ("c.par", 1)):
    show("set_p %s %r" % (name, value), hal.set_p, name, value)
for name, value in (("s", 2.5), ("s", "x"), ("none", 1), ("port", 9)):
    show("set_s %s %r" % (name, value), hal.set_s, name, value)
print(hal.get_p("c.u32"), hal.get_p("none"), hal.get_s("s"), hal.get_s("none"), hal.get_s("port"), hal.get_value("s"))
show("get_value", hal.get_value, "none")
print([(i["NAME"], i["VALUE"], i["DIRECTION"], i["TYPE"]) for i in hal.get_info_params()])
print(hal.get_info_signals())
hal.set_msg_level(hal.MSG_NONE)
print(hal.get_msg_level(), hal.is_initialized(), hal.get_realtime_type(), hal.is_userspace, hal.kernel_version)
hal.set_msg_level(hal.MSG_ERR)

show("stream", hal.stream, c, 4711, 0, "f")
show("stream", hal.stream, c, 4711, 3, "fq")
show("stream", hal.stream, c, 4711)
w = hal.stream(c, 4711, 3, "fBsulk")
r = hal.stream(c, 4711, "FBS")
show("stream", hal.stream, c, 4711, "FBB")
print(w, r, r.element_types, r.maxdepth, r.readable, w.writable, r.read(), r.num_underruns)
for record in ((1, True, -1, 1, -2**63, 2**64 - 1), (0.5, 0, 2, 3, 4, 5), (0,) * 6, (1, 2), (1,) * 7,
               (1, 0, 2**31, 0, 0, 0), ("x", 0, 0, 0, 0, 0), [1, 2]):
    show("write %r" % (record,), w.write, record)
print(r.depth, r.num_overruns, r.read(), r.sampleno, r.read(), r.sampleno, r.read())
m = hal.shm(c, 4712, 100)
m.getbuffer()[:3] = b"abc"
print(bytes(hal.shm(c, 4712, 100).getbuffer()[:4]), "key=00001268" in repr(m), memoryview(m).nbytes)
print(repr(c).replace(str(c.id), "ID"))
item = c.getitem("in")
c.exit()
print(c)
show("closed", c.ready)
show("closed", c.exit)
show("closed", lambda: c["in"])
show("closed", item.get)
show("closed", p["in"].set, 5)
again = hal.component("c")
again.exit()
