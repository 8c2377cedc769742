# SPDX-License-Identifier: GPL-2.0-or-later
from harness import *

values = {
    "[-2**2]": 4, "[2**3**2]": 64, "[10-2-3 mod 2]": 7, "[-7 mod 3]": 2, "[7 mod -3]": 1, "[1 or 0 and 0]": 0,
    "--3": 3, "-+-3": 3, "[1 eq 1.0000005]": 1, "[1 ne 1.0000005]": 0, "[1 lt 1.0000005]": 1, "[1 ge 1.0000005]": 1,
    "round[-2.5]": -3, "round[2.5]": 3, "fix[-2.8]": -3, "fup[-2.8]": -2, "atan[-1]/[-1]": -135, "atan[1]/[0]": 90,
    "[1 xor 1]": 0, "[1 and 2]": 1, "sqrt[16]": 4, "exp[0]": 1, "ln[exp[2]]": 2, "abs[-3]": 3, "acos[0]": 90,
    "asin[1]": 90, "cos[60]": 0.5, "sin[-30]": -0.5, "tan[45]": 1, "[[1+2]*3-4/2]": 7, "[2*-3]": -6,
    "exists[#<nothing>]": 0, "exists[#<_x>]": 1, "exists[#5601]": 1, "exists[#5602]": 0, "[#5220+1]": 2,
    "+.5": .5, "0000012.500": 12.5, "[1.5 mod 1]": .5,
}
program = "".join(f"(print,#100)\n#100={e}\n" for e in values) + "(print,#100)\nM2\n"
got = [float(x) for x in rs274(program).printed][1:]
for (text, want), value in zip(values.items(), got):
    check(abs(value - want) < 1e-6, f"{text} is {value}, not {want}")
check(len(got) == len(values), got)

errors = {
    "X[1/0]": "Attempt to divide by zero", "X[": "No characters found in reading real value",
    "X[1": "Unclosed expression", "X[1&2]": "Unknown operation",
    "X[1 mood 2]": "Unknown operation name starting with m",
    "Xsinn[1]": "Left bracket missing after unary operation name",
    "Xcot[1]": "Unknown word starting with c", "Xq": "Unknown word where unary operation could be",
    "Xacos[2]": "Argument to acos out of range", "Xsqrt[-1]": "Negative argument to sqrt",
    "Xln[0]": "Zero or negative argument to ln", "X[[0-2]**.5]": "Attempt to raise negative to non integer power",
    "Xatan[1]": "Slash missing after first atan argument", "Xatan[1]/2": "Left bracket missing after slash with atan",
    "X1.2.3": "bad number format (trailing characters) parsing '1.2.3'",
    "X.": "bad number format (conversion failed) parsing '.'",
    "X#0": "Parameter number out of range", "X#5602": "Parameter number out of range",
    "X#1.5": "Non integer value for integer",
    "X#<a": "Named parameter not terminated", "X#<nope>": "Named parameter #<nope> not defined",
    "#5400=1": "Parameter is readonly",
    "#1 2": "Equal sign missing in parameter setting", "X[5 mod 0]": "Calculation resulted in 'not a number'",
    "Xexp[1000]": "Calculation resulted in 'infinity'", "X1-2": "Bad character '-' used",
    "#<_x>=1": "Cannot assign to read-only parameter #<_x>",
}
for text, want in errors.items():
    got = rs274(f"G0 {text}\nM2\n" if text[0] == "X" else text + "\nM2\n")
    check(got.error == want, f"{text}: {got.error!r}, not {want!r}")
    check(got.status == 1, text)
done()
