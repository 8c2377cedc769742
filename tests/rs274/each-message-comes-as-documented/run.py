# SPDX-License-Identifier: GPL-2.0-or-later
"""Every message of the language's documentation that a program can bring out, word for word."""
import concurrent.futures
from harness import *
import messages as m

TOOLS = open(HERE + "/golden.tbl").read() + "T7 P7 D2 Q3\n"


def problem(case):
    program, want, options = case
    r = rs274(program.replace("|", "\n"), tools=TOOLS, files=m.SUBS, **options)
    got = r.err.removeprefix("executing\n")
    if r.status != 1 or not got.startswith(want.replace("\\n", "\n") + "\n"):
        return f"{program!r} {options or ''}:\n    got  {got[:200]!r}\n    want {want!r}"
    return None


cases = [(program + "|M2|", want, {}) for table in m.TABLES for program, want in table]
cases += [(program, want, {}) for program, want in m.PERCENT]
cases += [(program + "|M2|", want, {"ini": m.MACHINE + ini}) for ini, program, want in m.WITH_INI]
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    problems = [p for p in pool.map(problem, cases) if p]
for text, want in m.VARIABLES:
    r = rs274("M2\n", var=text)
    if r.status != 1 or want not in r.err:
        problems.append(f"variable file {text!r}: {r.err!r}")
print("\n".join(problems) or "ok")
