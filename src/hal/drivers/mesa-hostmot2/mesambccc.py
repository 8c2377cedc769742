#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""mesambccc: Modbus commands in XML (.mbccs) to the binary file (.mbccb) that hm2_modbus loads."""
import argparse
import math
import re
import struct
import sys
from xml.etree import ElementTree
from xml.parsers import expat

FUNCTIONS = {"R_COILS": 1, "R_INPUTS": 2, "R_REGISTERS": 3, "R_INPUTREGS": 4, "W_COIL": 5, "W_REGISTER": 6,
             "W_COILS": 15, "W_REGISTERS": 16}
BITS, READS = (1, 2, 5, 15), (1, 2, 3, 4)
ORDERS = ["AB", "BA", "ABCD", "BADC", "CDAB", "DCBA", "ABCDEFGH", "BADCFEHG", "CDABGHEF", "DCBAHGFE", "EFGHABCD",
          "FEHGBADC", "GHEFCDAB", "HGFEDCBA", "A", "B"]
HAL_TYPES = {"bit": 1, "HAL_BIT": 1, "float": 2, "HAL_FLOAT": 2, "s32": 3, "HAL_S32": 3, "u32": 4, "HAL_U32": 4,
             "s64": 6, "HAL_S64": 6, "u64": 7, "HAL_U64": 7}
TIMES_OUT, BC_ANSWER, NO_ANSWER, RESEND, WRITE_FLUSH, DISABLED = 1, 2, 4, 8, 0x10, 0x20
PARITY, ODD, TWO_STOP = 0x100, 0x200, 0x400
FULL_DUPLEX, SUSPENDED = 8, 16
ONCE = 0xFFFFFFFF
HEADER = struct.Struct(">8sIHHHHHH28xIII")
RECORD = struct.Struct(">BBHHHHHIIIII")


class Fault(Exception):
    """A mistake in the file, with the element it is in."""

    def __init__(self, element, text):
        super().__init__(f"line {element.line}: <{element.tag}>: {text}" if element is not None else text)


class Element(ElementTree.Element):
    line = 0


class Builder(ElementTree.TreeBuilder):
    """Elements that know their line."""

    def __init__(self, parser):
        super().__init__(element_factory=Element)
        self.parser = parser

    def start(self, tag, attrs):
        element = super().start(tag, attrs)
        element.line = self.parser.CurrentLineNumber
        return element


def read_tree(path):
    parser = expat.ParserCreate()
    builder = Builder(parser)
    parser.StartElementHandler, parser.EndElementHandler = builder.start, builder.end
    parser.CharacterDataHandler = builder.data
    with open(path, "rb") as f:
        parser.ParseFile(f)
    return builder.close()


# ---- Attributes ----------------------------------------------------------------

def known(e, names):
    for name in e.attrib:
        if name not in names:
            raise Fault(e, f"there is no attribute '{name}'; there are {' '.join(sorted(names))}")


def number(e, name, low, high, default=None):
    text = e.get(name)
    if text is None:
        if default is None:
            raise Fault(e, f"attribute '{name}' is missing")
        return default
    try:
        value = int(text, 0)
    except ValueError:
        value = None
    if value is None or not low <= value <= high:
        raise Fault(e, f"{name}=\"{text}\": a number from {low} to {high} belongs here")
    return value


def automatic(e, name, low, high):
    """0 for auto: the driver finds it out."""
    return 0 if e.get(name, "auto") == "auto" else number(e, name, low, high)


def flag(e, name, default=False):
    text = e.get(name)
    if text is None:
        return default
    if text.lower() not in ("true", "false", "1", "0", "yes", "no"):
        raise Fault(e, f"{name}=\"{text}\": true or false belongs here")
    return text.lower() in ("true", "1", "yes")


def choice(e, name, values, default):
    text = e.get(name, default)
    if text not in values:
        raise Fault(e, f"{name}=\"{text}\": there are {' '.join(values)}")
    return text


