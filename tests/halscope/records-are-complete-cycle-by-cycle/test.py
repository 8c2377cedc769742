"""Records of several lengths, multipliers and trigger places against the stream of sampler."""
from bench import acquire, clock, comp, hal, record, source, st

acq = acquire.Acquisition(comp, 8000)
acq.link("base")
print("thread", acquire.linked_thread(), "samples", acq.samples, "period", acq.period(1))
stream = hal.stream(comp, hal.sampler_base)
clock.run(["halcmd", "start"])
for mult, pos, channels in ((1, 0.5, 2), (1, 0.0, 2), (1, 1.0, 2), (7, 0.25, 2), (1, 0.5, 8)):
    s = st.Settings(mult=mult, run_mode=st.SINGLE)
    s.trigger.pos, s.trigger.source, s.trigger.auto = pos, 2, False
    for n in range(1, channels + 1):
        source(s, n, *(("sig", "beat") if n % 2 else ("pin", "siggen.0.sine")))
    while stream.read():
        pass
    r = record(acq, s)
    by_beat, lost = {}, stream.num_overruns
    while (row := stream.read()) is not None:
        by_beat[row[0]] = row[1]
    beats, sines = r.values[1], r.values[2]
    steps = {int(b - a) for a, b in zip(beats, beats[1:])}
    wrong = sum(by_beat.get(int(b)) != v for b, v in zip(beats, sines))
    t = r.trigger
    edge = t == 0 or (sines[t - 1] <= 0 < sines[t])
    same = all(r.values[n] == r.values[2 - n % 2] for n in range(3, channels + 1))
    print(f"mult {mult} place {pos} channels {channels}: {r.count} samples of {r.period} ns, trigger at {t}, "
          f"cycles between samples {steps}, differ from sampler {wrong}, edge {edge}, channels agree "
          f"{same}, lost {lost}")

# Rolling: pieces that are fetched now and then fit together.
s = st.Settings(run_mode=st.ROLL)
source(s, 1, "sig", "beat")
acq.start(s)
seen = set()
for _ in range(20):
    clock.sleep(0.01)
    r = acq.poll()
    if r is not None and r.count:
        steps = {int(b - a) for a, b in zip(r.values[1], r.values[1][1:])}
        assert steps <= {1}, steps
        seen.update(int(b) for b in r.values[1])
print("rolling: every cycle seen", len(seen) == max(seen) - min(seen) + 1, "at least 7900:", len(seen) >= 7900)
acq.stop()
clock.sleep(0.001)
print("idle", acq.idle)

# The function goes to another thread, and its component comes anew, in the middle of a record.
s = st.Settings(run_mode=st.SINGLE)
source(s, 1, "sig", "beat")
acq.start(s)
clock.sleep(0.02)
acq.link("slow")
r = record(acq, s, meanwhile=lambda: acquire.linked_thread() == "slow" and acq.scope.count > 13000 and acq.link("base"))
print("moved:", acquire.linked_thread(), r.period, {int(b - a) for a, b in zip(r.values[1], r.values[1][1:])}, r.count)
source(s, 2, "pin", "siggen.0.sine")
acq.start(s)
clock.run(["halcmd", "delf", "siggen.0.update", "base"])
clock.run(["halcmd", "unloadrt", "siggen"])
acq.poll()
print("gone:", acq.missing)
clock.run(["halcmd", "delf", "scope.sample", "base"])
clock.run(["halcmd", "unloadrt", "scope_rt"])
acq.link("slow")
s.channel(2).enabled = False
r = record(acq, s)
print("loaded again:", acquire.linked_thread(), r.period, r.count, acq.missing)
acq.close()
comp.exit()
