# SPDX-License-Identifier: GPL-2.0-or-later
"""Programs are read for the preview and the limits by a process of its own (FP-136): the screen answers whatever a
program, a remap or an interpreter does, and goes on when that process crashes or gets no more memory.

Reading is the screen's end of it, main() the process. What is drawn comes back in files in memory
(kerf_raster.Drawing.mapped), all else as one Program. No widgets here. Inches, degrees, inches a minute, seconds.
"""

import contextlib
import io
import os
import pickle
import select
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field, fields

from kerf import process

MOST_VERTICES = 3000000  # of the drawing; longer paths are drawn coarser
MOST_MB = 400            # that the process may take
LOOK_S = 0.1             # whether the process is still there
GRACE_S = 1.0            # for the process to hand over what it has, when it is asked to stop or its time is over


@dataclass
class Program:
    """What a program does, as gcode.Program tells it, but for the path."""
    n_moves: int = 0
    rapid_length: float = 0.0
    cutting_length: float = 0.0
    dwell_time: float = 0.0
    extents: tuple = ((0.0,) * 3, (0.0,) * 3)
    extents_tool: tuple = ((0.0,) * 3, (0.0,) * 3)
    tools: list = field(default_factory=list)
    messages: list = field(default_factory=list)
    result: int = 0
    last_line: int = 0
    error: str = ""
    fault: dict = None
    aborted: bool = True         # not read to its end
    thinned: int = 1
    foam_z: float = None
    foam_w: float = None
    notify: int = 0
    notify_message: str = ""
    seconds: float = 0.0         # lengths by feeds, and dwells
    # of dwells, of user M codes: rows of four float32, x y z and plane (0 XY, 1 XZ, 2 YZ)
    mark_places: tuple = (b"", b"")
    late: bool = False           # aborted because its time was over
    failed: str = ""             # why the process ended without an answer

    @classmethod
    def of(cls, loaded, max_feed):
        """From a gcode.Program; max_feed: inches a minute, of rapids too."""
        same = {f.name: getattr(loaded, f.name)
                for f in fields(cls) if hasattr(loaded, f.name) and f.name != "mark_places"}
        return cls(**same, seconds=loaded.run_time(max_feed, max_feed),
                   mark_places=(loaded.mark_places(False), loaded.mark_places(True)))


def drawing(loaded, plane, z, geometry, offset, coordinates):
    """What is drawn of a gcode.Program. plane: -1 space, 0 and 1 those of a foam cutter, at height z where the program
    gives none."""
    import kerf_raster
    given = (loaded.foam_z, loaded.foam_w)[plane] if plane >= 0 else None
    return kerf_raster.Drawing(loaded.points, loaded.kinds, loaded.lines, geometry, offset, coordinates, plane,
                               z if given is None else given)


class Reading:
    """One reading. Made and stopped by the main thread (with which the process ends), result()
    may wait in another one."""

    def __init__(self, arguments, max_feed, places, seconds, megabytes):
        """arguments: of gcode.load(); places: arguments of drawing() for each drawing, none:
        only the extents are of interest."""
        self.files = [os.memfd_create("axis-drawing") for _ in places]
        self.megabytes, self.end, self.stopped, self.killed = (megabytes, time.monotonic() + seconds + GRACE_S,
                                                               None, False)
        wanted = os.memfd_create("axis-wanted")
        with open(wanted, "wb", closefd=False) as f:
            pickle.dump((arguments, max_feed, list(places), self.files, seconds, megabytes), f)
        os.lseek(wanted, 0, os.SEEK_SET)
        self.reports, writing = os.pipe()
        start = f"import sys; sys.path[:] = {sys.path!r}; from axis.reading import main; sys.exit(main({os.getpid()}, {wanted}, {writing}))"
        try:
            self.child = subprocess.Popen([sys.executable, "-c", start], stdin=subprocess.PIPE, start_new_session=True,
                                          pass_fds=[wanted, writing, *self.files])
        finally:
            os.close(wanted)
            os.close(writing)

    def result(self, progress=lambda line: None):
        """(Program, drawings); progress(line) tells how far it is."""
        import kerf_raster
        program, drawings = None, []
        for line, program in self.messages():
            progress(line)
            if program is not None:
                break
        os.close(self.reports)
        self.child.stdin.close()
        with contextlib.suppress(ChildProcessError, ProcessLookupError):
            os.waitid(os.P_PID, self.child.pid, os.WEXITED | os.WNOWAIT)
            os.killpg(self.child.pid, signal.SIGKILL)        # what a remap in Python started
        status = self.child.wait()
        if program is None:
            program = Program(late=self.killed and self.stopped is None,
                              failed="" if self.killed else f"signal {-status}" if status < 0 else f"status {status}")
        elif not program.failed:
            drawings = [kerf_raster.Drawing.mapped(fd) for fd in self.files]
        for fd in self.files:
            os.close(fd)
        self.files = []
        return program, drawings

    def messages(self):
        """What the process tells until it ends, also when something that it started keeps the pipe open."""
        data = b""
        while True:
            ended = self.ended()         # before the look: what it told until then is there
            if select.select([self.reports], [], [], LOOK_S)[0]:
                got = os.read(self.reports, 1 << 20)
                if not got:
                    return
                data += got
            elif ended:
                return
            while data:
                stream = io.BytesIO(data)
                try:
                    message = pickle.load(stream)
                except (EOFError, pickle.UnpicklingError):       # not yet whole
                    break
                data = data[stream.tell():]
                yield message

    def ended(self):
        """Whether the process is no more."""
        try:
            return os.waitid(os.P_PID, self.child.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None
        except ChildProcessError:
            return True

    def stop(self):
        """Asks for what there is so far."""
        if self.stopped is None:
            self.stopped = time.monotonic()
            self.child.stdin.close()

    def look(self):
        """Ends a process that does not answer; to be called now and then."""
        now = time.monotonic()
        if (now > self.end or self.stopped and now > self.stopped + GRACE_S) and not self.ended():
            self.kill()

    def kill(self):
        self.killed = True
        if not self.ended():
            os.killpg(self.child.pid, signal.SIGKILL)


def read(arguments, max_feed, places, files, seconds, tell):
    """Reads and writes the drawings. tell(line): True to stop."""
    import gcode
    end, late = time.monotonic() + seconds, False

    def progress(line):
        nonlocal late
        late = time.monotonic() > end
        return late or tell(line)
    loaded = gcode.load(**arguments, progress=progress, max_vertices=MOST_VERTICES, keep_path=bool(places),
                        hal_component="preview")
    for place, fd in zip(places, files):
        drawing(loaded, *place).write(fd)
    program = Program.of(loaded, max_feed)
    program.late = late
    return program


def main(parent, wanted, writing):
    """The process: the request from one descriptor, reports to another; its standard input ends when it shall stop."""
    process.end_with_parent(signal.SIGKILL, parent)
    with open(wanted, "rb") as f:
        *request, megabytes = pickle.load(f)
    process.give_back_memory()
    process.limit_memory(megabytes)

    def report(*what):
        os.write(writing, pickle.dumps(what))

    def tell(line):
        report(line, None)
        return bool(select.select([0], [], [], 0)[0])
    try:
        program = read(*request, tell)
    except MemoryError:
        program = Program(failed="memory")
    with open(writing, "wb") as f:
        pickle.dump((program.last_line, program), f)
    return 0
