// The manual page of this component is compared with the expected one.
component kerf_test_page "Shows what a page looks like";
description """
Text with *bold*, _italic_ and `code`, a dash - and 'quotes'.
Marks with a backslash, \\*here* and \\_there_, are text; a line +
ends at a plus.
.A title
* first
* second

----
literal  block
.with a dot
----

Older components have \\fBtroff\\fR in them.
""";
pin in float in_ = 1.5 "Input with _emphasis_.";
pin out bit out-##[8 : personality] "Outputs.";
pin in float angle = M_PI_2 "Start by a name.";
pin io s32 undocumented if personality > 2;
param rw u32 setting = 0x10 "A setting.";
function _ "Does it.";
function named_one;
modparam int size = 4 "How big.";
option constructable;
examples "loadrt kerf_test_page size=5";
see_also "and2(9)";
notes "None.";
author "Somebody";
license "GPL";
;;
FUNCTION(_) { }
FUNCTION(named_one) { }
