# the file of somebody who made a mistake: what comes before it works
notifications.add("info", "before the mistake")
widgets.no_such_widget.configure(text="x")
notifications.add("info", "after the mistake")
