import hal
import hal.query as query


def plain(d):
    """Without what differs from run to run."""
    if d is None:
        return None
    return {k: ("N" if k in ("comp_id", "id", "pid", "priority") else plain(v) if isinstance(v, dict) else v)
            for k, v in d.items() if k != "value" or not d["name"].endswith((".time", ".tmax"))}


c = hal.component("python")
print(plain(query.pin("y.out")), plain(query.pin("result")), sep="\n")
print(plain(query.param("x.tmax")), plain(query.param("x.out")), sep="\n")
print(plain(query.signal("sig")), plain(query.signal("none")), sep="\n")
print(plain(query.comp("and2")), query.comp("and2") == query.comp(query.comp("and2")["id"]), query.comp("none"),
      query.comp(0), sep="\n")
print(plain(query.comp("python")), query.comp("python")["pid"] > 0, query.comp("and2")["pid"])
print(plain(query.funct("x")), query.funct("none"), sep="\n")
print(plain(query.thread("fast")), plain(query.thread("slow")), query.thread("none"), sep="\n")
print(plain(query.signalpins("sig")), query.signalpins("none"), sep="\n")
for everything in (query.pins, query.params, query.signals, query.comps, query.functs, query.threads):
    found = everything()
    print(everything.__name__, list(found))
    assert all(name == d["name"] for name, d in found.items())
print(hal.get_realtime_type() >= hal.RTType.NONE)
