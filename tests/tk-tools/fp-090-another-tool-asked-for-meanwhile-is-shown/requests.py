import hal
from kerf import tkstyle
from kerf.tktools.hal_manualtoolchange import Exchange, Window, make_component
from tk_hand import Hand

pins = make_component()
root = tkstyle.open_display("hal_manualtoolchange", "AxisToolChanger")
window = Window(root, Exchange(pins, sleep=lambda seconds: hal.set_p("hal_manualtoolchange.change", "0")))
hand = Hand(root)


def request(number, change=1):
    hal.set_p("hal_manualtoolchange.number", str(number))
    hal.set_p("hal_manualtoolchange.change", str(change))


def shown():
    root.update()
    return window.dialog and window.text.cget("text").split("\n")[0]


request(1)
window.tick()
print(shown())
request(2)                              # withdrawn and made again since the last look
hand.click(window.button)
print("the old question confirms nothing:", pins["change"], pins["changed"])
window.tick()
print(shown())
hand.click(window.button)
print("confirmed:", pins["change"], pins["changed"], shown())
for number in range(3, 23):
    request(number)
    window.tick()
    assert f"tool {number} " in shown(), shown()
    hand.key("Return")
    assert not pins["change"] and not shown(), number
    window.tick()
request(0)
window.tick()
print(shown())
request(0, change=0)
window.tick()
print("withdrawn:", shown(), pins["changed"])
