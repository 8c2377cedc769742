# SPDX-License-Identifier: GPL-2.0-or-later
"""The command line."""

from __future__ import annotations

import getopt
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

from . import adoc, build, cgen, man
from .checker import Component, check, check_bodies
from .errors import CompError, UsageError, describe
from .parser import parse_text

USAGE = """{prog}: Build, compile and install HAL components

Usage:
    {prog} [ --preprocess | -p ] compfile...
    {prog} [ --compile | -c ] [ -U ] compfile...
    {prog} [ --compile | -c ] [ -u ] cfile...
    {prog} [ --install | -i ] [ -U ] compfile...
    {prog} [ --install | -i ] [ -u ] cfile...
    {prog} [ --install | -i ] pyfile...
    {prog} [ --document | -d ] [ -o outfile | -k adocfile ] compfile...
    {prog} [ --adoc | -a ] [ -o outfile ] compfile...
    {prog} [ --install-doc | -j ] compfile...
    {prog} [ --view-doc | -J ] compfile...
    {prog} --print-modinc

Options:
    -o FILE, --outfile=FILE     name of the output (preprocess, document, adoc)
    -k FILE, --keep-adoc=FILE   keep the AsciiDoc of --document
    -u, --userspace             the following .c file is a userspace program
    -U, --unix                  accepted; line endings of any kind are read
    -l, --require-license       accepted; a license is always required
    -P N, --personalities=N     size of the personality array (default 64)
    --extra-compile-args=ARGS   more flags for compiling userspace programs
    --extra-link-args=ARGS      more flags for linking userspace programs
    -h, -?, --help              this text
"""

MODES = {"-p": "preprocess", "--preprocess": "preprocess", "-c": "compile", "--compile": "compile",
         "-i": "install", "--install": "install", "-d": "document", "--document": "document",
         "-a": "document", "--adoc": "document", "-j": "installdoc", "--install-doc": "installdoc",
         "-J": "viewdoc", "--view-doc": "viewdoc", "--print-modinc": "print-modinc"}
LONG = ["preprocess", "compile", "install", "document", "adoc", "install-doc", "view-doc", "print-modinc",
        "outfile=", "keep-adoc=", "userspace", "unix", "require-license", "personalities=",
        "extra-compile-args=", "extra-link-args=", "help", "output-dir="]


@dataclass
class Request:
    """What the command line asks for."""
    mode: str = "preprocess"
    adoc_only: bool = False
    outfile: str | None = None
    output_dir: str | None = None
    keep_adoc: str | None = None
    userspace: bool = False
    personalities: int = 64
    extra_compile_args: str = ""
    extra_link_args: str = ""
    files: list[str] = field(default_factory=list)


def usage() -> None:
    print(USAGE.format(prog="halcompile"), end="")


def parse_arguments(argv: list[str]) -> Request | None:
    """The request, or None when only help was wanted. Raises UsageError."""
    try:
        options, files = getopt.getopt(argv, "pcidajJo:k:uUlP:h?", LONG)
    except getopt.GetoptError as error:
        usage()
        raise UsageError(str(error)) from None
    request = Request(files=files)
    for name, value in options:
        if name in MODES:
            request.mode = MODES[name]
            request.adoc_only = name in ("-a", "--adoc")
        elif name in ("-o", "--outfile"):
            request.outfile = value
        elif name == "--output-dir":
            request.output_dir = value
        elif name in ("-k", "--keep-adoc"):
            request.keep_adoc = value
        elif name in ("-u", "--userspace"):
            request.userspace = True
        elif name in ("-P", "--personalities"):
            try:
                request.personalities = int(value)
            except ValueError:
                raise UsageError(f"Bad number of personalities: {value}") from None
            print(f"MAX_PERSONALITIES={request.personalities}")
        elif name == "--extra-compile-args":
            request.extra_compile_args = value
        elif name == "--extra-link-args":
            request.extra_link_args = value
        elif name in ("-h", "-?", "--help"):
            usage()
            return None
    if request.outfile and request.mode not in ("preprocess", "document"):
        raise UsageError("Can only specify -o when preprocessing or documenting")
    if request.outfile and len(files) != 1:
        raise UsageError("Cannot specify -o with multiple input files")
    if request.keep_adoc and len(files) != 1:
        raise UsageError("Cannot specify -k with multiple input files")
    if request.mode == "print-modinc" and files:
        raise UsageError("Can not specify input files when using --print-modinc")
    return request


