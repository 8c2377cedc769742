# SPDX-License-Identifier: GPL-2.0-or-later
"""NGC handlers: words by argspec, order, recursion to the built-in, nesting, errors of the INI."""
from harness import *

INI = "[EMC]\nVERSION=1.1\n[TRAJ]\nLINEAR_UNITS=mm\n[RS274NGC]\nSUBROUTINE_PATH=subs\nOWORD_NARGS=1\n"
SUBS = {
    "subs/my.ngc": "o<my> sub\n(print,p=#<p> rl=#<_remap_level> cl=#<_call_level>)\no1 if [exists[#<q>]]\n"
                   "(print,q=#<q>)\no1 endif\nG1 X#<p>\no<my> endsub [3]\n",
    "subs/six.ngc": "o<six> sub\n(print,six)\nM6\nG0 Z0\no<six> endsub\n",
    "subs/tee.ngc": "o<tee> sub\n(print,tee #<t>)\nT#<t>\no<tee> endsub\n",
    "subs/cyc.ngc": "o<cyc> sub\n(print,cyc #1 #2 #<n_args>)\no<cyc> endsub\n",
    "subs/self.ngc": "o<self> sub\n(print,#<_remap_level>)\nM410\no<self> endsub\n",
    "subs/esss.ngc": "o<esss> sub\n(print,s=#<s>)\nS[#<s>*2]\no<esss> endsub\n",
    "subs/stop.ngc": "o<stop> sub\n(print,stop)\nM0\no<stop> endsub\n",
}


def run(program, *remaps):
    return rs274(program, ini=INI + "".join(f"REMAP={r}\n" for r in remaps), files=SUBS)


r = run("G21 F100\nN10 M400 P5 Q7 (first)\n#1=2\nM400 P[#1] G0 X9\nM2\n", "M400 modalgroup=10 argspec=Pq ngc=my")
check([p.replace(".000000", "") for p in r.printed] == ["p=5 rl=1 cl=1", "q=7", "p=2 rl=1 cl=1"], r.printed)
check([v[0] for _, v in r.moves()] == [5, 2, 9], "the rest of the block comes after the handler")
for p, error in ((0, "P value should be 1 or greater with G2 or G3"),
                 (1.5, "P value not an integer with M19 G2 or G3"), (2, "")):
    check(run(f"G0 X1 F1\nG3 X1 I-1 M400 P{p}\nM2\n", "M400 modalgroup=10 argspec=p ngc=six").error == error,
          f"turns of an arc beside a remapped code: {p}")
r = run("G91 T1 M6 G0 X1\nG0 X1\nM2\n", "M6 modalgroup=6 ngc=six", "T argspec=T ngc=tee")
names = [n for n, _ in r.calls if n in ("SELECT_TOOL", "CHANGE_TOOL", "STRAIGHT_TRAVERSE")]
check(r.printed == ["tee 1.000000", "six"] and names == ["SELECT_TOOL", "CHANGE_TOOL"] + ["STRAIGHT_TRAVERSE"] * 3,
      (r.printed, names))
check([v[0] for n, v in r.moves()] == [0, 1, 2], r.moves())
r = run("G88.1 X1.23456789 Y3\nM2\n", "G88.1 modalgroup=1 argspec=@XY ngc=cyc")
check(r.printed == ["cyc 1.234600 3.000000 2.000000"], r.printed)
check(run("M400\nM2\n", "M400 modalgroup=10 argspec=PQr ngc=my").error == "user-defined M400: missing: P,Q",
      "missing words")
check(run("M400 P1\nM2\n", "M400 modalgroup=10 argspec=P>^ ngc=my").error == "user-defined M400:F>0,S>0,",
      "feed and speed")
r = run("M410\nM2\n", "M410 modalgroup=10 ngc=self")
check(r.error == "maximum nesting of remapped blocks exceeded" and len(r.printed) == 9, r.printed)
r = run("S100\nM2\n", "S argspec=S ngc=esss")
check(r.printed == ["s=100.000000"] and [v for n, v in r.calls if n == "SET_SPINDLE_SPEED"] == [[0, 200]], r.out)
r = run("M0\nM2\n", "M0 modalgroup=4 ngc=stop")
check(r.printed == ["stop"] and sum(n == "PROGRAM_STOP" for n, _ in r.calls) == 1, r.out)
check(run("G1 X1 F1\nM2\n", "G1 modalgroup=1 ngc=cyc").printed == [],
      "a code with a meaning of its own is not taken over")
r = run("M2\n", "M401 modalgroup=10 ngc=nothere")
check(r.status == 1 and "INTERP_REMAP: NGC file not found: ngc=nothere" in r.err, r.err)
for line, want in (("M400 modalgroup=10", "no remap function given"),
                   ("M400 modalgroup=11 ngc=my", "invalid modalgroup=<int> given (currently valid: 4..10)"),
                   ("M400 modalgroup=10 argspec=O ngc=my", "argspec: illegal word 'O'"),
                   ("M400 modalgroup=10 ngc", "missing '=<value>"),
                   ("Mx modalgroup=10 ngc=my", "parsing M-code: expecting integer"),
                   ("Gx modalgroup=1 ngc=my", "can't parse G-code"),
                   ("T modalgroup=1 ngc=tee", "modal group setting ignored"),
                   ("TT ngc=tee", "only single letter code allowed"),
                   ("M400 modalgroup=10 ngc=my python=x", "can't remap to an ngc file and a Python function"),
                   ("M400 modalgroup=10 python=x", "Python plugin required for python=")):
    r = run("M2\n", line)
    check(want in r.err and r.status == 1, f"{line}: {r.err}")
check(run("M2\n", "M400 ngc=my").status == 0 and "using default group 10" in run("M2\n", "M400 ngc=my").err,
      "default group")
check(run("M2\n", "M400 modalgroup=10 ngc=my", "m400 modalgroup=10 ngc=my").status == 1, "twice")
done()
