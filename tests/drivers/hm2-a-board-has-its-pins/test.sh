#!/bin/bash
# Everything that a board of known firmware shows in HAL, and whose each of its pins is; names and values are those
# that the peer (2.9) shows for the same simulated board, with what 2.10 added. Then with less of it by the config
# string.
list='show pin\nshow param\nshow funct'
printf "$list" | ../../lib/with-hm2-board -l | grep -vE 'gpio.0(0[1-9]|1[02-9]|2|3[02-9]|4|5)' |
    sed -E 's/^ *[0-9]+ +//' |
    grep -E '^(bit|s32|u32|float) |IO|hm2' | grep -vE '[.]time|tmax|packet-read|^[0-9a-f]+ '
echo "with less"
printf "$list" |
    ../../lib/with-hm2-board -l \
        -c 'num_encoders=1 num_stepgens=1 num_pwmgens=0 num_leds=9 stepgen_width=1 sserial_port_0=00xx' |
    grep -oE 'hm2_7i96s.0.(enc|step|pwm|led|raw)[a-z.0-9]*(scale|CR0.|dirsetup|value|invert.*)$|IO Pin 0[12].*|told.*'
