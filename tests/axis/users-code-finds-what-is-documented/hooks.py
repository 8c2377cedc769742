# what a user's file does: names, widgets by path, an own command, an own pin, a live update
missing = [n for n in '''root_window widgets vars commands TclCommands inifile s c e o t comp hal linuxcnc live_plotter
  notifications ap help1 help2 trajcoordinates num_joints lathe foam jog_order jog_invert loaded_file current_tool set_feedrate
  set_rapidrate get_jog_speed jog_on jog_off running manual_ok ensure_mode prompt_float all_homed go_home set_motion_teleop
  activate_ja_widget open_file_guts reload_file rClicker user_live_update user_hal_pins tabs_mdi tabs_manual tabs_preview
  tabs_numbers pane_top pane_bottom'''.split() if n not in globals()]
log = open("hooks.log", "w", buffering=1)
print("missing names:", missing, file=log)
names = '''help_window about_window text preview_frame numbers_text tabs right mdi_history mdi_command code_text axes axis_x axis_w jogincr
  override ajogspeed coolant flood mist brake spindlel spindlef spindle_ccw spindle_stop spindle_cw spindle_minus spindle_plus view_z
  view_z2 view_x view_y view_y2 view_p rotate feedoverride rapidoverride spinoverride spinoverridef menu_view menu_grid menu_file
  menu_machine menu_touchoff homebutton homemenu unhomemenu joints joint_0 joint_15'''.split()
print("missing widgets:", [n for n in names if not hasattr(widgets, n)], file=log)
tcl = '''next_tab redraw_soon redraw_dro to_internal_linear_unit from_internal_linear_unit toggle_tto_g11 toggle_optional_stop
  toggle_block_delete gcode_properties launch_website set_spindlerate set_feedrate set_rapidrate set_maxvel copy_line task_run_line
  reload_tool_table program_verify zoomin zoomout set_view_x set_view_y set_view_y2 set_view_z set_view_z2 set_view_p estop_clicked
  onoff_clicked open_file remote open_file_name reload_file edit_program edit_tooltable task_run task_step task_pause
  task_reverse task_forward task_resume task_pauseresume task_stop mdi_up_cmd mdi_down_cmd send_mdi send_mdi_command
  mdi_history_write_to_file mdi_history_hist2clip mdi_history_clip2hist mdi_history_double_butt_1 mdi_history_butt_1
  clear_mdi_history ensure_manual ensure_mdi redraw toggle_show_rapids toggle_show_program toggle_program_alpha
  toggle_show_live_plot toggle_show_tool toggle_show_extents toggle_show_offsets set_grid_size set_grid_size_custom
  toggle_show_machine_limits toggle_show_machine_speed toggle_show_distance_to_go toggle_dro_large_font clear_live_plot
  toggle_show_pyvcppanel jog_plus jog_minus jog_stop home_all_joints unhome_all_joints home_joint home_joint_number
  unhome_joint_number clear_offset touch_off_system touch_off_tool set_axis_offset brake flood mist spindle spindle_increase
  spindle_decrease spindle_constant set_first_line mist_toggle flood_toggle spindle_forward_toggle spindle_backward_toggle
  brake_on brake_off toggle_display_type toggle_teleop_mode toggle_coord_type toggle_override_limits cycle_view axis_activated
  set_teleop_mode save_gcode goto_sensible_line dynamic_tab inifindall clear_recent_files setup_widget_accel setup_menu_accel
  load_image pause_image_normal pause_image_override state relief update_state set_mode_from_tab is_continuous setval val2vel
  update_recent _'''.split()
print("missing commands:", [n for n in tcl if not root_window.tk.call("info", "commands", n)], file=log)
paths = '''.menu .menu.file .menu.file.recent .menu.machine .menu.machine.home .menu.machine.unhome .menu.machine.touchoff
  .menu.machine.clearoffset .menu.view .menu.view.grid .menu.help .toolbar .toolbar.machine_estop .toolbar.machine_power
  .toolbar.file_open .toolbar.reload .toolbar.program_run .toolbar.program_step .toolbar.program_pause .toolbar.program_stop
  .toolbar.program_blockdelete .toolbar.program_optpause .toolbar.view_zoomin .toolbar.rotate .toolbar.clear_plot .toolbar.rule16
  .toolbar.rule0 .toolbar.rule4 .toolbar.rule8 .toolbar.rule9 .toolbar.rule12 .pane .pane.top .pane.bottom .pane.top.tabs
  .pane.top.right .pane.top.tabs.fmanual.axis .pane.top.tabs.fmanual.axes.axisx .pane.top.tabs.fmanual.joints.joint3
  .pane.top.tabs.fmanual.jogf.jog.jogminus .pane.top.tabs.fmanual.jogf.zerohome.tooltouch .pane.top.tabs.fmanual.space1
  .pane.top.tabs.fmanual.spindlef.row2 .pane.top.tabs.fmanual.space2 .pane.top.tabs.fmdi.historyl .pane.top.tabs.fmdi.history.sby
  .pane.top.tabs.fmdi.vs1 .pane.top.tabs.fmdi.commandl .pane.top.tabs.fmdi.go .pane.top.tabs.fmdi.vs2 .pane.top.feedoverride.l
  .pane.top.rapidoverride.foscale .pane.top.spinoverride.foentry .pane.top.spinoverride.m .pane.top.jogspeed.l0
  .pane.top.ajogspeed.l1 .pane.top.maxvel.s .pane.top.gcodel .pane.top.gcodes .pane.bottom.t.text .pane.bottom.t.sb .info
  .info.task_state .info.tool .info.position .info.progress .about .keys'''.split()
print("missing paths:", [p for p in paths if not int(root_window.tk.call("winfo", "exists", p))], file=log)

def shout(*words):
    return "-".join(words)
TclCommands.shout = shout
commands = TclCommands(root_window)
print("own command:", root_window.tk.call("shout", "a", "b"), file=log)
widgets.homebutton.configure(text="Reference")
updates = 0
def user_live_update():
    global updates
    updates += 1
    comp["updates"] = updates
def user_hal_pins():
    comp.newpin("updates", hal.HAL_S32, hal.HAL_OUT)
    comp.ready()
o.user_plot = lambda: log.write("plotted\n") if not getattr(o, "told", False) and not setattr(o, "told", True) else None
notifications.add("info", "from the user's file")
