# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors of a .comp file: where, what was found, what was expected."""

from __future__ import annotations

import sys


class UsageError(Exception):
    """The command line or the environment does not allow the request."""


class CompError(Exception):
    """A mistake in a source file.

    rules: names of the enclosing grammar rules with the offset where each
    began, innermost first (only for grammar errors).
    """

    def __init__(self, message: str, offset: int | None = None,
                 rules: list[tuple[str, int]] | None = None):
        super().__init__(message)
        self.message = message
        self.offset = offset
        self.rules = rules or []


def line_and_column(text: str, offset: int) -> tuple[int, int]:
    """Line and column, both counted from 1, of an offset into text."""
    start = text.rfind("\n", 0, offset) + 1
    return text.count("\n", 0, offset) + 1, offset - start + 1


def _marked_line(text: str, offset: int) -> list[str]:
    line, column = line_and_column(text, offset)
    source = text.split("\n")[line - 1]
    indent = "".join("\t" if c == "\t" else " " for c in source[:column - 1])
    return [f">  {source}", f">  {indent}^"]


def describe(error: CompError, filename: str, text: str) -> str:
    """The whole report: FILE:LINE:COL: MESSAGE, the line, a caret, and the
    rules that were being parsed."""
    if error.offset is None:
        return f"{filename}:0: {error.message}"
    line, column = line_and_column(text, error.offset)
    report = [f"{filename}:{line}:{column}: {error.message}"]
    report += _marked_line(text, error.offset)
    for rule, offset in error.rules:
        report.append(f"while parsing {rule}():")
        report += _marked_line(text, offset)
    return "\n".join(report)


def warn(filename: str, line: int, message: str) -> None:
    print(f"{filename}:{line}: Warning: {message}", file=sys.stderr)
