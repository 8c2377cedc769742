// SPDX-License-Identifier: GPL-2.0-or-later
component arraysum "Sum and greatest of up to 8 floats";
/* Style of 2.8: block comments, fp, personality arrays, plain body. */
pin in float in-##[8:personality&0xf] "Inputs";
pin out float sum;
pin out float top "Greatest input";
param r signed n = 0 "Number of inputs";
option default_personality 3;
function _ fp;
author "A. User";
license "GPL"; // GPLv2 or greater
;;
int i;
double s = 0, m = 0;
n = personality & 0xf;
for(i = 0; i < n; i++) {
    s += in(i);
    if(i == 0 || in(i) > m) m = in(i);
}
sum = s;
top = m;
