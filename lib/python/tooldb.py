# SPDX-License-Identifier: GPL-2.0-or-later
"""The controller's side of a tool database program ([EMCIO]DB_PROGRAM).

    tooldb_callbacks(get, put, load, unload)   what is called for each request
    tooldb_tools([1, 2, 10])                   the tool numbers there are
    tooldb_loop()                              serves requests; never returns

get(toolno) gives the line of a tool; the others take (toolno, params), params in capitals.
With the argument "debug" requests and replies go to standard error too.
"""
import sys
import traceback

DB_VERSION = "v2.1"
MAX_PARAMS = 14  # T and P, nine offsets, diameter, two angles, orientation: letters may be fewer

_tools = []
_calls = {}
_debug = len(sys.argv) > 1 and sys.argv[1] == "debug"


def tooldb_tools(tools):
    """Sets the list of tool numbers."""
    global _tools
    _tools = list(tools)


def tooldb_callbacks(user_get, user_put, user_load, user_unload):
    """Sets the functions of the user's program."""
    _calls.update(g=user_get, p=user_put, l=user_load, u=user_unload)


def _reply(text):
    if _debug:
        print(f"reply: {text}", file=sys.stderr)
    sys.stdout.write(text.rstrip("\n") + "\n")
    sys.stdout.flush()


def _nak(message, line):
    _reply(f"NAK {message} <{line}>")


def _toolno(word):
    """Number behind T; a text that says what is wrong with it otherwise."""
    try:
        number = int(word[1:])
    except ValueError:
        return "non-integer toolno"
    return number if number in _tools else "toolno out-of-range"


def _serve(line):
    words = line.upper().split()
    if not words:  # older hosts send one after each update; it wants no answer
        return
    command = words[0].lower()
    if command == "g":
        for number in _tools:
            try:
                _reply(_calls["g"](number))
            except Exception as x:
                traceback.print_exc()
                _nak(f"get_cmd():Exception:{x}", line)
                return
        _reply("FINI (get_cmd)")
        return
    if command == "t":
        number = _toolno("T" + words[1].lstrip("T")) if len(words) > 1 else "no toolno"
        if isinstance(number, str):
            _nak(number, line)
        else:
            _reply(_calls["g"](number))
        return
    if command not in ("p", "l", "u"):
        _nak("unknown cmd", line)
        return
    params = [w for w in words[1:]]
    for i, w in enumerate(params):
        if w.startswith(";"):
            params = params[:i]
            break
    if len(params) > MAX_PARAMS + 2:
        _nak("too many parms", line)
        return
    tool = next((w for w in params if w.startswith("T")), None)
    if tool is None:
        _nak("no toolno", line)
        return
    number = _toolno(tool)
    if number == "toolno out-of-range" and command != "p" and tool == "T0":
        number = 0  # the spindle becomes empty
    if isinstance(number, str):
        _nak(number, line)
        return
    text = " ".join(params)
    try:
        _calls[command](number, text)
    except Exception as x:
        traceback.print_exc()
        _nak(f"cmd={command}: Exception:{x}", line)
        return
    _reply(f"FINI (update recvd) {text}")


def tooldb_loop():
    """Says the version and answers requests until the host ends."""
    _reply(DB_VERSION)
    for line in sys.stdin:
        line = line.rstrip("\r\n")
        if _debug:
            print(f"request: {line}", file=sys.stderr)
        _serve(line)
    sys.exit(0)
