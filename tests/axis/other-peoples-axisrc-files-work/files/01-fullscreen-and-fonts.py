# bigger letters, no border, DRO page first
import tkinter
root_window.attributes("-fullscreen", 0)
root_window.tk.call("wm", "geometry", ".", "1000x700")
t.configure(font=("Courier", 14), height=5)
widgets.code_text.configure(font="Courier 10")
widgets.numbers_text.configure(font=("Courier", 18, "bold"))
root_window.tk.call(".pane.top.right", "raise", "numbers")
widgets.feedoverride.configure(width=20)
widgets.homebutton.configure(background="orange", text="Reference")
root_window.option_add("*Button*Background", "white")
