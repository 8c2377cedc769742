#!/bin/bash
# FP-146: hm2_modbus with a simulated device: values go and come in every kind of frame; each failure is counted, a
# device that does not answer is switched off after five and does not hold up the others, reset tries again, writes
# that were not answered are sent again. mesambccc makes the file, and names mistakes with their line.
trap 'rm -f device.mbccb wrong.mbccs' EXIT
mesambccc -v -o device.mbccb device.mbccs
od -A d -t x1 device.mbccb | head -10
../../lib/with-hm2-board -f uart <<END
stop
loadrt hm2_modbus ports=%.pktuart.0 mbccbs=$PWD/device.mbccb
addf hm2_modbus.0.process servo 2
show param hm2_modbus
show pin hm2_modbus.0.drive
setp hm2_modbus.0.drive.speed -12.4
setp hm2_modbus.0.drive.speed.scale 10
setp hm2_modbus.0.drive.ramp 0x00011000
setp hm2_modbus.0.drive.out-03 1
setp hm2_modbus.0.drive.out-09 1
start
wait 0.5
get hm2_modbus.0.drive.echo-00
get hm2_modbus.0.drive.ramp-back
get hm2_modbus.0.drive.first
get hm2_modbus.0.drive.second
get hm2_modbus.0.drive.in-03
get hm2_modbus.0.drive.in-04
get hm2_modbus.0.drive.in-09
say a device that is not there
get hm2_modbus.0.command.06.disabled
get hm2_modbus.0.command.06.errors
get hm2_modbus.0.command.06.error-code
get hm2_modbus.0.fault
get hm2_modbus.0.command.00.errors
say reset tries again
setp hm2_modbus.0.command.06.reset 1
wait 0.01
get hm2_modbus.0.command.06.disabled
wait 0.5
get hm2_modbus.0.command.06.errors
get hm2_modbus.0.command.06.disabled
say damaged and missing answers: counted, and the write goes again
poke 0xF400 2
poke 0xF404 1
setp hm2_modbus.0.drive.speed 3
wait 0.3
get hm2_modbus.0.drive.echo-00
get hm2_modbus.0.last-error-code
get hm2_modbus.0.command.00.disabled
say an exception of the device
setp hm2_modbus.0.command.07.disable 0
wait 0.2
get hm2_modbus.0.command.07.error-code
get hm2_modbus.0.command.07.disabled
say a value that has no place is kept in range
setp hm2_modbus.0.drive.speed 1e9
wait 0.1
get hm2_modbus.0.drive.echo-00
setp hm2_modbus.0.suspend 1
wait 0.05
peek 0xF024
wait 0.1
peek 0xF024
END
while read -r change; do
    sed "$change" device.mbccs > wrong.mbccs
    mesambccc -o wrong.mbccb wrong.mbccs 2>&1
done <<'END'
s/function="R_COILS"/function="R_COIL"/
s/address="7"/address="300"/
s/modbustype="U_CDAB"/modbustype="U_CDBA"/
s/name="second"/name="first"/
s/baudrate=/bitrate=/
s/device="gone"/device="lost"/
s/<\/commands>//
END
printf 'loadrt hostmot2\nloadrt hm2_modbus ports=hm2_7i96s.0.pktuart.0 mbccbs=x\n' > t.hal
halrun -f t.hal 2>&1 | grep '^hm2: no'
rm -f t.hal
