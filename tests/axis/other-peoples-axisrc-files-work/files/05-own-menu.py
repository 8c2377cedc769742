# a menu of macros
macros = Tkinter.Menu(root_window.tk.call("winfo", "children", ".") and root_window, name="macros", tearoff=0)
def macro(text):
    def run(*ignored):
        if all_homed() and manual_ok() and not running():
            ensure_mode(linuxcnc.MODE_MDI)
            c.mdi(text)
    return run
for label, text in (("Park", "G53 G0 X-5 Y-5"), ("Probe", "G38.3 Z-1 F50")):
    macros.add_command(label=label, command=macro(text))
root_window.tk.call(".menu", "insert", "last", "cascade", "-label", "Macros", "-menu", macros)
widgets.menu_machine.add_separator()
widgets.menu_machine.add_command(label="Park", command=macro("G53 G0 X-5 Y-5"))
widgets.menu_file.insert_command(2, label="Reload now", command="reload_file")
