# a page beside the preview, made in Tcl
root_window.tk.eval("""
    set page [dynamic_tab notes "Notes"]
    text $page.t -height 3 -width 10
    pack $page.t -fill both -expand 1
    $page.t insert end [join [inifindall HAL HALFILE] " "]
    proc say_units {} { global metric; return [expr {$metric ? "mm" : "inch"}] }
    trace add variable ::task_state write {apply {{args} { set ::seen_state $::task_state }}}
    bind . <Key-F6> {next_tab}
""")
units = root_window.tk.call("say_units")
frame = root_window.nametowidget(tabs_preview) if False else tabs_preview
root_window.tk.call("frame", frame + ".corner", "-width", 20, "-height", 20, "-background", "red")
root_window.tk.call("place", frame + ".corner", "-x", 2, "-y", 2)