def function_of(e):
    text = e.get("function", "")
    code = FUNCTIONS.get(text) or (int(text) if text.isdigit() else 0)
    if code not in FUNCTIONS.values():
        raise Fault(e, f"function=\"{text}\": there are {' '.join(FUNCTIONS)}")
    return code


def modbus_type(e, text):
    kind, _, order = text.partition("_")
    if kind not in ("U", "S", "F") or order not in ORDERS or (kind == "F" and len(order) == 1):
        raise Fault(e, f"modbustype=\"{text}\": U, S or F, then _ and one of {' '.join(ORDERS)}")
    return "USF".index(kind) << 4 | ORDERS.index(order)


def type_registers(mtype):
    return max(1, len(ORDERS[mtype & 15]) // 2)


def hal_type(e, text):
    if text not in HAL_TYPES:
        raise Fault(e, f"haltype=\"{text}\": there are {' '.join(sorted(t for t in HAL_TYPES if t.isupper()))}")
    return HAL_TYPES[text]


# ---- File ----------------------------------------------------------------------

class Pin:
    def __init__(self, name, mtype, htype, flags, at):
        self.name, self.mtype, self.htype, self.flags, self.at = name, mtype, htype, flags, at


class Compiler:
    ROOT = {"baudrate", "drivedelay", "duplex", "icdelay", "interval", "parity", "rxdelay", "stopbits", "suspend",
            "timeout", "txdelay", "writeflush"}
    COMMAND = set("address bcanswer clamp count delay device disabled function haltype interval modbustype name "
                  "noanswer resend scale timeout timeoutbits timesout unaligned writeflush".split())
    INIT = set("address bcanswer count delay device function noanswer timeout timeoutbits timesout baudrate parity "
               "stopbits rxdelay txdelay drivedelay icdelay".split())

    def __init__(self, root):
        if root.tag != "mesamodbus":
            raise Fault(root, "the file begins with <mesamodbus>")
        known(root, self.ROOT)
        self.root = root
        self.baud = number(root, "baudrate", 1200, 1000000, 9600)
        self.parity = choice(root, "parity", "NOE", "E")
        self.two_stop = number(root, "stopbits", 1, 2, 1) == 2
        self.devices, self.names, self.data = {"broadcast": 0}, set(), bytearray(b"\0")
        self.inits, self.commands = [], []

    def compile(self):
        for part in self.root:
            if part.tag not in ("devices", "initlist", "commands"):
                raise Fault(part, "there are <devices>, <initlist> and <commands>")
            for e in part:
                {"devices": self.device, "initlist": self.init, "commands": self.command}[part.tag](e)
        if not self.commands:
            raise Fault(self.root, "there is no <command> in <commands>")
        self.data += bytes(-len(self.data) % 32)
        root, form = self.root, {"N": 0, "E": 1, "O": 3}[self.parity] | (4 if self.two_stop else 0)
        form |= FULL_DUPLEX if choice(root, "duplex", ("half", "full"), "half") == "full" else 0
        form |= SUSPENDED if flag(root, "suspend") else 0
        delays = [automatic(root, "txdelay", 1, 1020), automatic(root, "rxdelay", 1, 1020),
                  automatic(root, "drivedelay", 1, 31), automatic(root, "icdelay", 1, 255)]
        inits, commands = b"".join(self.inits), b"".join(self.commands)
        return HEADER.pack(b"MesaMB01", self.baud, form, *delays, 0, len(inits), len(commands), len(self.data)) + \
            inits + commands + self.data

    def device(self, e):
        known(e, {"name", "address"})
        name = e.get("name", "")
        if not re.fullmatch("[a-z0-9.-]+", name) or name in self.devices:
            raise Fault(e, f"name=\"{name}\": a new name of a-z 0-9 . -")
        self.devices[name] = number(e, "address", 1, 247)

    def address_of(self, e):
        name = e.get("device", "")
        if name not in self.devices:
            raise Fault(e, f"device=\"{name}\": there are {' '.join(sorted(self.devices))}")
        return name, self.devices[name]

    def timeout(self, e, function, count):
        """Microseconds; auto: as long as question and answer take, twice and a half, and 16 ms."""
        text = e.get("timeout", self.root.get("timeout", "auto"))
        if text != "auto":
            return number(e if e.get("timeout") else self.root, "timeout", 10000, 10000000)
        bits = number(e, "timeoutbits", 1, 10000000, 0)
        if not bits:
            per_char = 10 + (self.parity != "N") + (not self.two_stop)
            packed = math.ceil(count / 8)
            size = {1: 13 + packed, 2: 13 + packed, 3: 11 + 2 * count, 4: 11 + 2 * count, 5: 16, 6: 16,
                    15: 17 + packed, 16: 17 + 2 * count}[function]
            bits = 2.5 * per_char * size
        return math.ceil(2 * bits * 1e6 / self.baud) + 16000

    def flags(self, e):
        names = {"timesout": TIMES_OUT, "bcanswer": BC_ANSWER, "noanswer": NO_ANSWER, "resend": RESEND,
                 "disabled": DISABLED}
        value = sum(bit for name, bit in names.items() if flag(e, name))
        return value | (WRITE_FLUSH if flag(e, "writeflush", flag(self.root, "writeflush", True)) else 0)

    def fragment(self, content, align=False):
        """Where it is in the data segment; align: its content begins at a multiple of 4."""
        while align and (len(self.data) + 1) % 4:
            self.data.append(0)
        at = len(self.data)
        self.data.append(len(content) & 0xFF)
        self.data += content
        return at

    # -- init list

    def init(self, e):
        if e.tag != "command":
            raise Fault(e, "there are only <command> here")
        known(e, self.INIT)
        if e.get("delay"):
            self.inits.append(RECORD.pack(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, number(e, "delay", 1, 60000000), 0))
        elif not e.get("function"):
            flags = {"N": 0, "E": PARITY, "O": PARITY | ODD}[choice(e, "parity", "NOE", self.parity)]
            flags |= TWO_STOP if number(e, "stopbits", 1, 2, 2 if self.two_stop else 1) == 2 else 0
            rx, tx = automatic(e, "rxdelay", 1, 1020), automatic(e, "txdelay", 1, 1020)
            drive, gap = automatic(e, "drivedelay", 1, 31), automatic(e, "icdelay", 1, 255)
            baud = number(e, "baudrate", 1200, 1000000, self.baud)
            self.inits.append(RECORD.pack(0, 0, flags, 1, rx, tx, drive, gap, 0, 0, baud, 0))
        else:
            self.init_frame(e)

    def init_frame(self, e):
        function, (_, address) = function_of(e), self.address_of(e)
        values = [int(d.get("value", "0"), 0) for d in e]
        at = number(e, "address", 0, 65535)
        if function in READS:
            count, body = number(e, "count", 1, 2000, 1), b""
        elif function in (5, 6):
            count, body = 1, b""
        elif function == 15:
            count = len(values)
            bits = sum(1 << n for n, v in enumerate(values) if v)
            body = bytes([(count + 7) // 8]) + bits.to_bytes((count + 7) // 8, "little")
        else:
            count = len(values)
            body = bytes([2 * count]) + b"".join(struct.pack(">H", v & 0xFFFF) for v in values)
        if function in (5, 6, 15, 16) and not values:
            raise Fault(e, "there is no <data value=\"...\"/>")
        word = {5: 0xFF00 if values and values[0] else 0, 6: values[0] & 0xFFFF if values else 0}.get(function, count)
        frame = struct.pack(">BBHH", address, function, at, word) + body
        self.inits.append(RECORD.pack(address, function, self.flags(e), at, 0, count, 0, 0, 0, 0,
                                      self.timeout(e, function, count), self.fragment(frame)))

    # -- commands

    def command(self, e):
        if e.tag != "command":
            raise Fault(e, "there are only <command> here")
        known(e, self.COMMAND)
        if e.get("delay"):
            self.commands.append(RECORD.pack(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, number(e, "delay", 1, 60000000), 0))
            return
        function, (device, address) = function_of(e), self.address_of(e)
        pins, count = self.pins(e, function, device)
        types = b"".join(bytes([p.mtype, p.htype, p.flags, p.at]) for p in pins)
        typeptr = self.fragment(types, align=True)
        names = [self.fragment(p.name.encode() + b"\0") for p in pins]
        interval = e.get("interval", self.root.get("interval", "0"))
        interval = ONCE if interval == "once" else \
            number(e if e.get("interval") else self.root, "interval", 0, 3600000000, 0)
        at = number(e, "address", 0, 65535)
        self.commands.append(RECORD.pack(address, function, self.flags(e), at, len(pins), count, 0, 0, typeptr,
                                         interval, self.timeout(e, function, count), names[0]))

    def pins(self, e, function, device):
        """Of a command, and how many bits or registers it has."""
        tags, pins, at = list(e), [], 0
        for tag in tags:
            if tag.tag != "pin":
                raise Fault(tag, "there are only <pin> here")
            known(tag, {"name", "haltype", "modbustype", "scale", "clamp", "skip"})
        named = [t for t in tags if not t.get("skip")]
        wanted = max(number(e, "count", 1, 2000, len(named) or 1), len(named))
        tags += [None] * (wanted - len(named))
        for tag in tags:
            if tag is not None and tag.get("skip"):
                at += number(tag, "skip", 0, 24)
                continue
            pins.append(self.pin(e, tag, function, device, len(pins), at))
            at += 1 if function in BITS else type_registers(pins[-1].mtype)
        if function in (5, 6) and at != 1:
            raise Fault(e, "this function writes one value")
        if at > (1968 if function in BITS else 123) or any(p.at > 255 for p in pins):
            raise Fault(e, "it has more values than a frame can hold")
        return pins, at

    def pin(self, e, tag, function, device, index, at):
        get = lambda name, default: (tag.get(name) if tag is not None else None) or e.get(name) or default
        where = tag if tag is not None else e
        htype = hal_type(where, get("haltype", "HAL_BIT" if function in BITS else "HAL_U32"))
        mtype = modbus_type(where, get("modbustype", "U_AB"))
        flags = 0 if htype == 1 else 1 if flag(where, "scale", flag(e, "scale", htype == 2)) else 0
        flags |= 2 if flag(where, "clamp", flag(e, "clamp", True)) else 0
        name = (tag.get("name") if tag is not None else None) or f"{e.get('name', 'command')}-{index:02d}"
        name = f"{device}.{name}"
        if not re.fullmatch("[a-z0-9.-]+", name) or len(name) > 32:
            raise Fault(where, f"a pin's name is up to 32 characters of a-z 0-9 . -, '{name}' is not")
        if name in self.names:
            raise Fault(where, f"there is a pin '{name}' already")
        self.names.add(name)
        return Pin(name, mtype, htype, flags, at)


def main():
    parser = argparse.ArgumentParser(prog="mesambccc", description=__doc__)
    parser.add_argument("-v", "--verbose", action="store_true", help="tell what was made")
    parser.add_argument("-o", "--output", default="mesamodbus.output.mbccb", help="file to write (%(default)s)")
    parser.add_argument("file")
    options = parser.parse_args()
    try:
        compiler = Compiler(read_tree(options.file))
        data = compiler.compile()
        with open(options.output, "wb") as f:
            f.write(data)
    except (Fault, OSError, expat.ExpatError, ValueError) as fault:
        sys.exit(f"mesambccc: {options.file}: {fault}")
    if options.verbose:
        print(f"{options.output}: {len(compiler.inits)} init commands, {len(compiler.commands)} commands, "
              f"{len(compiler.names)} pins, {len(data)} bytes")


if __name__ == "__main__":
    main()
