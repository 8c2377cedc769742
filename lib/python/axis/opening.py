# SPDX-License-Identifier: GPL-2.0-or-later
"""Opening and starting programs: the dialogs, the text, the progress bar."""

import _tkinter
import filecmp
import os
import sys
import threading
import time

import linuxcnc
from kerf import clock
from kerf.tree import Tree

from . import dialogs, program
from .codeview import line_starts
from .estimate import Rates


LONGEST_PREVIEW_S = 60.0     # a program without an end is not read for ever, also without PREVIEW_TIMEOUT

LONGEST_RESTORE_S = 120.0

BESIDE_S = 0.02              # the screen looks around so often while something long is done
ANSWER_S = 0.1               # and goes on with it after this time at the latest
LONGEST_NAME = 250           # task cuts longer paths off
LONGEST_OPEN_S = 5.0         # of task
OPEN_TRIES = 3               # while somebody writes the file
HASHED_AT_ONCE = 1 << 20     # bytes; what takes longer is done beside


class OpeningPart:
    """Part of App: the program that is loaded."""

    def show_recent(self):
        self.root.tk.call("update_recent", *self.prefs.recent())

    def add_recent(self, path):
        self.prefs.add_recent(os.path.abspath(path))
        self.show_recent()

    def open_file_guts(self, path, filtered=False, addrecent=True):
        """Opens a program: filter, task, text, preview."""
        if self.running() or self.loading:
            return
        path = os.path.abspath(path)
        if not os.path.isfile(path):
            self.notifications.add("error", self.translate("There is no file %s") % path)
            return
        if addrecent:
            self.add_recent(path)
        self.set_highlight_line(-1)
        shown = path
        through_filter = bool(self.loader.filter_for(path))
        self.begin_progress()
        try:
            if through_filter and not filtered:
                try:
                    shown = self.beside(self.loader.filtered, path, lambda percent: self.progress(percent / 2))
                except program.FilterFailed as e:
                    if self.cancel_loading:
                        return
                    text = self.translate("The program '%s' exited with code %d.  Any error messages it "
                                          "produced are shown below:") % (e.program, e.status)
                    dialogs.ask(self.root, self.translate("Filter failed"), text, "error", 0,
                                self.translate("OK"), extra=e.text)
                    return
            elif through_filter:
                shown = os.path.join(self.loader.folder, "filtered-" + os.path.basename(path))
            self.loaded_file, self.shown_file, self.is_filtered = path, shown, through_filter
            self.load_shown()
        finally:
            if not dialogs.closed(self.root):
                self.end_progress()
                self.root.tk.call("set_mode_from_tab")

    def open_pipe(self, command):
        """Opens what a shell command writes to its standard output."""
        if self.running() or self.loading:
            return
        path = os.path.join(self.loader.folder, "pipe.ngc")
        self.begin_progress()
        try:
            status = self.beside(self.loader.run, command, path, lambda line: print(line, end="", file=sys.stderr))
        finally:
            self.end_progress()
        if self.cancel_loading:
            return
        if status:
            self.notifications.add("error", f"{command}: {self.translate('ended with status %d') % status}")
        else:
            self.open_file_guts(path, addrecent=False)

    def load_shown(self):
        """Task, text and preview take the same program (FP-130); a change on disk meanwhile is told."""
        c = self.command
        self.user["loaded_file"] = self.loaded_file
        if self.manual_ok():
            self.ensure_mode(linuxcnc.MODE_MANUAL)
        c.task_plan_synch()
        self.until_done()
        # what is copied is what task takes: the file does not change from the one to the other
        for _ in range(OPEN_TRIES):
            self.disk_state, self.changed_on_disk = self.state_on_disk(), False
            self.kept = self.beside(self.loader.kept_text, self.shown_file)
            kept = self.beside(program.text_hash, self.kept)
            loaded = self.beside(program.text_hash, self.loaded_file) if self.is_filtered else kept
            self.loaded_text = self.disk_state and self.disk_state[0], loaded
            c.program_open(self.shown_file)
            self.until_done()
            self.stat.poll()
            if self.stat.program_hash == kept or self.state_on_disk() == self.disk_state:
                break
        self.show_kept()

    def other_program(self):
        """Path of the program that another client opened in task, or None. Task names it while nothing runs."""
        s = self.stat
        begins = self.first_waits or self.taking_up or self.loading
        if begins or s.interp_state != linuxcnc.INTERP_IDLE or not s.file or len(s.file) >= LONGEST_NAME:
            return None
        same = bool(self.shown_file) and os.path.realpath(s.file) == os.path.realpath(self.shown_file)
        return None if same or not os.path.isfile(s.file) else s.file

    def follow_opened(self):
        """FP-130: what another client opened would run: it is shown, nothing is commanded. True when it was so."""
        path = self.other_program()
        if not path:
            return False
        self.set_highlight_line(-1)
        self.begin_progress()
        try:
            self.loaded_file = self.shown_file = self.user["loaded_file"] = path
            self.is_filtered = False
            self.disk_state, self.changed_on_disk = self.state_on_disk(), False
            self.kept = self.beside(self.loader.kept_text, path)
            self.show_kept()
            text = self.translate("Another program opened %s. It is shown now.")
            self.notifications.add("info", text % os.path.basename(path))
        except OSError as e:
            self.notifications.add("error", f"{path}: {e.strerror}")
        finally:
            self.end_progress()
        return True

    def show_kept(self):
        self.loads += 1
        self.code.load(self.kept, self.beside(line_starts, self.kept))
        self.read_preview()
        self.show_title()
        self.mark_cut_off()

    def mark_cut_off(self):
        """The line at which the last run was cut off, in the program of that run."""
        s = self.stat
        if (s.cut_off_line > 0 and os.path.realpath(s.cut_off_file) in (os.path.realpath(f)
                                                                        for f in (self.loaded_file, self.shown_file))):
            self.set_highlight_line(s.cut_off_line)
            self.notifications.add("info",
                                   self.translate("The last run was cut off at line %d, which is marked. Home the "
                                                  "machine, then start at the selected line: "
                                                "each item is shown before anything moves.") % s.cut_off_line)
        self.loading = False
        self.keep_record(True)

    def answer(self):
        """Handles what waits, for ANSWER_S at most: on a slow machine the next update cycle is due before the last one
        is drawn, and Tk's own update() would never come back."""
        end = time.monotonic() + ANSWER_S
        while self.root.tk.dooneevent(_tkinter.DONT_WAIT) and time.monotonic() < end:
            pass

    def until_done(self):
        """Task did the last command, or LONGEST_OPEN_S have passed; the screen goes on."""
        end = time.monotonic() + LONGEST_OPEN_S
        while self.command.wait_complete(BESIDE_S) == -1 and time.monotonic() < end:
            self.answer()

    def refresh_preview(self):
        """The preview alone is read anew; the view stays."""
        if not self.loaded_file or self.loading:
            return
        centre, size = list(self.preview.camera.centre), self.preview.camera.size
        self.write_parameters()
        self.begin_progress()
        try:
            self.read_preview(quiet=True)
        finally:
            self.end_progress()
        self.preview.camera.centre, self.preview.camera.size = centre, size
        self.preview.invalidate()

    def read_preview(self, quiet=False):
        """Interprets the program for the picture, the limits and the properties. quiet: faults are known already."""
        self.stat.poll()
        self.stale_since = None
        timeout = self.settings.real(("DISPLAY", "PREVIEW_TIMEOUT"), default=0.0)
        boxed = self.loader.too_large(self.shown_file)
        self.preview.drop_program(drawings=not quiet)
        path, drawings = self.read_program(() if boxed else self.preview.places(),
                                           timeout if timeout > 0 else LONGEST_PREVIEW_S, 50)
        self.picture_conditions = self.limit_conditions
        if self.cancel_loading and quiet:
            return
        self.preview.set_program(path, drawings, boxed)
        self.estimate_time()
        name = os.path.basename(self.shown_file)
        if path.late:
            self.tell_of_preview(self.translate("G-code preview loading timed out"))
        elif path.failed == "memory":
            self.tell_of_preview(self.translate("The preview of %s needs more than %d MB of memory. Nothing is drawn; "
                                                "the program can be run.") % (name, self.loader.megabytes))
        elif path.failed:
            self.tell_of_preview(self.translate("The preview of %s ended by a fault (%s). Nothing is drawn; the "
                                                "program can be run.") % (name, path.failed))
        if quiet:
            return
        if boxed:
            self.tell_of_preview(self.translate("The file is larger than GRAPHICAL_MAX_FILE_SIZE: only "
                                                "its bounds are drawn"))
        elif path.thinned > 1:
            self.tell_of_preview(self.translate("The program is very long: one piece of %d is drawn") % path.thinned)
        if path.notify:
            self.notifications.add("info", path.notify_message)
        if path.error and not path.aborted:
            fault = path.fault
            line = fault["line"] if fault else path.last_line
            dialogs.ask(self.root, self.translate("G-Code error in %s") % os.path.basename(self.shown_file),
                        self.translate("Near line %d of %s:\n%s") % (line, self.shown_file, path.error), "error", 0,
                        self.translate("OK"), extra=fault["report"] if fault else None)

    def tell_of_preview(self, text):
        """Once for each loading."""
        self.notifications.add("info", text)
        print(f"axis: {self.shown_file}: {text}", file=sys.stderr)

    def read_program(self, places, seconds, percent):
        """(reading.Program, drawings) of the program as it would run now; the limits are checked against it. percent:
        of the bar, where it begins."""
        self.stat.poll()
        block_delete, total = bool(self.vars.block_delete.get()), max(1, self.code.total)
        conditions = self.conditions()
        reading = self.loader.read(self.kept, self.stat, block_delete, places, seconds)
        path, drawings = self.beside(reading.result,
                                     lambda line: self.progress(percent + (100 - percent) * min(1, line / total)))
        if path.fault:                           # is told of the file that the operator knows
            path.fault = {name: value.replace(self.kept, self.shown_file) if isinstance(value, str) else value
                          for name, value in path.fault.items()}
        self.limit_path, self.limit_conditions = path, conditions
        self.limits_final = (not path.aborted or path.late and seconds >= LONGEST_PREVIEW_S or bool(path.failed)
                             and not places)
        return path, drawings

    def conditions(self):
        """What the path of the program depends on now."""
        return self.loader.conditions(self.shown_file, self.stat, bool(self.vars.block_delete.get()))

    def find_limits(self):
        """The limits do not depend on the preview (FP-136): where it was cancelled or capped, did not come about, or
        was made under other conditions, they get a reading of their own, without a drawing.
        False: the operator ended it."""
        self.stat.poll()
        if not self.shown_file or self.stat.interp_state != linuxcnc.INTERP_IDLE:
            return True
        if self.limits_final and self.limit_conditions == self.conditions():
            return True
        self.write_parameters()
        self.begin_progress()
        try:
            self.read_program((), LONGEST_PREVIEW_S, 0)
        finally:
            self.end_progress()
        return not self.cancel_loading

    def estimate_time(self):
        """The run time is found out anew, from where the machine stands."""
        if self.shown_file:
            self.estimate.start(self.kept, self.loader.init_codes(self.stat), bool(self.vars.block_delete.get()),
                                Rates.of(self.stat))

    def state_on_disk(self):
        """What tells a change of the opened file, or None when it is gone."""
        try:
            found = os.stat(self.loaded_file)
        except (OSError, TypeError):
            return None
        return found.st_size, found.st_mtime_ns, found.st_ctime_ns, found.st_ino

    def same_text(self, now):
        """Whether the file, that has another state `now`, holds the text that was opened; None: that is still being
        found out."""
        if now is None or now[0] != self.loaded_text[0]:
            return False
        if self.comparison is None or self.comparison[0] != now:
            path, found = self.loaded_file, []
            self.comparison = now, found
            if now[0] <= HASHED_AT_ONCE:
                found.append(program.text_hash(path))
            else:
                threading.Thread(target=lambda: found.append(program.text_hash(path)), daemon=True).start()
        return self.comparison[1][0] == self.loaded_text[1] if self.comparison[1] else None

    def shown_is_old(self):
        """The file was changed after it was opened: who opens it again gets another program. The operator is told."""
        self.look_at_file()
        try:
            old = self.changed_on_disk and self.shown_file == self.loaded_file and \
                not filecmp.cmp(self.kept, self.loaded_file, shallow=False)
        except OSError:                  # it is gone: task has it as it was
            old = False
        if old:
            text = self.translate("%s was changed after it was opened: open it again to run what it says now")
            self.notifications.add("error", text % os.path.basename(self.loaded_file))
        return old

    def look_at_file(self):
        """Tells once when the file on disk is no longer the program that is loaded."""
        if self.loaded_file is None or self.loading:
            return
        now = self.state_on_disk()
        if now == self.disk_state:
            return
        same = self.same_text(now)
        if same:                                 # a new time alone, or the change was taken back
            self.disk_state, self.changed_on_disk = now, False
        elif same is not None:
            self.disk_state, self.changed_on_disk = now, True
            what = self.translate("%s was changed on disk. The program as it was opened stays loaded; reload to "
                                  "take the new one.") if now else \
                self.translate("%s is gone from the disk. The program as it was opened stays loaded.")
            self.notifications.add("info", what % os.path.basename(self.loaded_file))

    def reload_file(self, refilter=True):
        """Opens the file again; highlighted line kept. refilter False: only the preview follows."""
        if not self.loaded_file or self.running() or self.loading:
            return
        line = self.vars.highlight_line.get()
        source = self.loaded_file
        if not refilter and not self.is_filtered and (self.changed_on_disk or self.state_on_disk() != self.disk_state):
            # the new text comes with a reload that was asked for; this one can not be run any more
            return
        if refilter or not self.is_filtered:
            if self.is_filtered:
                self.open_file_guts(source, addrecent=False)
            else:
                self.begin_progress()
                try:
                    if os.path.exists(source):
                        self.shown_file = self.loader.snapshot(source)
                    self.load_shown()
                finally:
                    self.end_progress()
                    self.root.tk.call("set_mode_from_tab")
        else:
            self.open_file_guts(source, filtered=True, addrecent=False)
        self.set_highlight_line(line)

    def line_text(self, line):
        return self.code.line_text(line)

    def show_title(self):
        screen = Tree.find().version(), self.settings.machine
        self.root.title(self.translate("%s - AXIS %s on %s") % (os.path.basename(self.loaded_file), *screen)
                        if self.loaded_file else self.translate("AXIS %s on %s (no file)") % screen)

    def set_highlight_line(self, line):
        line = int(line) if line and int(line) > 0 else -1
        self.code.mark("sel", line)
        if line > 0:
            self.code.see(line)
        if self.vars.highlight_line.get() != line:
            self.vars.highlight_line.set(line)
            self.preview.centre_on_line(line)
            self.preview.invalidate()

    def begin_progress(self):
        self.loading, self.cancel_loading = True, False
        self.bar = (self.root.nametowidget(".info.progress") if self.known(".info.progress")
                    else self.wrap(".info.progress"))
        self.position_packed = self.root.tk.eval("if {[winfo manager .info.position] ne {}} {pack info .info.position}")
        self.root.tk.call("pack", "forget", ".info.position")
        self.root.tk.call("pack", ".info.progress", "-side", "left", "-fill", "both", "-expand", 1)
        self.root.tk.call(".info.progress", "delete", "all")
        self.root.tk.call(".info.progress", "create", "rectangle", -10, -10, -10, -10, "-fill", "#2f6db5",
                          "-outline", "")
        self.root.configure(cursor="watch")
        self.root.update_idletasks()
        self.percent = 0.0

    def progress(self, percent):
        """How far it is; any thread."""
        self.percent = percent

    def beside(self, function, *args):
        """Waits in a thread for what takes long, while the screen goes on (FP-136). The function touches no widget."""
        outcome = {}

        def work():
            try:
                outcome["value"] = function(*args)
            except BaseException as error:
                outcome["error"] = error
        thread = threading.Thread(target=work, daemon=True)
        thread.start()
        shown = None
        while thread.is_alive():
            thread.join(BESIDE_S)
            if self.percent != shown:
                shown = self.percent
                width, height = (int(self.root.tk.call("winfo", w, ".info.progress")) for w in ("width", "height"))
                self.root.tk.call(".info.progress", "coords", 1, 0, 0, width * shown / 100, height)
            self.answer()
            if self.cancel_loading:
                self.loader.end()
            self.loader.look()
        if "error" in outcome:
            raise outcome["error"]
        return outcome["value"]

    def end_progress(self):
        self.loading = False
        self.root.tk.call("pack", "forget", ".info.progress")
        if self.position_packed:
            self.root.tk.eval(f"pack .info.position {self.position_packed}")
        self.root.configure(cursor="")

    def limit_warnings(self):
        self.stat.poll()
        return program.limit_warnings(self.limit_path, self.settings, self.stat, self.translate)

    def accept_limits(self):
        """True when the program may run: within the limits, or the operator says so."""
        _ = self.translate
        while True:
            if not self.find_limits():
                return False
            warnings, loads = self.limit_warnings(), self.loads
            if not warnings:
                return True
            answer = dialogs.ask(self.root, _("Program exceeds machine limits"), "\n".join(warnings), "warning", 1,
                                 _("Re-Check"), _("Run Anyway"), _("Cancel"), escape=2)
            if answer == 1 and loads == self.loads:
                return True
            if answer != 0 or loads != self.loads:           # the answer was for another program
                return False
            self.reload_file()

    def may_start(self):
        """The shown program can be run or stepped now, and the operator wants it."""
        def possible():
            return not self.loading and self.manual_ok() and not self.running() and not self.follow_opened()
        if not possible() or self.shown_is_old() or self.refused_while_homing():
            return False
        return self.accept_limits() and possible()           # much may happen meanwhile

    def run_from(self, line):
        if not self.loaded_file or not self.may_start():
            return
        if line > 0:
            self.start_at(line)
        elif self.ensure_mode(linuxcnc.MODE_AUTO):
            self.set_highlight_line(-1)
            self.code.ignore_before(0)
            self.command.auto(linuxcnc.AUTO_RUN, 0)

    def start_at(self, line):
        """A start in the middle: task tells what it would restore, the operator decides."""
        c, s, _, loads = self.command, self.stat, self.translate, self.loads
        if not self.ensure_mode(linuxcnc.MODE_AUTO):
            return
        c.restore(line)
        c.wait_complete()
        end = clock.now() + LONGEST_RESTORE_S
        self.loading, self.cancel_loading = True, False      # Escape ends the waiting, nothing else starts
        try:
            while True:
                s.poll()
                if s.restore_line > 0 or s.task_mode != linuxcnc.MODE_AUTO or s.task_state != linuxcnc.STATE_ON:
                    break
                if self.cancel_loading or s.state == linuxcnc.RCS_ERROR or clock.now() > end:
                    break
                self.answer()
                clock.sleep(0.02)
        finally:
            self.loading = False
        if s.restore_line <= 0:
            if self.cancel_loading:
                c.abort()
            return                   # task told the reason
        answer = dialogs.ask(self.root, _("Run from line %d") % s.restore_line,
                             _("Before the program goes on at line %d, this is done:") % s.restore_line,
                             "warning", 2, _("Restore and run"), _("Run without"), _("Cancel"),
                             extra=s.restore_text, escape=2)
        self.notifications.drop(lambda text: s.restore_text[:60] in text)       # the dialog told it
        restored = s.restore_line
        s.poll()
        if loads != self.loads:          # the answer was for another program
            c.abort()
            return
        if s.task_state != linuxcnc.STATE_ON or self.running():
            return
        if answer == 0 and s.restore_line == restored:
            self.set_highlight_line(-1)
            self.code.ignore_before(restored)
            c.restore_confirm(restored)
            return
        c.abort()                    # forgets what was shown
        c.wait_complete()
        if answer == 1 and self.ensure_mode(linuxcnc.MODE_AUTO):
            self.set_highlight_line(-1)
            self.code.ignore_before(line)
            c.auto(linuxcnc.AUTO_RUN, line)
