# SPDX-License-Identifier: GPL-2.0-or-later
"""O words. FP-103: a sub defined inside another is an error with file and line, and a sub file with
% lines may be called from a program with % lines."""
from harness import *


def prints(text, **more):
    run = rs274(text, **more)
    return [p.replace(".000000", "") for p in run.printed] + ([run.error] if run.error else [])


check(prints("#3=7\no1 sub\n(print,#1 #2 #3)\n#1=9\no1 endsub\no1 call [5]\n(print,#1 #3)\nM2\n") == ["5 0 0", "0 7"],
      "arguments")
check(prints("o<f> sub\no1 if [#1 LE 1]\no<f> return [1]\no1 endif\no<f> call [#1-1]\no<f> endsub [#1*#<_value>]\n"
             "o<f> call [6]\n(print,#<_value> #<_value_returned>)\nM2\n") == ["720 1"], "recursion")
check(prints("o1 sub\n(print,#<_call_level>)\no1 call\no1 endsub\no1 call\nM2\n")[-1] == "Too many subroutine levels",
      "levels")
check(prints("#1=0\no1 while [#1 LT 3]\n(print,#1)\n#1=[#1+1]\no1 endwhile\n(print,end)\nM2\n") == ["0", "1", "2", "end"], "while")
check(prints("#1=0\no1 do\n#1=[#1+1]\n(print,#1)\no1 while [#1 LT 3]\nM2\n") == ["1", "2", "3"], "do")
check(prints("o1 repeat [2.5]\no2 repeat [2]\n(print,x)\no2 endrepeat\no1 endrepeat\nM2\n") == ["x"] * 4,
      "repeat in repeat")
check(prints("o1 repeat [0]\n(print,x)\no1 endrepeat\nM2\n") == [], "no turns")
loop = "#1=0\no1 while [#1 LT 5]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 EQ 4]\no1 break\no3 endif\n(print,#1)\no1 endwhile\n"
check(prints(loop + "(print,end)\nM2\n") == ["1", "3", "end"], "break and continue")
check(prints(loop + "o8 do\n#9=[#9+1]\n(print,do)\no8 while [#9 LT 2]\nM2\n") == ["1", "3", "do", "do"],
      "a break leaves no trace")
check(prints("#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 1]\no1 continue\no2 endif\n(print,#1)\no1 while [#1 LT 3]\n"
             "o4 repeat [2]\n(print,r)\no4 endrepeat\nM2\n") == ["2", "3", "r", "r"], "a continue leaves no trace")
for value, want in ((1, "a"), (2, "b"), (3, "c")):
    check(prints(f"#1={value}\no1 if [#1 EQ 1]\n(print,a)\no1 elseif [#1 EQ 2]\n(print,b)\no1 "
                 "else\n(print,c)\no1 endif\nM2\n") == [want], "if")
check(prints("o1 if [0]\ngarbage!\no1 endif\n(print,on)\nM2\n") == ["on"], "skipped lines are not read")
check(prints("m98 p200 l2\n(print,back)\nM2\no200\n(print,in)\nm99\n") == ["in", "in", "back"], "M98")
check(prints("o1 sub\no1 endsub\nm98 p1\nM2\n")[-1] == "'O.... sub' subroutine must be called with 'O.... call'",
      "M98 to a sub")
check(prints("G0 X1\nM99\n") == [], "M99 in main ends the program")
check(prints("o<a/b> call\nM2\n", files={"a/b.ngc": "o<b> sub\n(print,file)\no<b> endsub\n"}) == ["file"],
      "sub in a folder")
check(prints("o<s> call [3]\n(print,#<_value>)\nM2\n",
             files={"s.ngc": "o<s> sub\n#<v>=#1\no<s> return [#<v>+1]\no<s> endsub\n"}) == ["4"], "sub file")
check(prints("o<late> call\nM2\no<late> sub\n(print,late)\no<late> endsub\n") == ["late"], "sub behind its call")
ini = "[EMC]\nVERSION=1.1\n[TRAJ]\nLINEAR_UNITS=mm\n[RS274NGC]\nSUBROUTINE_PATH=x:lib\nOWORD_NARGS=1\n"
check(prints("o<s> call [1] [2]\nM2\n", ini=ini,
             files={"lib/s.ngc": "o<s> sub\n(print,#<n_args>)\no<s> endsub\n"}) == ["2"], "SUBROUTINE_PATH")
check(prints("o<nowhere> call\nM2\n")[-1].startswith("EOF in file:t.ngc seeking o-word: o<nowhere> from line: 1"),
      "not found")
for text, want in {
    "o1 endif": "1: undefined O-word label: 'o1 endif'", "o1 if 1": "Left bracket missing after 'if'",
    "o1 foo": "Unknown control command in o word", "o1 while [0] x": "Unexpected character after O-word",
    "o1 return": "1: not in a subroutine definition: 'o1 return'",
    "o1 endsub": "Not in subroutine definition", "o[1/0] if [1]": "Attempt to divide by zero",
    "o1 do\no1 endwhile": "2: no matching label: 'o1 endwhile' (found 'do' in line 1)",
    "o1 sub\no1 endsub\no1 sub": "File:t.ngc line:3 redefining sub: o|1| already defined in file:t.ngc",
    "o1 if [1]\no1 endif\no1 if [1]": "3: duplicate O-word label - already defined in line 1: 'o1 if [1]'",
    "o1 call" + " [1]" * 31: "Too many subroutine parameters", "G0 m98 p1": "Unknown m code used: M98",
    "m098 p1": "Bad character '8' used", }.items():
    got = rs274(text + "\nM2\n").error
    check(got == want or (text[:3] in ("G0 ", "m09") and got), f"{text!r}: {got!r}, not {want!r}")

check(rs274("o1 repeat [0]\no1 break\no1 endrepeat\nM2\n").error == "2: no matching while/do label: 'o1 break' (found "
                                                                    "'repeat' in line 1)", "break of a repeat")
check(prints("o1 while [0]\no1 break\no1 continue\no1 endwhile\n#1=0\no2 do\n#1=[#1+1]\no2 while [#1 LT 2]\n"
             "(print,#1)\nM2\n") == ["2"], "a loop that is skipped")

# FP-103
run = rs274("o<outer> sub\no100 sub\no100 endsub\no<outer> endsub\nM2\n")
check(run.error == "Nested subroutine definition" and "o100 sub" in run.err, f"FP-103: {run.err}")
run = rs274("o<f> call [1]\nM2\n", files={"f.ngc": "o<f> sub\no7 sub\no7 endsub\no<f> endsub\n"})
check(run.error == "Nested subroutine definition: 'O7 sub' found inside called subroutine 'Of'", run.error)
check(prints("%\no<p> call\n(print,back)\n%\n", files={"p.ngc": "%\no<p> sub\n(print,in)\no<p> endsub\n%\n"}) == ["in", "back"], "FP-103: percent files")
mark = "\ufeff"      # editors for Windows begin a text with it
check(prints(mark + "%\no<s> call [3]\n(print,#<_value>)\n%\n",
             files={"s.ngc": mark + "o<s> sub\no<s> return [#1+1]\no<s> endsub\n"}) == ["4"], "byte order mark")
check(prints(mark) == prints(""), "nothing but a byte order mark")
check("Bad character" in prints("G0 X1\n" + mark + "G0 X2\nM2\n")[-1], "a byte order mark in the middle")
done()
