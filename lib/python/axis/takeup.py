# SPDX-License-Identifier: GPL-2.0-or-later
"""A screen that comes after one that crashed, while the machine goes on: what it shows and what it gives back to HAL.

It sets nothing of the machine: modes, overrides, options, the program. Pins of the dead one left HAL with their links;
the links come back, POSTGUI files do not run again. Signals of bits fell when the pins went and stay so; numbers stay,
and the widgets of panels begin with them.
"""

import os
import time

import hal
import hal.query
import linuxcnc

from .codeview import line_starts

KEEP_S = 2.0             # of wall time between two looks at what is to be kept
VARIABLES = ("metric", "coord_type", "display_type", "jog_slider_val", "ajog_slider_val", "jogincrement", "ja_rbutton",
             "touch_off_system", "rotate_mode", "show_pyvcppanel")


class TakeUpPart:
    """Part of App."""

    complete = False         # the screen has come up, POSTGUI files ran
    kept_at = 0.0            # time of the last look

    # -- of this screen, for the next one --------------------------------------------------

    def keep_record(self, at_once=False):
        if not self.complete or (not at_once and time.monotonic() < self.kept_at + KEEP_S):
            return
        self.kept_at = time.monotonic()
        links, values = {}, {}
        for name, pin in hal.query.pins().items() if self.comp is not None else ():
            if pin["comp"] not in self.own_components():
                continue
            name = pin["alias"] or name          # the next one makes it with the name it had
            if pin["signal"]:
                links[name] = pin["signal"]
            elif pin["dir"] == hal.HAL_IN and pin["value"] and pin["type"] != hal.HAL_PORT:
                values[name] = pin["value"]      # of setp
        was = self.former or {}
        self.record.save(links=links, values=values, parts=self.parts(), loaded=self.loaded, writers=self.writers,
                         folder=self.loader.folder,
                         program=was.get("program") if self.taking_up else self.program_kept(),
                         view=self.preview.camera.view,
                         variables={name: getattr(self.vars, name).get() for name in VARIABLES})

    def program_kept(self):
        if not self.loaded_file or self.loading:
            return (self.record.saved or {}).get("program")
        return {"loaded": self.loaded_file, "shown": self.shown_file, "kept": self.kept, "filtered": self.is_filtered,
                "disk": self.disk_state and list(self.disk_state), "text": self.loaded_text and list(self.loaded_text),
                "changed": self.changed_on_disk}

    # -- of the one before -----------------------------------------------------------------

    taking_up = False        # its program is not shown yet

    def former_folder(self):
        """Of its temporary files, where that is still there."""
        folder = (self.former or {}).get("folder")
        return folder if folder and os.path.isdir(folder) else None

    def tell_crashes(self, reports):
        _ = self.translate
        if self.former is not None:
            text = _("The screen was started again: the one before %s. The machine went on meanwhile; look at it "
                     "before you go on.") % self.record.crash
            self.notifications.add("error", text + (f"\n{_('Report:')} {reports.pop()}" if reports else ""))
        for report in reports:
            self.notifications.add("error", _("The screen ended unexpectedly the last time. Report: %s") % report)

    def kept_numbers(self):
        """Values of the signals that pins of panels were linked to, by pin."""
        numbers = {}
        for pin, signal in (self.former or {}).get("links", {}).items():
            found = hal.query.signal(signal)
            if found and found["type"] not in (hal.HAL_BIT, hal.HAL_PORT):
                numbers[pin] = found["value"]
        return numbers

    def take_up(self):
        """The rest of the start."""
        for name, value in self.former.get("variables", {}).items():
            getattr(self.vars, name).set(value)
        self.units_changed()
        self.slider("ajog", None)
        self.show_selected()
        self.show_panel()
        if self.former.get("view"):
            self.preview.set_view(self.former["view"])
        self.stat.poll()
        if self.stat.task_mode == linuxcnc.MODE_MDI:
            self.raise_tab("mdi")
        self.loaded = self.former.get("loaded", {})
        self.taking_up = bool(self.former.get("program"))
        self.update()
        self.poll_errors()
        self.wait_for_children(self.link_again)

    def link_again(self):
        failed = []
        if self.comp is not None:
            failed = [f"{pin} {value}"
                      for pin, value in self.former.get("values", {}).items()
                      if not self.tried(hal.set_p, pin, str(value))]
            failed += [f"{pin} {signal}"
                       for pin, signal in self.former.get("links", {}).items()
                       if not self.tried(lambda *a: not hal.connect(*a), pin, signal)]
        if failed:
            self.notifications.add("error", self.translate("Not connected again in HAL: %s") % ", ".join(failed))
        self.show()
        if self.taking_up:
            self.root.after(50, self.show_program_again)

    @staticmethod
    def tried(function, *arguments):
        try:
            return function(*arguments)
        except (RuntimeError, hal.error):
            return False

    def show_program_again(self):
        """The program that task has, as it was opened: nothing is opened anew."""
        was = self.former["program"]
        try:
            if not os.path.exists(was["kept"]) or not os.path.exists(was["shown"]):
                return
            self.begin_progress()
            try:
                self.loaded_file, self.shown_file, self.kept, self.is_filtered = was["loaded"], was["shown"], was["kept"], was["filtered"]
                self.disk_state, self.changed_on_disk = was["disk"] and tuple(was["disk"]), was["changed"]
                self.loaded_text = was["text"] and tuple(was["text"])
                self.loads += 1
                self.user["loaded_file"] = self.loaded_file
                self.code.load(self.kept, self.beside(line_starts, self.kept))
                self.read_preview(quiet=True)
                self.show_title()
            finally:
                self.end_progress()
        finally:
            self.taking_up = False
