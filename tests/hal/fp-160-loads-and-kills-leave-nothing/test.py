"""A thousand loads and unloads take no memory but what the modules ask for; a realtime host
that is killed a hundred times leaves nothing to the next one, while a client goes on."""
import os
import select
import signal
import subprocess
import hal
import hal.query

TOP = os.environ["EMC2_HOME"]


def look():
    """KiB in use and pid of the host, after a look at the whole database."""
    out = subprocess.run([TOP + "/objects/test/hal-robust", "check"], capture_output=True, text=True)
    assert out.returncode == 0, out.stderr
    return [int(word) for word in out.stdout.split()]


def host(*words):
    return subprocess.run(("rtapi_app",) + words, stderr=subprocess.DEVNULL).returncode


client = hal.component("client")
pin = client.newpin("in", hal.HAL_FLOAT, hal.HAL_IN)
client.ready()
hal.new_sig("kept", hal.HAL_FLOAT)
hal.connect("client.in", "kept")
hal.set_s("kept", 4.5)

host("load", "and2"), host("unload", "and2")
before = look()[0]
for n in range(1000):
    assert host("load", "and2") == 0 and host("unload", "and2") == 0, n
grown = look()[0] - before
print("memory holds" if grown < 400 else "memory grew by %d KiB" % grown)

for n in range(100):
    assert host("load", "threads", "period1=200000") == 0 and host("load", "and2", "count=3") == 0, n
    for words in (("addf", "and2.1", "thread1"), ("net", "kept2", "and2.0.out"), ("start",)):
        assert subprocess.run(("halcmd",) + words).returncode == 0
    pid = look()[1]
    process = os.pidfd_open(pid)
    os.kill(pid, signal.SIGKILL)
    select.select([process], [], [])     # readable when it has ended, whoever waits for it
    os.close(process)
    assert subprocess.run((TOP + "/scripts/realtime", "start")).returncode == 0
    assert list(hal.query.comps()) == ["client"] and not hal.query.threads() and not hal.query.functs()
    assert pin.value == 4.5 and hal.get_s("kept") == 4.5
print("a hundred hosts, one client")
