set ::before 1
button .pane.nosuch.b -text "my button"
