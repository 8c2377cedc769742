# SPDX-License-Identifier: GPL-2.0-or-later
"""Prolog, body and epilog in Python, generators that wait, O-word subs, named parameters, errors."""
from harness import *

INI = """[EMC]
VERSION=1.1
[TRAJ]
LINEAR_UNITS=mm
[PYTHON]
TOPLEVEL=python/toplevel.py
PATH_PREPEND=./python
[RS274NGC]
SUBROUTINE_PATH=subs
REMAP=M400 modalgroup=10 argspec=Pq python=m400
REMAP=M6 modalgroup=6 prolog=pro epilog=epi ngc=six
REMAP=M401 modalgroup=10 python=m401
REMAP=M402 modalgroup=10 python=m402
REMAP=M403 modalgroup=10 python=m403
REMAP=M404 modalgroup=10 argspec=@P python=m400
REMAP=M405 modalgroup=10 python=m405
REMAP=M406 modalgroup=10 python=m406
REMAP=M407 modalgroup=10 python=m407
REMAP=G88.2 modalgroup=1 argspec=XZ python=g882
"""
FILES = {
    "python/toplevel.py": "import remap\nimport oword\nimport namedparams\ndef __init__(self):\n"
                          "    print('init', self.task)\ndef __delete__(self):\n    print('delete')\n",
    "python/remap.py": """from interpreter import *
import emccanon
def m400(self, **words):
    print('m400', words, self.blocks[self.remap_level].p_number, str(self.blocks[self.remap_level].executing_remap).strip())
    self.execute('G1 X[1+%f]' % words['p'])
    emccanon.MESSAGE('from python')
    return INTERP_OK
def pro(self, **words):
    print('prolog', self.selected_tool, self.selected_pocket, self.current_tool, self.remap_level)
    self.params['zz'] = 7
    return INTERP_OK
def epi(self, **words):
    print('epilog', self.blocks[self.remap_level].builtin_used, self.return_value, self.value_returned, self.params['zz'])
    return INTERP_OK
def m401(self, **words):
    self.execute('G38.2 Z-5')
    yield INTERP_EXECUTE_FINISH
    print('probed', self.params[5063], self.parameters[5070])
    self.execute('o<sub> call [3]')
    print('after sub', self.return_value, self.current_x, self.active_g_codes[1], len(self.params))
    yield INTERP_OK
    print('never')
def m402(self, **words):
    self.set_errormsg('my error')
    return INTERP_ERROR
def m403(self, **words):
    try:
        self.execute('G1 X[1/0]')
    except InterpreterException as e:
        print('caught', e.error_message, e.line_text)
    try:
        self.params['nothere']
    except RuntimeError as e:
        print(e)
def m405(self, **words):
    raise ValueError('boom')
def m406(self, **words):
    return 'said so'
def m407(self, **words):
    return 1.5
def g882(self, **words):
    print('cycle', sorted(words.items()), self.blocks[self.remap_level].g_modes[1])
    self.motion_mode = 882
""",
    "python/oword.py": "def square(self, *a):\n    return a[0]**2\ndef wait(self, *a):\n"
                       "    self.execute('M66 P1 L0')\n    yield 2\n    print('waited', self.params[5399])\n"
                       "    yield 8.5\n"
                       "def nothing(self):\n    pass\ndef bad(self):\n    return 'x'\n",
    "python/namedparams.py": "def _answer(self):\n    return 42\ndef _bad(self):\n    return None\n",
    "subs/six.ngc": "o<six> sub\n(debug,zz=#<zz> rl=#<_remap_level> cl=#<_call_level>)\nM6\no<six> endsub [5]\n",
    "subs/sub.ngc": "o<sub> sub\n(print,in sub #1)\no<sub> return [#1+1]\no<sub> endsub\n",
}


def run(program, ini=INI):
    return rs274(program, ini=ini, files=FILES)


r = run("G21 F100\nM400 P5 Q7 G0 X3\nT1\nM6\nM401\nM2\n")
check(r.status == 0, r.err)
check(r.printed == ["init 0",
                    "m400 {'p': 5.0, 'q': 7.0} 5.0 Remap(M400 argspec=Pq modal_group=10 prolog=None ngc=None "
                    "python=m400 epilog=None)",
                    "prolog 1 1 -1 1", "epilog True 5.0 1 7.0", "probed -5.0 0.0", "in sub 3.000000",
                    "after sub 4.0 3.0 382 5602", "delete"], r.printed)
check([n for n, _ in r.calls if n in ("MESSAGE", "CHANGE_TOOL", "STRAIGHT_FEED", "STRAIGHT_TRAVERSE")] ==
      ["STRAIGHT_FEED", "MESSAGE", "STRAIGHT_TRAVERSE", "MESSAGE", "CHANGE_TOOL"], r.out)
