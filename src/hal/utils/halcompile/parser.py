# SPDX-License-Identifier: GPL-2.0-or-later
"""Recursive-descent parser: text of a .comp file to a syntax tree.

    File        := ComponentDecl Declaration* END
    ComponentDecl := "component" NAME [STRING] ";"
    Declaration := "pin"   ("in"|"out"|"io") TYPE HALNAME Tail
                 | "param" ("r"|"rw")        TYPE HALNAME Tail
                 | "function" NAME ["fp"|"nofp"] [STRING] ";"
                 | "variable" NAME STARREDNAME ["[" NUMBER "]"] ["=" Value] ";"
                 | "option" NAME [OptionValue] ";"
                 | "modparam" NAME NAME ["=" Value] [STRING] ";"
                 | "include" HEADER ";"
                 | ("description"|"examples"|"notes"|"see_also"|"author"|"license") STRING ";"
    Tail        := [Array] ["=" Value] ["if" Condition] [STRING] ";"
    Array       := "[" NUMBER [":" Condition] "]"

One method per rule; `_rules` is the stack of rules for messages.
"""

from __future__ import annotations

import re
from contextlib import contextmanager

from .errors import CompError
from .lexer import Lexer, Token, string_value
from .nodes import (Array, ComponentDecl, Condition, Declaration, File, Function, Include,
                    Item, ModParam, Option, Text, Value, Variable)

TYPES = ("float", "bit", "signed", "s32", "unsigned", "u32", "s64", "u64", "port",
         "bool", "real", "sint", "uint", "si32", "ui32")
TEXT_SECTIONS = ("description", "examples", "notes", "see_also", "author", "license")
DECLARATIONS = ("pin", "param", "function", "variable", "option", "modparam", "include") + TEXT_SECTIONS
BOOLS = ("yes", "no", "true", "false", "TRUE", "FALSE")
# What people's editors leave around the line counts only where no exact one is.
SEPARATORS = (re.compile(r"^;;(?:\n|\Z)", re.M), re.compile(r"^[ \t]*;;[ \t]*(?:\n|\Z)", re.M))


