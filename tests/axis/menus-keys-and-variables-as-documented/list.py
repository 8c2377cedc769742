#!/usr/bin/python3
import sys

import operator_lib as lib

VARIABLES = """linuxcnctop_command emcini mdi_command taskfile interp_pause exec_state task_state task_paused interp_state task_mode has_ladder
has_editor ja_rbutton tto_g11 mist flood brake spindledir running_line highlight_line show_program program_alpha show_live_plot show_tool
show_extents show_offsets grid_size show_machine_limits show_machine_speed show_distance_to_go dro_large_font show_pyvcppanel show_rapids
feedrate rapidrate spindlerate tool active_codes metric coord_type display_type override_limits view_type jog_speed jog_aspeed max_speed
max_aspeed maxvel_speed max_maxvel teleop_mode motion_mode kinematics_type optional_stop block_delete rotate_mode touch_off_system machine
on_any_limit queued_mdi_commands max_queued_mdi_commands trajcoordinates""".split()
GLOBALS = """jogincrement jog_slider_val ajog_slider_val maxvel_slider_val task_state_string position _tabs_manual _tabs_mdi _tabs_preview _tabs_numbers
pane_top pane_bottom version MAX_JOINTS MAX_AXIS STATE_ESTOP STATE_ESTOP_RESET STATE_ON STATE_OFF TASK_MODE_MANUAL TASK_MODE_AUTO TASK_MODE_MDI
INTERP_IDLE INTERP_READING INTERP_PAUSED INTERP_WAITING TRAJ_MODE_FREE KINEMATICS_IDENTITY""".split()
NAMES = """root_window widgets vars commands TclCommands inifile s c e o t comp hal linuxcnc live_plotter notifications ap help1 help2 trajcoordinates
num_joints lathe foam jog_order jog_invert loaded_file current_tool set_feedrate set_rapidrate get_jog_speed jog_on jog_off running manual_ok
ensure_mode prompt_float prompt_touchoff all_homed go_home set_motion_teleop activate_ja_widget open_file_guts reload_file rClicker
user_live_update user_hal_pins tabs_mdi tabs_manual tabs_preview tabs_numbers pane_top pane_bottom nf_dialog""".split()


def entries(tcl, menu):
    out = []
    for i in range(int(tcl.call(menu, "index", "end")) + 1):
        kind = str(tcl.call(menu, "type", i))
        if kind == "separator":
            out.append("---")
        elif kind != "tearoff":
            label, accelerator = (str(tcl.call(menu, "entrycget", i, option)) for option in ("-label", "-accelerator"))
            mark = {"checkbutton": "[check] ", "radiobutton": "(radio) ", "cascade": "> "}.get(kind, "")
            out.append(mark + label + (f" ({accelerator})" if accelerator else ""))
    return " | ".join(out)


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, tcl = op.app, op.root.tk
    full = "mill" in app.settings.ini_path
    for name in ("file", "machine", "machine.home", "machine.unhome", "machine.clearoffset", "view",
                 "view.grid", "help"):
        if full or name in ("machine.home", "machine.unhome", "view"):
            print(f"{name}:", entries(tcl, ".menu." + name))
    print("tool bar:", *[w.split(".")[-1]
                         for w in map(str, tcl.splitlist(tcl.call("pack", "slaves", ".toolbar"))) if "rule" not in w])
    print("axes:", *[c for c in "xyzabcuvw" if tcl.call("winfo", "manager", f".pane.top.tabs.fmanual.axes.axis{c}")],
          "joints:", *[j for j in range(16) if tcl.call("winfo", "manager", f".pane.top.tabs.fmanual.joints.joint{j}")],
          "button:", app.widgets.homebutton.cget("text"), "angular slider:",
          bool(tcl.call("winfo", "manager", ".pane.top.ajogspeed")))
    print("view:", app.vars.view_type.get(), "jog order:", "".join(app.settings.jog_order()), "inverted:",
          app.jog_invert)
    if full:
        print("missing variables:",
              [n for n in VARIABLES if not hasattr(app.vars, n) or not int(tcl.eval(f"info exists ::{n}"))])
        print("missing globals:", [n for n in GLOBALS if not int(tcl.eval(f"info exists ::{n}"))])
        print("missing names:", [n for n in NAMES if n not in app.user])
        print("preferences:", dict(sorted(app.prefs.values.defaults().items())))
        op.root.tk.call("open_pipe", "printf 'G21\\nG1 X1 F100\\nM2\\n'")
        print("pipe:", app.preview.program.n_moves, "moves,", app.code.total, "lines")


lib.run(script)
