# buttons that jog, and a right-click menu
def start(a, sign):
    def go(event):
        jog_on(a, sign * get_jog_speed(a))
    return go
def stop(a):
    return lambda event: jog_off(a)
pad = Tkinter.Frame(widgets.axes.master, name="pad")
for a, sign, text in ((0, -1, "X-"), (0, 1, "X+"), (1, -1, "Y-"), (1, 1, "Y+")):
    b = Tkinter.Button(pad, text=text, name=text.lower())
    b.bind("<ButtonPress-1>", start(a, sign))
    b.bind("<ButtonRelease-1>", stop(a))
    b.pack(side="left")
pad.grid(row=20, column=0, columnspan=2)
widgets.mdi_command.bind("<Button-3>", rClicker, add="")
activate_ja_widget(1, True)
root_window.bind("<Control-Key-j>", lambda event: activate_ja_widget(0))
jog_invert = "Y"
jog_order = "YXZ"
