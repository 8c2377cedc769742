# a lamp that follows the spindle, a warning after a while
import time
began = time.time()
warned = 0
box = Tkinter.Frame(root_window)
lamp = Tkinter.Label(root_window, name="lamp", text="", background="grey")
lamp.place(in_=widgets.preview_frame, relx=1.0, rely=0.0, anchor="ne")
def user_live_update():
    global warned
    s.poll()
    lamp.configure(text="%d rpm" % s.spindle[0]["speed"], background="green" if s.spindle[0]["enabled"] else "grey")
    if s.spindle[0]["speed"] > 400 and not warned:
        warned = 1
        notifications.add("info", "spindle above 400")
    vars.jog_speed.get(), vars.metric.get(), vars.task_state.get(), vars.ja_rbutton.get(), loaded_file, current_tool
