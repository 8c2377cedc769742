// SPDX-License-Identifier: GPL-2.0-or-later
component sim_parport "Simulated parallel port with the pins of hal_parport";
pin in bit pin-01-out "Output pin 01, as the machine writes it.";
pin out bit pin-01-out-fake "Level at the connector: the output, inverted with *pin-01-out-invert*.";
pin in bit pin-02-out "Output pin 02, as the machine writes it.";
pin out bit pin-02-out-fake "Level at the connector: the output, inverted with *pin-02-out-invert*.";
pin in bit pin-03-out "Output pin 03, as the machine writes it.";
pin out bit pin-03-out-fake "Level at the connector: the output, inverted with *pin-03-out-invert*.";
pin in bit pin-04-out "Output pin 04, as the machine writes it.";
pin out bit pin-04-out-fake "Level at the connector: the output, inverted with *pin-04-out-invert*.";
pin in bit pin-05-out "Output pin 05, as the machine writes it.";
pin out bit pin-05-out-fake "Level at the connector: the output, inverted with *pin-05-out-invert*.";
pin in bit pin-06-out "Output pin 06, as the machine writes it.";
pin out bit pin-06-out-fake "Level at the connector: the output, inverted with *pin-06-out-invert*.";
pin in bit pin-07-out "Output pin 07, as the machine writes it.";
pin out bit pin-07-out-fake "Level at the connector: the output, inverted with *pin-07-out-invert*.";
pin in bit pin-08-out "Output pin 08, as the machine writes it.";
pin out bit pin-08-out-fake "Level at the connector: the output, inverted with *pin-08-out-invert*.";
pin in bit pin-09-out "Output pin 09, as the machine writes it.";
pin out bit pin-09-out-fake "Level at the connector: the output, inverted with *pin-09-out-invert*.";
pin in bit pin-14-out "Output pin 14, as the machine writes it.";
pin out bit pin-14-out-fake "Level at the connector: the output, inverted with *pin-14-out-invert*.";
pin in bit pin-16-out "Output pin 16, as the machine writes it.";
pin out bit pin-16-out-fake "Level at the connector: the output, inverted with *pin-16-out-invert*.";
pin in bit pin-17-out "Output pin 17, as the machine writes it.";
pin out bit pin-17-out-fake "Level at the connector: the output, inverted with *pin-17-out-invert*.";
pin out bit pin-02-in "Input pin 02, as the machine reads it.";
pin out bit pin-02-in-not "Inverse of *pin-02-in*.";
pin in bit pin-02-in-fake "Level at the connector.";
pin out bit pin-03-in "Input pin 03, as the machine reads it.";
pin out bit pin-03-in-not "Inverse of *pin-03-in*.";
pin in bit pin-03-in-fake "Level at the connector.";
pin out bit pin-04-in "Input pin 04, as the machine reads it.";
pin out bit pin-04-in-not "Inverse of *pin-04-in*.";
pin in bit pin-04-in-fake "Level at the connector.";
pin out bit pin-05-in "Input pin 05, as the machine reads it.";
pin out bit pin-05-in-not "Inverse of *pin-05-in*.";
pin in bit pin-05-in-fake "Level at the connector.";
pin out bit pin-06-in "Input pin 06, as the machine reads it.";
pin out bit pin-06-in-not "Inverse of *pin-06-in*.";
pin in bit pin-06-in-fake "Level at the connector.";
pin out bit pin-07-in "Input pin 07, as the machine reads it.";
pin out bit pin-07-in-not "Inverse of *pin-07-in*.";
pin in bit pin-07-in-fake "Level at the connector.";
pin out bit pin-08-in "Input pin 08, as the machine reads it.";
pin out bit pin-08-in-not "Inverse of *pin-08-in*.";
pin in bit pin-08-in-fake "Level at the connector.";
pin out bit pin-09-in "Input pin 09, as the machine reads it.";
pin out bit pin-09-in-not "Inverse of *pin-09-in*.";
pin in bit pin-09-in-fake "Level at the connector.";
pin out bit pin-10-in "Input pin 10, as the machine reads it.";
pin out bit pin-10-in-not "Inverse of *pin-10-in*.";
pin in bit pin-10-in-fake "Level at the connector.";
pin out bit pin-11-in "Input pin 11, as the machine reads it.";
pin out bit pin-11-in-not "Inverse of *pin-11-in*.";
pin in bit pin-11-in-fake "Level at the connector.";
pin out bit pin-12-in "Input pin 12, as the machine reads it.";
pin out bit pin-12-in-not "Inverse of *pin-12-in*.";
pin in bit pin-12-in-fake "Level at the connector.";
pin out bit pin-13-in "Input pin 13, as the machine reads it.";
pin out bit pin-13-in-not "Inverse of *pin-13-in*.";
pin in bit pin-13-in-fake "Level at the connector.";
pin out bit pin-15-in "Input pin 15, as the machine reads it.";
pin out bit pin-15-in-not "Inverse of *pin-15-in*.";
pin in bit pin-15-in-fake "Level at the connector.";
param rw bit pin-01-out-invert "Inverts output pin 01.";
param rw bit pin-01-out-reset "Without effect; as on a real port.";
param rw bit pin-02-out-invert "Inverts output pin 02.";
param rw bit pin-02-out-reset "Without effect; as on a real port.";
param rw bit pin-03-out-invert "Inverts output pin 03.";
param rw bit pin-03-out-reset "Without effect; as on a real port.";
param rw bit pin-04-out-invert "Inverts output pin 04.";
param rw bit pin-04-out-reset "Without effect; as on a real port.";
param rw bit pin-05-out-invert "Inverts output pin 05.";
param rw bit pin-05-out-reset "Without effect; as on a real port.";
param rw bit pin-06-out-invert "Inverts output pin 06.";
param rw bit pin-06-out-reset "Without effect; as on a real port.";
param rw bit pin-07-out-invert "Inverts output pin 07.";
param rw bit pin-07-out-reset "Without effect; as on a real port.";
param rw bit pin-08-out-invert "Inverts output pin 08.";
param rw bit pin-08-out-reset "Without effect; as on a real port.";
param rw bit pin-09-out-invert "Inverts output pin 09.";
param rw bit pin-09-out-reset "Without effect; as on a real port.";
param rw bit pin-14-out-invert "Inverts output pin 14.";
param rw bit pin-14-out-reset "Without effect; as on a real port.";
param rw bit pin-16-out-invert "Inverts output pin 16.";
param rw bit pin-16-out-reset "Without effect; as on a real port.";
param rw bit pin-17-out-invert "Inverts output pin 17.";
param rw bit pin-17-out-reset "Without effect; as on a real port.";
pin in float reset-time "Without effect; as on a real port.";
function read "Copies the fake inputs.";
function write "Copies the outputs.";
function reset "Does nothing.";
option period no;
examples """
----
loadrt sim_parport names=parport.0
----
""";
license "GPL";
author "Kerf developers";
;;
#define INPUT(n) do { \
        pin_##n##_in = pin_##n##_in_fake; \
        pin_##n##_in_not = !pin_##n##_in_fake; \
    } while(0)
#define OUTPUT(n) pin_##n##_out_fake = pin_##n##_out != pin_##n##_out_invert

FUNCTION(read) {
    INPUT(02);
    INPUT(03);
    INPUT(04);
    INPUT(05);
    INPUT(06);
    INPUT(07);
    INPUT(08);
    INPUT(09);
    INPUT(10);
    INPUT(11);
    INPUT(12);
    INPUT(13);
    INPUT(15);
}

FUNCTION(write) {
    OUTPUT(01);
    OUTPUT(02);
    OUTPUT(03);
    OUTPUT(04);
    OUTPUT(05);
    OUTPUT(06);
    OUTPUT(07);
    OUTPUT(08);
    OUTPUT(09);
    OUTPUT(14);
    OUTPUT(16);
    OUTPUT(17);
}

FUNCTION(reset) {
}
