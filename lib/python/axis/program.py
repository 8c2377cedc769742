# SPDX-License-Identifier: GPL-2.0-or-later
"""Opening programs: filters, the text that is shown, the preview's data. No widgets here."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile

from kerf import process

from .reading import MOST_MB, Reading
from .settings import LETTERS, MM_PER_INCH

PROGRESS = re.compile(r"FILTER_PROGRESS=(\d+)$")


# active G codes that change the path of a program which does not set them itself: plane, units, distances, diameters,
# return of cycles
PATH_CODES = {170, 171, 180, 181, 190, 191, 200, 210, 900, 901, 910, 911, 70, 80, 980, 990}


def path_codes(stat):
    return tuple(code for code in stat.gcodes[3:] if code in PATH_CODES)


class FilterFailed(Exception):
    """A filter ended with an error. `program`, `status`, `text`: what it printed."""

    def __init__(self, program, status, text):
        super().__init__(f"The program '{program}' exited with code {status}.  Any error messages it "
                         "produced are shown below:")
        self.program, self.status, self.text = program, status, text


def text_hash(path):
    """SHA-256 of a file as task has it in stat.program_hash; None when it can not be read."""
    found = hashlib.sha256()
    try:
        with open(path, "rb") as f:
            while piece := f.read(1 << 20):
                found.update(piece)
    except OSError:
        return None
    return found.hexdigest()


class Loader:
    """Programs of one screen; temporary files live in its folder until close()."""

    def __init__(self, settings, folder=None):
        """folder: that of a screen that crashed, whose files task may still read."""
        self.s = settings
        self.folder = folder or tempfile.mkdtemp(prefix="axis-")
        self.command = None          # the process of somebody else's command that runs
        self.reading = None          # the last reading
        self.megabytes = MOST_MB

    def close(self):
        self.end()
        if self.reading:
            self.reading.kill()
        shutil.rmtree(self.folder, ignore_errors=True)

    # -- filters ---------------------------------------------------------------------------

    def filter_for(self, path):
        """Command of [FILTER] for the file's extension, or None."""
        extension = os.path.splitext(path)[1][1:]
        return self.s.find("FILTER", extension) if extension else None

    def file_types(self, translate=str):
        """(description, patterns) for the open dialog."""
        types, every = [], [".ngc"]
        for line in self.s.ini.findall("FILTER", "PROGRAM_EXTENSION") or []:
            extensions, *description = line.split(None, 1) or [""]
            names = extensions.split(",")
            types.append((description[0] if description else extensions, names))
            every += names
        return [(translate("All machinable files"), every), (translate("rs274ngc files"), [".ngc"]), *types,
                (translate("All files"), "*")]

    def filtered(self, path, progress=lambda percent: None):
        """Path of the G-code that a filter makes of a file. Raises FilterFailed."""
        program = self.filter_for(path)
        target = os.path.join(self.folder, "filtered-" + os.path.basename(path))
        quoted = path.replace("'", "'\\''")
        messages = []

        def said(line):
            match = PROGRESS.match(line.strip())
            if match:
                progress(int(match[1]))
            else:
                print(line, end="")
                messages.append(line)
        status = self.run(f"{program} '{quoted}'", target, said)
        if status:
            raise FilterFailed(program, status, "".join(messages))
        return target

    def run(self, command, target, said):
        """Runs a shell command whose output becomes the file `target`; said(line) gets its
        messages. Returns the exit status."""
        with open(target, "wb") as out:
            child = subprocess.Popen([sys.executable, process.__file__, str(os.getpid()), "sh", "-c", command],
                                     stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True,
                                     errors="replace", env=os.environ | {"AXIS_PROGRESS_BAR": "1"})
            self.command = child
            for line in child.stderr:
                said(line)
            status = child.wait()
            self.command = None
        return status

    def end(self):
        """Ends what runs: a command with what it started; a reading hands over what it has."""
        command = self.command       # the other thread may end it
        if command is not None:
            command.terminate()
        if self.reading is not None:
            self.reading.stop()

    def look(self):
        """To be called now and then while something runs."""
        if self.reading is not None:
            self.reading.look()

    def snapshot(self, path):
        """A copy of the file that later edits do not touch."""
        target = os.path.join(self.folder, os.path.basename(path))
        if os.path.realpath(target) != os.path.realpath(path):
            shutil.copyfile(path, target)
        return target

    def kept_text(self, path):
        """A copy that text, preview and estimate are made from: an editor may change the file meanwhile."""
        folder = os.path.join(self.folder, "kept")
        os.makedirs(folder, exist_ok=True)
        target = os.path.join(folder, os.path.basename(path))
        for old in os.listdir(folder):
            os.remove(os.path.join(folder, old))
        shutil.copyfile(path, target)
        return target

    # -- preview ---------------------------------------------------------------------------

    def init_codes(self, stat):
        """Lines that bring the preview's interpreter into the machine's present state."""
        startup = self.s.find("EMC", "RS274NGC_STARTUP_CODE") or self.s.find("RS274NGC", "RS274NGC_STARTUP_CODE")
        codes = [startup] if startup else []
        if self.s.find("TASK", "INTERPRETER"):
            return codes
        codes += ["G21" if self.s.units_per_mm == 1 else "G20", "g90"]
        if stat.tool_in_spindle > 0:
            codes.append(f"t{stat.tool_in_spindle} m6")
        for letter in self.s.axes:
            value = stat.position[LETTERS.index(letter)]
            if self.s.flag(f"AXIS_{letter}", "WRAPPED_ROTARY"):
                value %= 360
            codes.append(f"g53 g0 {letter}{value:.8f}")
        for code in stat.gcodes[3:]:
            if code not in (-1, 200, 210):
                codes.append(f"G{code / 10:.1f}" + (f" S{stat.settings[2]:.0f}" if code == 960 else ""))
        offset = "".join(f" {c}{stat.tool_offset[LETTERS.index(c)]:.8f}" for c in self.s.axes)
        codes.append("G43.1" + offset)          # machine units, as up to here
        codes += [f"G{code / 10:.0f}" for code in stat.gcodes if code in (200, 210)]
        codes += [f"M{code}" for code in stat.mcodes[2:] if code != -1]
        return codes

    def own_parameters(self, name):
        """Path of a private copy of the machine's parameter file."""
        copy = os.path.join(self.folder, name)
        own = os.path.join(os.path.dirname(os.path.abspath(self.s.ini_path)), self.s.find("RS274NGC", "PARAMETER_FILE"))
        if os.path.exists(own):
            shutil.copyfile(own, copy)
        return copy

    def conditions(self, path, stat, block_delete):
        """What the path depends on, but for where the machine stands."""
        codes = [code for code in self.init_codes(stat) if not code.startswith("g53 ")]
        return (path, codes, block_delete, tuple(stat.g5x_offset), tuple(stat.g92_offset), stat.rotation_xy,
                stat.g5x_index)

    def read(self, path, stat, block_delete, places, seconds):
        """A Reading of the file as the machine would run it now; places, seconds: as for Reading."""
        arguments = dict(filename=path, parameter_file=self.own_parameters("preview.var"),
                         initcodes=self.init_codes(stat), tools=[tuple(t)[:14] for t in stat.tool_table],
                         axis_mask=self.s.axis_mask, linear_units=self.s.units_per_mm, ini=self.s.ini_path,
                         arc_division=int(self.s.real(("DISPLAY", "ARCDIVISION"), default=64)),
                         block_delete=block_delete, interpreter=self.s.find("TASK", "INTERPRETER") or "")
        self.reading = Reading(arguments, self.max_feed(), places, seconds, self.megabytes)
        return self.reading

    def max_feed(self):
        """Inches a minute."""
        return self.s.max_linear / (self.s.units_per_mm * MM_PER_INCH) * 60

    def too_large(self, path):
        """True for a file that [DISPLAY]GRAPHICAL_MAX_FILE_SIZE (MB) lets be shown as a box only."""
        most = self.s.real(("DISPLAY", "GRAPHICAL_MAX_FILE_SIZE"), default=0.0)
        return most > 0 and os.path.getsize(path) > most * 1e6


