# functions of AXIS wrapped by one's own
door_closed = True
_manual_ok, _get_jog_speed, _jog_on, _jog_off, _open = manual_ok, get_jog_speed, jog_on, jog_off, open_file_guts
refused = []
def manual_ok():
    if not door_closed:
        refused.append("door")
        return False
    return _manual_ok()
def get_jog_speed(a):
    speed = _get_jog_speed(a)
    return min(speed, 5) if a == 2 else speed
jogs = []
def jog_on(a, b):
    jogs.append((a, b))
    _jog_on(a, b)
def jog_off(a):
    jogs.append(a)
    _jog_off(a)
def open_file_guts(f, filtered=False, addrecent=True):
    if "secret" in os.path.basename(f):
        notifications.add("error", "this program is not for this machine")
        return
    return _open(f, filtered, addrecent)
_prompt = prompt_touchoff
def prompt_touchoff(*args, **more):
    value, system = _prompt(*args, **more)
    return (None, None) if value is None else ("[%s]+1" % value, system)