def decoded(data: bytes) -> str:
    """Text of a file: UTF-8, with or without a byte order mark, or Latin-1 as older editors wrote it."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def load(filename: str, expected_name: str | None, request: Request) -> Component:
    """Reads, parses and checks a file; a mistake is reported and ends the program."""
    try:
        with open(filename, "rb") as f:
            text = decoded(f.read())
    except OSError as error:
        raise UsageError(f"{filename}: {error.strerror}") from None
    extra = {}
    if request.extra_compile_args:
        extra["extra_compile_args"] = request.extra_compile_args
    if request.extra_link_args:
        extra["extra_link_args"] = request.extra_link_args
    try:
        component = check(parse_text(filename, text), expected_name, extra)
        if request.mode in ("preprocess", "compile", "install"):
            check_bodies(component)
        return component
    except CompError as error:
        raise UsageError(describe(error, filename, text)) from None


def base_name(filename: str) -> str:
    return os.path.splitext(os.path.basename(filename))[0]


def write_if_changed(path: str, text: str) -> None:
    """Keeps the time of a file whose content is the same: make rebuilds less."""
    data = text.encode("utf-8")
    try:
        with open(path, "rb") as f:
            if f.read() == data:
                return
    except OSError:
        pass
    with open(path, "wb") as f:
        f.write(data)


def preprocess(filename: str, request: Request) -> None:
    if request.output_dir:
        outfile = os.path.join(request.output_dir, base_name(filename) + ".c")
    else:
        outfile = request.outfile or os.path.splitext(filename)[0] + ".c"
    component = load(filename, base_name(outfile), request)
    write_if_changed(outfile, cgen.generate(component, request.personalities))


def document(filename: str, request: Request) -> None:
    component = load(filename, base_name(filename), request)
    number = adoc.section_number(component)
    page = os.path.splitext(filename)[0] + f".{number}"
    if request.output_dir:
        page = os.path.join(request.output_dir, os.path.basename(page))
    if request.adoc_only:
        write_if_changed(request.outfile or page + ".adoc", adoc.render(component))
        return
    if request.keep_adoc:
        write_if_changed(request.keep_adoc, adoc.render(component))
    write_if_changed(request.outfile or page, man.render(component))


def install_document(filename: str, request: Request) -> None:
    print("INSTALLDOC None")
    component = load(filename, base_name(filename), request)
    number = adoc.section_number(component)
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", suffix=f".{number}", delete=False) as f:
        f.write(man.render(component))
    try:
        build.install_file(f.name, build.man_dir(number), f"{component.name}.{number}", 0o644)
    finally:
        os.unlink(f.name)


def view_document(filename: str, request: Request) -> None:
    component = load(filename, base_name(filename), request)
    with tempfile.TemporaryDirectory() as directory:
        page = os.path.join(directory, f"{component.name}.{adoc.section_number(component)}")
        with open(page, "w", encoding="utf-8") as f:
            f.write(man.render(component))
        subprocess.call(["man", page])


def compile_file(filename: str, request: Request) -> None:
    """Builds (and installs) a .comp or .c file."""
    name, extension = base_name(filename), os.path.splitext(filename)[1]
    source_dir = os.path.dirname(filename) or "."
    with tempfile.TemporaryDirectory() as workdir:
        if extension == ".comp":
            component = load(filename, name, request)
            c_file = os.path.join(workdir, name + ".c")
            with open(c_file, "w", encoding="utf-8") as f:
                f.write(cgen.generate(component, request.personalities))
            if not os.path.isabs(filename) and os.pardir not in filename.split(os.sep):
                # where the compiler's messages find the lines that they show
                os.makedirs(os.path.join(workdir, os.path.dirname(filename)), exist_ok=True)
                shutil.copy(filename, os.path.join(workdir, filename))
            userspace = component.userspace
            compile_args = str(component.option("extra_compile_args", ""))
            link_args = str(component.option("extra_link_args", ""))
        else:
            c_file = os.path.abspath(filename)
            userspace = request.userspace
            compile_args, link_args = request.extra_compile_args, request.extra_link_args
        install = request.mode == "install"
        if userspace:
            build.build_user(c_file, name, source_dir, workdir, install, compile_args, link_args)
        else:
            build.build_rt(c_file, name, source_dir, workdir, install)


def process(filename: str, request: Request) -> None:
    extension = os.path.splitext(filename)[1]
    mode = request.mode
    if extension == ".comp":
        {"preprocess": preprocess, "document": document, "installdoc": install_document,
         "viewdoc": view_document, "compile": compile_file, "install": compile_file}[mode](filename, request)
    elif extension == ".c" and mode != "preprocess":
        compile_file(filename, request)
    elif extension == ".py" and mode == "install":
        build.install_python(filename)
    else:
        raise UsageError(f"Unrecognized file type for mode {mode}: {filename!r}")


def main(argv: list[str]) -> int:
    """Runs the program; its exit status."""
    request = None
    try:
        request = parse_arguments(argv)
        if request is None:
            return 0
        if request.mode == "print-modinc":
            print(build.modinc())
            return 0
        for filename in request.files:
            process(filename, request)
    except UsageError as error:
        print(error, file=sys.stderr)
        if request and request.outfile and os.path.exists(request.outfile):
            os.unlink(request.outfile)
        return 1
    except build.BuildFailed as error:
        return error.status
    except OSError as error:
        print(f"{error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    return 0
