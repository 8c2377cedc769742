#!/usr/bin/python3
# The pins of axisui, messages by pins, tabs and panels of the INI file, files behind the screen.
import subprocess

from kerf import clock
import operator_lib as lib


def getp(pin):
    return clock.run(["halcmd", "getp", pin], stdout=subprocess.PIPE, text=True).stdout.strip()


def setp(pin, value):
    clock.run(["halcmd", "setp", pin, value], check=True)


def script(op):
    out = open("transcript", "w")
    app = op.app
    print(open("hooks.log").read(), end="", file=out)
    print("messages:", op.messages(), file=out)
    print("live updates:", int(getp("axisui.updates")) > 5, file=out)
    print("button text:", app.widgets.homebutton.cget("text"), file=out)
    pins = clock.run(["halcmd", "-s", "show", "pin", "axisui"], stdout=subprocess.PIPE, text=True).stdout
    for line in pins.splitlines():
        if line.strip():
            print(" ".join(line.split()[1:3]), line.split()[4], file=out)
    op.power_on()
    app.activate_ja_widget("z")
    app.vars.jogincrement.set("1mm"); app.increment_chosen()
    print("selected:", getp("axisui.jog.x"), getp("axisui.jog.z"), "increment", getp("axisui.jog.increment"), file=out)
    op.key("F5")
    op.type("G0 X")
    op.wait(1)
    print("error pin:", getp("axisui.error"), "messages:", len(op.messages()), file=out)
    setp("axisui.notifications-clear-error", "1")
    op.wait(0.2)
    print("cleared errors:", op.messages(), getp("axisui.error"), file=out)
    op.key("space", state=4)
    print("cleared all:", op.messages(), file=out)
    print("behind the screen:", getp("behind.in"), getp("behind2.in"), file=out)
    print("tabs:", app.root.tk.call(".pane.top.right", "pages"), file=out)
    for _ in range(15):
        app.notifications.add("error", "again")
    print("most messages:", len(op.messages()), file=out)
    print("remote:", app.root.tk.call("remote", "send_mdi_command", "G4 P0"), file=out)
    print("preferences:", app.prefs.getpref("show_tool"), sorted(app.prefs.values.defaults()), file=out)


lib.run(script)
