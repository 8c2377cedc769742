# pins of one's own, a pulse for a light
comp.newpin("light", hal.HAL_BIT, hal.HAL_OUT)
def user_hal_pins():
    comp.newpin("door-open", hal.HAL_BIT, hal.HAL_IN)
    comp.newpin("parts", hal.HAL_S32, hal.HAL_OUT)
    comp.ready()
parts = 0
was_running = False
def user_live_update():
    global parts, was_running
    now = running()
    if was_running and not now:
        parts += 1
        comp["parts"] = parts
    was_running = now
    comp["light"] = now
    if comp["door-open"] and now:
        commands.task_pause()