class Parser:
    def __init__(self, text: str):
        self.lexer = Lexer(text)
        self._rules: list[tuple[str, int]] = []

    # Token handling.

    @contextmanager
    def _rule(self, name: str):
        self._rules.append((name, self.lexer.skip()))
        yield
        self._rules.pop()       # kept on an error: it belongs to the message

    def _fail(self, expected: tuple[str, ...]):
        offset = self.lexer.skip()
        if "STRING" in expected and self.lexer.text.startswith('"', offset):
            raise CompError("String without end", offset, self._rules[::-1])
        names = ", ".join(k if k.isupper() else f'"{k}"' for k in expected)
        raise CompError(f"Trying to find one of {names}", offset, self._rules[::-1])

    def _need(self, *kinds: str) -> Token:
        token = self.lexer.peek(*kinds)
        if token is None:
            self._fail(kinds)
        return self.lexer.take(token)

    def _accept(self, *kinds: str) -> Token | None:
        token = self.lexer.peek(*kinds)
        return self.lexer.take(token) if token else None

    def _doc_and_end(self) -> str | None:
        token = self._need("STRING", ";")
        if token.kind == ";":
            return None
        self._need(";")
        return string_value(token)

    # Rules.

    def file(self) -> tuple[ComponentDecl, list[Declaration]]:
        with self._rule("File"):
            component = self.component()
            declarations = []
            while self.lexer.peek("END") is None:
                declarations.append(self.declaration())
        return component, declarations

    def component(self) -> ComponentDecl:
        with self._rule("ComponentDeclaration"):
            self._need("component")
            name = self._need("NAME")
            return ComponentDecl(name.text, self._doc_and_end(), name.offset)

    def declaration(self) -> Declaration:
        with self._rule("Declaration"):
            word = self._need(*DECLARATIONS)
            if word.text in TEXT_SECTIONS:
                return self.text_section(word)
            return getattr(self, "declare_" + word.text)(word)

    def text_section(self, word: Token) -> Text:
        with self._rule("Text"):
            text = string_value(self._need("STRING"))
            self._need(";")
            return Text(word.text, text, word.offset)

    def declare_pin(self, _word: Token) -> Item:
        with self._rule("PinDeclaration"):
            return self._item("pin", ("in", "out", "io"))

    def declare_param(self, _word: Token) -> Item:
        with self._rule("ParamDeclaration"):
            return self._item("param", ("r", "rw"))

    def _item(self, kind: str, directions: tuple[str, ...]) -> Item:
        direction = self._need(*directions).text
        item_type = self._need(*TYPES).text
        name = self._need("HALNAME")
        array = self.array() if self.lexer.peek("[") else None
        start = condition = None
        while True:
            rest = ["=" if start is None else "", "if" if condition is None else ""]
            token = self._need(*[r for r in rest if r], "STRING", ";")
            if token.kind == "=":
                start = self.value(BOOLS + ("NAME", "FPNUMBER", "NUMBER"))
            elif token.kind == "if":
                condition = self.condition()
            else:
                break
        doc = None
        if token.kind == "STRING":
            doc = string_value(token)
            self._need(";")
        return Item(kind, direction, item_type, name.text, array, start, condition, doc, name.offset)

    def array(self) -> Array:
        with self._rule("OptArray"):
            self._need("[")
            size = self._need("NUMBER")
            places = int(size.text, 0) if size.text.lstrip("+-").lstrip("0") else 0
            if places < 1:
                raise CompError(f"Array size must be at least 1: {size.text}", size.offset)
            used = self.condition() if self._need(":", "]").kind == ":" else None
            if used is not None:
                self._need("]")
            return Array(places, used)

    def condition(self) -> Condition:
        with self._rule("Condition"):
            start = self.lexer.skip()
            tokens = []
            open_parts: list[str] = []          # of "(" and "?"
            operand = False                     # whether one has just ended
            while True:
                token = self.lexer.peek("OPERATOR", "CONDNUMBER", "personality")
                if token is None or (token.kind == "OPERATOR" and not operand and token.text not in ("(", "-", "+")
                                     and tokens[-1:] + [token.text] != ["?", ":"]):
                    break
                if operand and (token.kind != "OPERATOR" or token.text == "("):
                    self._fail(("OPERATOR", ";"))
                if token.text in (")", ":") and open_parts[-1:] != [{")": "(", ":": "?"}[token.text]]:
                    self._fail(("OPERATOR", ";"))
                if token.text in ("(", "?"):
                    open_parts.append(token.text)
                elif token.text in (")", ":"):
                    open_parts.pop()
                operand = token.kind != "OPERATOR" or token.text == ")"
                tokens.append(self.lexer.take(token).text)
            if self.lexer.peek("NAME") and self.lexer.peek("if") is None:
                self._fail(("OPERATOR", "NUMBER", "personality", ";"))
            if (tokens or token) and not operand:
                self._fail(("NUMBER", "personality", "("))
            if open_parts:
                self._fail((")" if open_parts[-1] == "(" else ":",))
            return Condition(tuple(tokens), start) if tokens else None

    def value(self, kinds: tuple[str, ...]) -> Value:
        with self._rule("Value"):
            token = self._need(*kinds)
            if token.kind in BOOLS:
                return Value("BOOL", token.text, token.offset)
            if token.kind == "STRING":
                return Value("STRING", string_value(token), token.offset)
            return Value(token.kind, token.text, token.offset)

    def declare_function(self, _word: Token) -> Function:
        with self._rule("FunctionDeclaration"):
            name = self._need("NAME")
            fp = self._accept("fp", "nofp")
            return Function(name.text, fp.text if fp else None, self._doc_and_end(), name.offset)

    def declare_variable(self, _word: Token) -> Variable:
        with self._rule("VariableDeclaration"):
            ctype = self._need("NAME")
            starred = self._need("STARREDNAME")
            name = starred.text.lstrip("*")
            size = None
            if self._accept("["):
                number = self._need("NUMBER")
                size = int(number.text, 0)
                self._need("]")
            value = None
            if self._need("=", ";").kind == "=":
                value = self.value(BOOLS + ("NAME", "FPNUMBER", "NUMBER"))
                self._need(";")
            return Variable(ctype.text, ctype.offset, starred.text[:len(starred.text) - len(name)], name, size, value,
                            starred.offset)

    def declare_option(self, _word: Token) -> Option:
        with self._rule("OptionDeclaration"):
            name = self._need("NAME")
            value = None
            if not self._accept(";"):
                value = self.value(BOOLS + ("NAME", "FPNUMBER", "NUMBER", "STRING"))
                self._need(";")
            return Option(name.text, value, name.offset)

    def declare_modparam(self, _word: Token) -> ModParam:
        with self._rule("ModParamDeclaration"):
            param_type = self._need("int", "dummy").text
            name = self._need("NAME")
            default = self.value(BOOLS + ("NAME", "FPNUMBER", "NUMBER")) if self._accept("=") else None
            return ModParam(param_type, name.text, default, self._doc_and_end(), name.offset)

    def declare_include(self, _word: Token) -> Include:
        with self._rule("IncludeDeclaration"):
            header = self._need("HEADER")
            self._need(";")
            return Include(header.text, header.offset)


def parse_text(name: str, text: str) -> File:
    """Parses the text of file `name`. Raises CompError."""
    separator = next(filter(None, (s.search(text) for s in SEPARATORS)), None)
    if separator is None:
        raise CompError('Missing the line ";;" between declarations and code')
    head, code = text[:separator.start()], text[separator.end():]
    component, declarations = Parser(head).file()
    return File(name, text, component, declarations, code, head.count("\n") + 2)
