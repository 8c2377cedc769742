# The pendant and all that it asks for; as its manual page has it, but for the signals' names.
loadusr -W xhc-whb04b-6 -HsfB
foreach {l j} {x 0 y 1 z 2 c 3} {
    foreach pin {counts enable scale vel-mode} {
        net pendant-$pin-$l whb.axis.$l.jog-$pin axis.$l.jog-$pin joint.$j.jog-$pin
    }
    net pendant-select-$l whb.halui.axis.$l.select halui.axis.$l.select
    foreach pin {pos-feedback pos-relative} {
        net pendant-$pin-$l halui.axis.$l.$pin whb.halui.axis.$l.$pin
    }
    net pendant-homed-$l halui.joint.$j.is-homed whb.halui.joint.$l.is-homed
}
foreach pin {on off} {
    net pendant-machine-$pin whb.halui.machine.$pin halui.machine.$pin
}
net pendant-machine-is-on halui.machine.is-on whb.halui.machine.is-on
foreach mode {auto joint manual mdi teleop} {
    net pendant-$mode whb.halui.mode.$mode halui.mode.$mode
    net pendant-is-$mode halui.mode.is-$mode whb.halui.mode.is-$mode
}
foreach pin {run pause resume stop} {
    net pendant-$pin whb.halui.program.$pin halui.program.$pin
}
foreach pin {is-idle is-paused is-running} {
    net pendant-$pin halui.program.$pin whb.halui.program.$pin
}
foreach {ours theirs} {feed-override feed-override spindle-override spindle.0.override} {
    foreach pin {increase decrease scale} {
        net pendant-$ours-$pin whb.halui.$ours.$pin halui.$theirs.$pin
    }
    net pendant-$ours-value halui.$theirs.value whb.halui.$ours.value
}
net pendant-max-velocity halui.max-velocity.value whb.halui.max-velocity.value
foreach pin {start stop forward reverse increase decrease} {
    net pendant-spindle-$pin whb.halui.spindle.$pin halui.spindle.0.$pin
}
net pendant-spindle-is-on halui.spindle.0.is-on whb.halui.spindle.is-on
net pendant-home whb.button.m-home halui.home-all
