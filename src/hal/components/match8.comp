// SPDX-License-Identifier: GPL-2.0-or-later
component match8 "Compares two eight-bit values";
pin in bit in_ = TRUE "Enable: the output is FALSE while this is FALSE. Connect it to the *out* of
another match8 to compare wider values.";
pin in bit a0 "First value, bit 0.";
pin in bit a1 "First value, bit 1.";
pin in bit a2 "First value, bit 2.";
pin in bit a3 "First value, bit 3.";
pin in bit a4 "First value, bit 4.";
pin in bit a5 "First value, bit 5.";
pin in bit a6 "First value, bit 6.";
pin in bit a7 "First value, bit 7.";
pin in bit b0 "Second value, bit 0.";
pin in bit b1 "Second value, bit 1.";
pin in bit b2 "Second value, bit 2.";
pin in bit b3 "Second value, bit 3.";
pin in bit b4 "Second value, bit 4.";
pin in bit b5 "Second value, bit 5.";
pin in bit b6 "Second value, bit 6.";
pin in bit b7 "Second value, bit 7.";
pin out bit out "TRUE while *in* is TRUE and every bit of a equals that of b.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
;;
out = in_ && a0 == b0 && a1 == b1 && a2 == b2 && a3 == b3
          && a4 == b4 && a5 == b5 && a6 == b6 && a7 == b7;