def parameter(path, number):
    """Value of a parameter in a parameter file; 0 where it is not there."""
    with open(path) as f:
        rows = [line.split() for line in f]
    return next((float(row[1]) for row in rows if len(row) == 2 and row[0] == str(number)), 0.0)


def foam_planes(program, settings):
    """Heights of the planes XY and UV of a foam cutter, inches: of the program, else of the INI file."""
    return (settings.foam_z if program.foam_z is None else program.foam_z,
            settings.foam_w if program.foam_w is None else program.foam_w)


def extents(program, settings):
    """Least and greatest X, Y and Z without tool lengths, inches; Z of a foam cutter: its planes."""
    low, high = program.extents
    if settings.foam:
        planes = foam_planes(program, settings)
        low, high = (*low[:2], min(planes)), (*high[:2], max(planes))
    return low, high


def beyond(program, settings, stat, axis):
    """Whether a program leaves the soft limits of X, Y or Z (axis 0 to 2): (below the least, above the greatest)."""
    if "XYZ"[axis] not in settings.axes or program.n_moves == 0:
        return False, False
    scale, limits = MM_PER_INCH * settings.units_per_mm, stat.axis[axis]
    low, high = program.extents_tool
    return (low[axis] * scale < limits["min_position_limit"] - 1e-6,
            high[axis] * scale > limits["max_position_limit"] + 1e-6)


