// SPDX-License-Identifier: GPL-2.0-or-later
component sim_matrix_kb "Simulated matrix keyboard";
pin out unsigned out "Code of the last change: 0xC0 + key pressed, 0x80 + key released, 0x40 while keys
are held, 0 without keys.";
pin in bit button.c00.r##[8] "Keys of column 0.";
pin in bit button.c01.r##[8] "Keys of column 1.";
pin in bit button.c02.r##[8] "Keys of column 2.";
pin in bit button.c03.r##[8] "Keys of column 3.";
pin in bit button.c04.r##[8] "Keys of column 4.";
pin in bit button.c05.r##[8] "Keys of column 5.";
pin in bit button.c06.r##[8] "Keys of column 6.";
pin in bit button.c07.r##[8] "Keys of column 7.";
variable char was[64];
function _ "Scans the keys and reports one change.";
option period no;
description """
Produces the codes that a matrix keyboard would send, from 64 pins: row R, column C is key 8 * R + C. One
change is reported in a cycle, and printed.
""";
see_also "matrix_kb(9)";
license "GPL";
author "Kerf developers";
;;
FUNCTION(_) {
    int row, column, held = 0;
    for(row = 0; row < 8; row++) {
        int keys[8] = {
            button_c00_r(row), button_c01_r(row), button_c02_r(row), button_c03_r(row),
            button_c04_r(row), button_c05_r(row), button_c06_r(row), button_c07_r(row),
        };
        for(column = 0; column < 8; column++) {
            int code = 8 * row + column, down = keys[column] != 0;
            if(down != was[code]) {
                was[code] = down;
                rtapi_print("row: %d column: %d code: %d\n", row, column, code);
                out = code | (down ? 0xC0 : 0x80);
                return;
            }
            held |= down;
        }
    }
    out = held ? 0x40 : 0;
}
