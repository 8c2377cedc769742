#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""elbpcom: reads and writes a Mesa board on the network by hand (LBP16 packets)."""
import argparse
import socket
import struct
import sys

WRITE, ADDRESS, INFO, INCREMENT = 0x8000, 0x4000, 0x2000, 0x0080
SIZES = (8, 4, 2, 1)            # bytes of an element
MAX_COUNT = 127


def number(text):
    return int(text, 0)


class Board:
    def __init__(self, ip, port, timeout):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(timeout)
        self.socket.connect((ip, port))

    def ask(self, packet):
        """The answer, or None."""
        self.socket.send(packet)
        try:
            return self.socket.recv(2000)
        except (TimeoutError, ConnectionRefusedError):
            return None

    def show(self, packet, answers=True):
        print(">", packet.hex())
        if not answers:
            self.socket.send(packet)
            return
        answer = self.ask(packet)
        if answer is None:
            print("! no response")
            return
        print("<", answer.hex())
        print("     ", "".join(chr(b) if 32 <= b < 127 else "." for b in answer))

    def allowed_sizes(self, space):
        """Of a memory space, as its information says; all when it says nothing."""
        answer = self.ask(struct.pack("<HH", ADDRESS | INFO | space << 10 | 0x0100 | INCREMENT | 2, 0))
        mask = struct.unpack("<HH", answer)[1] & 0xF if answer and len(answer) == 4 else 0
        return [s for s in SIZES if mask & s] or SIZES


def command(options, board, length, write):
    size = options.size
    if not size:
        sizes = board.allowed_sizes(options.space)
        size = next((s for s in sizes if length % s == 0 and (options.address or 0) % s == 0), None)
        if size is None:
            sys.exit(f"elbpcom: space {options.space} has elements of {sizes} bytes: address and length do not fit")
    if length % size or length // size > MAX_COUNT or not length:
        sys.exit(f"elbpcom: {length} bytes are not 1 to {MAX_COUNT} elements of {size}")
    word = options.space << 10 | SIZES[::-1].index(size) << 8 | length // size
    word |= (WRITE if write else 0) | (INFO if options.info else 0) | (0 if options.no_increment else INCREMENT)
    if options.address is None:
        return struct.pack("<H", word)
    return struct.pack("<HH", word | ADDRESS, options.address)


def hex_bytes(text):
    try:
        return bytes.fromhex(text)
    except ValueError:
        sys.exit(f"elbpcom: '{text}' is no row of hexadecimal digits in pairs")


def prompt(board):
    for line in iter(lambda: (print("> ", end="", flush=True), sys.stdin.readline())[1], ""):
        if line.strip():
            board.show(hex_bytes(line.strip()))


def main():
    parser = argparse.ArgumentParser(prog="elbpcom", description=__doc__)
    parser.add_argument("-i", "--ip", default="192.168.1.121")
    parser.add_argument("-p", "--port", type=number, default=27181)
    parser.add_argument("-t", "--timeout", type=float, default=0.2, help="seconds")
    parser.add_argument("-s", "--space", type=number, default=0, choices=range(8), help="memory space (0)")
    parser.add_argument("--size", type=number, default=0, choices=(0, *SIZES), help="bytes of an element; 0: found out")
    parser.add_argument("--info", action="store_true", help="the space's information")
    parser.add_argument("-a", "--address", type=number)
    parser.add_argument("-n", "--no-increment", action="store_true", help="the same address again and again")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("-r", "--read", type=number, metavar="N", help="bytes to read")
    what.add_argument("-w", "--write", metavar="HEX", help="bytes to write")
    what.add_argument("--read-info", action="store_true", help="the space's information, whole")
    parser.add_argument("packet", nargs="*", metavar="HEXPACKET", help="packets to send as they are")
    options = parser.parse_args()
    board = Board(options.ip, options.port, options.timeout)
    if options.read_info:
        options.info, options.address, options.size, options.read = True, 0, 2, 16
    if options.read is not None:
        board.show(command(options, board, options.read, False))
    elif options.write is not None:
        data = hex_bytes(options.write)
        board.show(command(options, board, len(data), True) + data, answers=False)
    for packet in options.packet:
        board.show(hex_bytes(packet))
    if options.read is None and options.write is None and not options.packet:
        prompt(board)


if __name__ == "__main__":
    main()