r = run("o<square> call [7]\n(print,#<_value> #<_value_returned> #<_answer>)\no<wait> call\n(print,#<_value>)\n"
        "o<nothing> call\n(print,#<_value_returned>)\n"
        "M403\n;py,print('line', this.params['_answer'])\nG88.2 X1 Z2\nX3 Z4\nM2\n")
check(r.printed[1:-1] == ["49.000000 1.000000 42.000000", "waited 0.0", "8.500000", "0.000000",
                          "caught Attempt to divide by zero G1 X[1/0]", "parameter does not exist: nothere",
                          "line 42.0", "cycle [('x', 1.0), ('z', 2.0)] 882", "cycle [('x', 3.0), ('z', 4.0)] -1"],
                          r.printed)
for program, want, line in (("M402", "my error", "O <m402> call "), ("M405", "pycall(m405):", None),
                            ("M406", "said so", None),
                            ("M407", "handler_returned: m407 returned double: 1.500000 - invalid", None),
                            ("M404 P1", "add parameters: can't add 'p' to args", "M404 P1"),
                            ("o<bad> call", "pycall(oword.bad) failed", None),
                            ("G0 X#<_bad>", "Python namedparams._bad returns no value", "G0 X#<_bad>"),
                            (";py,1/0", None, ";py,1/0")):
    r = run(program + "\nM2\n")
    lines = r.err.split("\n")
    check(r.status == 1 and (want is None or want in lines), f"{program}: {r.err}")
    check(line is None or line in lines, f"{program}: {r.err}")
check("ZeroDivisionError" in run(";py,1/0\nM2\n").err and "ValueError: boom" in run("M405\nM2\n").err,
      "tracebacks are shown")
r = run("M2\n", INI.replace("python=m400", "python=nothere"))
check(r.status == 1 and "'nothere' is not a Python callable function" in r.err, r.err)
# Types and fields that handlers of others use.
r = rs274("M3 S5\nM400\nM2\n", ini=INI.replace("argspec=Pq python=m400", "python=m409"),
          files={**FILES, "python/remap.py": FILES["python/remap.py"] + """
import interpreter
def m409(self, **words):
    b = self.blocks[self.remap_level]
    print(DISTANCE_MODE.MODE_INCREMENTAL + 0, CUTTER_COMP_DIRECTION(2).name, FEED_MODE.INVERSE_TIME == INVERSE_TIME, b.call_type, b.offset >= 0, b.breadcrumbs > 0,
          self.spindle_turning[0], self.spindle_mode[0], self.speed_override[0], len(self.speed), interpreter.RemapMap is dict)
    try:
        self.spindle_turning[0] = 3
    except TypeError as e:
        print(e)
"""})
check(r.printed[1:3] == ["1 LEFT True 4 True True 2 0 1 8 True", "this array cannot be written"], (r.printed, r.err))

# FP-114: user code may be plain functions or generators, and its mistakes name file and line.
def with_handler(body):
    files = dict(FILES)
    files["python/remap.py"] = FILES["python/remap.py"] + "def m408(self, **words):\n" + body
    return rs274("G0 X1\nM408\nG0 X2\nM2\n",
                 ini=INI.replace("[RS274NGC]\n", "[RS274NGC]\nREMAP=M408 modalgroup=10 python=m408\n"), files=files)


for body in ("    pass\n", "    return INTERP_OK\n", "    yield INTERP_OK\n", "    yield INTERP_EXECUTE_FINISH\n"):
    r = with_handler(body)
    check(r.status == 0 and [a[0] for n, a in r.moves()] == [1, 2], body + r.err)
for body, shown in (("    undefined_name()\n", "NameError"), ("    yield INTERP_OK\n    1 +\n", "SyntaxError"),
                    ("    import sys\n    sys.exit(3)\n", "SystemExit"),
                    ("    def inner():\n        yield INTERP_EXECUTE_FINISH\n        raise KeyError('k')\n"
                     "    yield from inner()\n", "KeyError")):
    r = with_handler(body)
    check(r.status == 1 and shown in r.err and "remap.py" in r.err and re.search(r"line \d+", r.err), body + r.err)
    check([a[0] for n, a in r.moves()] in ([1], []), r.out)

# A handler that gives no status ends the program there, with its reason; whatever it is, the interpreter lives on.
for body, shown in (("return -1", "the handler returned -1 without a message"),
                    ("self.set_errormsg('no air')\n    return -2", "no air"),
                    ("return INTERP_ENDFILE", "the handler returned 3 without a message"),
                    ("return 2**40", "Unable to cast"), ("yield 2**40", "Unable to cast"),
                    ("return 'a\\udcff'", "a\\udcff"), ("raise ValueError('a\\udcff')", "ValueError: a\\udcff"),
                    ("yield", "Python generator m408 yielded 'None' - expected int, got NoneType"),
                    ("yield 2\n    yield -3", "the handler returned -3 without a message")):
    r = with_handler(f"    {body}\n")
    check(r.status == 1 and shown in r.err and [a[0] for n, a in r.moves()] == [1], (body, r.status, r.err, r.out))