def limit_warnings(program, settings, stat, translate=str):
    """Warnings where the program leaves the soft limits of X, Y or Z, or where nobody knows."""
    if program is None:
        return []
    warnings = []
    for i, letter in enumerate("XYZ"):
        below, above = beyond(program, settings, stat, i)
        if below:
            warnings.append(translate("Program exceeds machine minimum on axis %s") % letter)
        if above:
            warnings.append(translate("Program exceeds machine maximum on axis %s") % letter)
    if program.aborted:
        warnings.append(translate("G-code preview was truncated before completion; machine limits could not "
                                  "be fully checked."))
    return warnings


def properties(path, source, program, settings, metric, translate=str, run_time=None, kept=None):
    """(name, value) lines of the properties dialog. run_time: seconds that the planner needs, None: not known yet.
    kept: the copy that is loaded."""
    if path is None:
        return [(translate("Name"), translate("No file loaded"))]
    kept = kept or path
    with open(kept, errors="replace") as f:
        lines = sum(1 for _ in f)
    rows = [(translate("Name"), path if source is None else translate("generated from %s") % source),
            (translate("Size"), translate("%d bytes\n%d G-code lines") % (os.path.getsize(kept), lines))]
    total = text_hash(kept)
    if total:
        rows.append(("SHA-256", f"{total[:32]}\n{total[32:]}"))
    if program is None:
        return rows
    scale, fmt, unit = (MM_PER_INCH, "%.3f", "mm") if metric else (1.0, "%.4f", "in")

    def length(inches):
        return f"{fmt % (inches * scale)} {unit}"
    seconds = program.seconds if run_time is None else run_time
    rows += [(translate("Rapid distance"), length(program.rapid_length)),
             (translate("Feed distance"), length(program.cutting_length)),
             (translate("Run time"), translate("%.1f minutes") % (seconds / 60) if seconds > 120
              else translate("%d seconds") % seconds),
             (translate("Tool Change List"), " ".join(str(tool) for _, tool in program.tools))]
    if program.n_moves:
        low, high = extents(program, settings)
        rows += [(translate("%s bounds") % c,
                  translate("%s to %s = %s")
                  % (fmt % (low[i] * scale), fmt % (high[i] * scale), length(high[i] - low[i])))
                 for i, c in enumerate("XYZ") if low[i] != high[i]]
    return rows