r = with_handler("    return INTERP_EXECUTE_FINISH\n")
check(r.status == 0 and [a[0] for n, a in r.moves()] == [1, 2], r.err)
for handler, shown in (("prolog", "low air"), ("epilog", "low air")):
    files = dict(FILES)
    files["python/remap.py"] += "def low(self, **words):\n    self.set_errormsg('low air')\n    return -1\n"
    r = rs274("M408\n(print,%d#<_call_level>)\nM2\n", files=files,
              ini=INI.replace("[RS274NGC]\n", f"[RS274NGC]\nREMAP=M408 modalgroup=10 {handler}=low ngc=sub\n"))
    check(r.status == 1 and r.error == shown and "0" not in r.printed, (handler, r.err, r.out))
for program in ("o<huge> call", "G0 X#<_huge>", "(pyrun,nothere.py)"):
    files = dict(FILES, **{"python/oword.py": "def huge(self):\n    return 10**400\n",
                           "python/namedparams.py": "def _huge(self):\n    return 10**400\n"})
    r = rs274(program + "\nM2\n", ini=INI, files=files)
    check(r.status == 1 and program in r.err.split("\n"), (program, r.status, r.err))

# What an O-word sub yields after it has waited is its value; it may wait more than once.
for body, value in (("yield 2\n    yield 1", "1 1"), ("yield 2\n    yield 0", "0 1"), ("yield 2\n    yield 5", "5 1"),
                    ("yield 2\n    yield 2", "2 1"),
                    ("from interpreter import INTERP_EXECUTE_FINISH as wait\n    yield wait\n    yield wait\n    yield 3.0", "3 1"), ("yield 2", "0 0"), ("yield 2\n    yield", "0 0")):
    r = rs274("o<later> call\n(print,%d#<_value> #<_value_returned> level #<_call_level>)\nM2\n", ini=INI,
              files=dict(FILES, **{"python/oword.py": f"def later(self):\n    {body}\n"}))
    check(r.status == 0 and value + " level 0" in r.printed, (body, r.printed, r.err))

# A handler that failed leaves those of other codes and O-word subs as they were.
r = rs274("M2\n", ini=INI, files=dict(FILES, **{"python/toplevel.py": FILES["python/toplevel.py"] + """
def __init__(self):
    for line in 'M405', 'o<square> call [7]':
        try:
            self.execute(line)
        except InterpreterException as e:
            print(e.error_message.split(':')[0])
    print(self.return_value)
from interpreter import InterpreterException
"""}))
check(r.status == 0 and r.printed == ["pycall(m405)", "49.0", "delete"], (r.printed, r.err))

# A handler waits for another one that waits: the inner one goes on first.
files = dict(FILES)
files["python/remap.py"] += """
def change(self, **words):
    self.execute('M6')
    yield INTERP_EXECUTE_FINISH
    print('changed', self.current_tool, self.remap_level)
    self.execute('G0 Z1')
    yield INTERP_EXECUTE_FINISH
    print('done')
def twice(self, **words):
    for tool in 1, 2:
        self.execute(f'T{tool} M6 G0 X{tool}')
        yield INTERP_EXECUTE_FINISH
        print('after', self.current_tool, self.remap_level)
"""
files["python/oword.py"] += """
from interpreter import *
def fetch(self, tool):
    self.execute('T%d M6' % tool)
    yield INTERP_EXECUTE_FINISH
    self.execute('M411')
    yield INTERP_EXECUTE_FINISH
    yield self.current_tool
"""
r = rs274("o<fetch> call [3]\n(print,%d#<_value> level %d#<_call_level> %d#<_remap_level>)\nM411\nG0 Y5\nM2\n", files=files,
          ini=INI.replace("prolog=pro epilog=epi ngc=six", "python=change\nREMAP=M411 modalgroup=10 python=twice"))
both = [text for tool in (1, 2) for text in (f"changed {tool} 2", "done", f"after {tool} 1")]
check(r.status == 0 and r.printed[1:-1] == ["changed 3 1", "done", *both, "2 level 0 0", *both], (r.printed, r.err))
check([a[:3] for n, a in r.moves()] == [[0, 0, 1], [0, 0, 1], [1, 0, 1], [1, 0, 1], [2, 0, 1], [2, 0, 1], [1, 0, 1],
                                       [1, 0, 1], [2, 0, 1], [2, 5, 1]], r.out)

# Statements of a comment may execute lines; the comment's own line goes on behind them.
r = run(";py,this.execute('G0 X3')\n;py,this.execute('o<sub> call [4]')\nG0 X4\nM2\n")
check(r.status == 0 and [a[0] for n, a in r.moves()] == [3, 4] and "in sub 4.000000" in r.printed, (r.err, r.out))
done()
