#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A board with HostMot2 firmware on the network, simulated: `hm2_board.py IP [NAME [FIRMWARE]]` answers LBP16 packets
at IP:27181 until its standard input ends, and says `ready` first.

Time on the board goes on by CYCLE_NS with each packet that carries a read counter, so that what a test sees does not
depend on the computer. Registers from 0xF000 on are no part of HostMot2: with them (raw.write_address ...) a test
lets things happen to the board."""
import random
import select
import socket
import struct
import sys

import modbus_device

PORT = 27181
CYCLE_NS = 1_000_000
CLOCK_LOW, CLOCK_HIGH = 100_000_000, 200_000_000
IDROM = 0x400

# For tests: the next N answers are lost, are cut, or the N next packets do not arrive at all; the next packet comes
# so many ns late; the same for writes only.
LOSE, CUT, DEAF, LATE, LOSE_WRITES = 0xF000, 0xF004, 0xF008, 0xF00C, 0xF010
CHAOS = 0xF014              # one in so many packets goes wrong in some way
PACKETS = 0xF020            # number of packets so far
ENCODER_RATE = 0xF100       # of each encoder, 1/65536 counts in a cycle, signed
ENCODER_INDEX = 0xF180      # counts between index pulses; 0: none
ENCODER_INPUTS = 0xF1C0     # of encoder 0: bits that its status shows besides (15: quadrature error)
INPUTS = 0xF200             # levels at the pins of each port
CARD_FAULTS = 0xF300        # next so many transfers of smart-serial cards fail: at 0xF304 channels, 0xF308 their status
CARD_STATUS, CARD_COUNT, CARD_LATE = 0xF30C, 0xF310, 0xF314  # status always; counter of the card's encoder; not done
MODBUS_DAMAGED, MODBUS_SILENT = 0xF400, 0xF404    # next so many answers of the Modbus device are wrong, do not come
LEVELS = 0xF240             # what the pins of each port drive: value, and at LEVELS + 0x20 which of them do


def module(gtag, version, clock, instances, base, registers, multiple, strides=0):
    return struct.pack('<III', gtag | version << 8 | clock << 16 | instances << 24,
                       base | registers << 16 | strides << 24, multiple)


def pin(tag=0, unit=0, code=0, output=False):
    return struct.pack('<I', 3 << 24 | unit << 16 | tag << 8 | code | (0x80 if output else 0))


def plain_firmware():
    """Modules, and pins of 3 ports of 17: 4 stepgens, 2 encoders, 2 pwmgens, the rest GPIO."""
    modules = [
        module(2, 0, 1, 1, 0x0C00, 3, 0),
        module(3, 0, 1, 3, 0x1000, 5, 0x1F),
        module(5, 2, 1, 4, 0x2000, 10, 0x1FF),
        module(4, 3, 1, 2, 0x3000, 5, 0x3),
        module(6, 0, 2, 2, 0x4000, 5, 0x3),
        module(128, 0, 1, 1, 0x0200, 1, 0),
    ]
    pins = [pin()] * 11
    pins += [p for unit in range(4) for p in (pin(5, unit, 1, True), pin(5, unit, 2, True))]
    pins += [pin(4, unit, code) for unit in range(2) for code in (1, 2, 3)]
    pins += [p for unit in range(2) for p in (pin(6, unit, 1, True), pin(6, unit, 2, True), pin(6, unit, 3, True))]
    return modules, pins + [pin()] * (51 - len(pins))


def full_firmware():
    """One or two of each kind of module whose registers are only memory, on 3 ports of 24."""
    modules = [
        module(2, 0, 1, 1, 0x0C00, 3, 0),
        module(19, 0, 1, 1, 0x5000, 4, 0x3),
        module(44, 0, 1, 2, 0x5800, 2, 0x1),
        module(26, 0, 1, 1, 0x6000, 7, 0),
        module(195, 0, 1, 1, 0x6800, 2, 0x3),
        module(192, 0, 1, 1, 0x7000, 5, 0x1F),
        module(30, 0, 1, 1, 0x7800, 5, 0x1F),
        module(35, 0, 1, 1, 0x8000, 5, 0x1F),
        module(43, 0, 1, 1, 0x8800, 11, 0x1FF),
        module(45, 0, 1, 1, 0x9800, 1, 0x1),
        module(199, 0, 1, 1, 0xA000, 6, 0x3F),
        module(200, 0, 1, 1, 0xA800, 4, 0xF),
        module(3, 0, 1, 3, 0x1000, 5, 0x1F),
        module(5, 0xC2, 1, 1, 0x2000, 10, 0x1FF),
        module(12, 4, 1, 2, 0x3000, 5, 0x3),
        module(13, 0, 1, 1, 0x3800, 1, 0),
        module(6, 1, 2, 1, 0x4000, 5, 0x3),
        module(128, 0, 1, 1, 0x0200, 1, 0),
        module(11, 0, 1, 1, 0xB000, 1, 0),
    ]
    outputs = [(5, 0, 1), (5, 0, 2), (5, 0, 3), (6, 0, 1), (6, 0, 2), (6, 0, 3), (13, 0x80, 1), (44, 0, 1), (44, 1, 1),
               (26, 0, 2), (30, 0, 1), (30, 0, 2), (43, 0, 1), (43, 0, 2), (43, 0, 3), (43, 0, 4), (195, 0, 1),
               (195, 0, 2), (195, 0, 32), (45, 0, 1), (45, 0, 9), (199, 0, 3), (199, 0, 4)]
    outputs += [(19, 0, code) for code in range(1, 8)] + [(192, 0, code) for code in range(2, 9)]
    inputs = [(12, 0, 1), (12, 0, 2), (12, 0, 3), (5, 0, 9), (5, 0, 10), (19, 0, 8), (192, 0, 9), (192, 0, 10),
              (30, 0, 1), (43, 0, 5), (199, 0, 1), (199, 0, 2), (200, 0, 1), (35, 0, 1), (35, 0, 2), (35, 0, 9)]
    pins = [pin(*words, True) for words in outputs] + [pin(*words) for words in inputs]
    return modules, pins + [pin()] * (72 - len(pins))


def serial_firmware():
    """A smart-serial port of four channels, absolute encoders, and serial channels."""
    modules = [
        module(2, 0, 1, 1, 0x0C00, 3, 0),
        module(3, 0, 1, 3, 0x1000, 5, 0x1F),
        module(193, 0, 1, 1, 0xC000, 6, 0x3C, 0x10),
        module(8, 0, 1, 2, 0x5000, 4, 0x03),
        module(24, 0, 1, 1, 0x5800, 4, 0x07),
        module(25, 0, 1, 1, 0x6000, 3, 0x1F),
        module(14, 0, 1, 1, 0x6800, 3, 0x7, 0x10),
    ]
    pins = [pin(193, 0, code + kind, output) for code in range(1, 5)
            for kind, output in ((0, False), (0, True), (16, True))]
    pins += [pin(8, unit, code, code < 3) for unit in range(2) for code in (1, 2, 3)]
    pins += [pin(24, 0, code, code < 3) for code in (1, 2, 3)] + [pin(25, 0, code, code < 3) for code in (1, 2, 3)]
    return modules, pins + [pin()] * (51 - len(pins))


def uart_firmware():
    """Channels for bytes and for frames."""
    modules = [
        module(2, 0, 1, 1, 0x0C00, 3, 0),
        module(3, 0, 1, 3, 0x1000, 5, 0x1F),
        module(9, 0, 1, 2, 0x7000, 4, 0xF, 0x10),
        module(10, 0, 1, 2, 0x7800, 4, 0xF, 0x10),
        module(27, 3, 1, 1, 0x8000, 4, 0xF),
        module(28, 3, 1, 1, 0x8800, 4, 0xF),
    ]
    pins = [pin(9, 1, 1, True), pin(9, 1, 2, True), pin(10, 1, 1), pin(27, 0, 1, True), pin(28, 0, 1)]
    return modules, pins + [pin()] * (51 - len(pins))


# Maker, pins of a port, the second stride of instances.
FIRMWARE = {'plain': (plain_firmware, 17, 0x40), 'full': (full_firmware, 24, 0x40),
            'serial': (serial_firmware, 17, 0x40), 'old-cards': (serial_firmware, 17, 0x40),
            'uart': (uart_firmware, 17, 0x10)}


class Card:
    """A smart-serial card that describes itself; what goes out comes back in."""
    PTOC, GTOC, RECORDS, UNIT, REVISION = 0x100, 0x140, 0x200, 0x20, 0x24

    def __init__(self, name, serial):
        self.name, self.serial = name, serial
        self.memory = bytearray(0x1000)
        self.locked = True
        struct.pack_into('<I', self.memory, self.UNIT, 7)
        self.memory[self.REVISION] = 14
        self.free = self.RECORDS
        self.outputs = [0, 0, 0]
        table = [self.record(16, 1, 0x80, 0, 1, 0x40, '', 'Output'),
                 self.record(10, 2, 0x80, 0, 100, 0x42, 'pct', 'SpinOut'),
                 self.record(1, 7, 0x80, 0, 0, 0x44, '', 'SpinEna'), self.record(5, 0, 0x80, 0, 0, 0x45, '', 'pad'),
                 self.record(16, 1, 0x00, 0, 1, 0x46, '', 'Input'),
                 self.record(10, 3, 0x00, -10, 10, 0x48, 'V', 'Analog'),
                 self.record(6, 0, 0x00, 0, 0, 0x49, '', 'pad'), self.record(8, 8, 0x00, 1, 4, 0x4A, '', 'Enc'),
                 self.record(1, 7, 0x00, 0, 0, 0x4B, '', 'SpinIsOn')]
        extra = [self.record(32, 4, 0x40, 0, 9, self.UNIT, '', 'NVUnitNumber'),
                 self.record(8, 2, 0x00, 0, 255, self.REVISION, '', 'SwRevision'), self.mode(0, 'Standard')]
        self.write_list(self.PTOC, table)
        self.write_list(self.GTOC, table + extra)

    def write_list(self, at, records):
        struct.pack_into(f'<{len(records)}H', self.memory, at, *records)

    def add(self, data):
        at = self.free
        self.memory[at:at + len(data)] = data
        self.free += len(data)
        return at

    def record(self, bits, kind, direction, low, high, addr, unit, name):
        return self.add(struct.pack('<BBBBffH', 0xA0, bits, kind, direction, low, high, addr) + unit.encode() + b'\0' +
                        name.encode() + b'\0')

    def mode(self, number, name):
        return self.add(bytes((0xB0, number, 1, 0)) + name.encode() + b'\0')

    def inputs(self, count):
        out = self.outputs[0]
        value = out & 0xFFFF | (out >> 16 & 0x3FF) << 16 | count << 32 | (out >> 26 & 1) << 40
        return [value >> 32 * n & 0xFFFFFFFF for n in range(3)]


class MuteCard(Card):
    """A card that the driver has to know: no tables; its inputs are what goes out, and 40 A are the most it can."""
    PTOC = GTOC = 0

    def write_list(self, at, records):
        struct.pack_into('<H', self.memory, 0x8E8, 4000)

    def inputs(self, count):
        return [self.outputs[0], self.outputs[0], self.outputs[0]]


class SerialPort:
    """Smart-serial port 0: commands are done at once."""
    COMMAND, DATA, CS, USER = 0xC000, 0xC100, 0xC200, 0xC300

    def __init__(self, registers, cards):
        self.r, self.cards = registers, cards
        self.out = {}
        self.running = False
        self.local = {2: 0, 3: 43, 4: 16, 5: 64}
        registers.on_write[self.COMMAND] = self.command
        for channel in range(8):
            registers.on_write[self.CS + 4 * channel] = lambda value, c=channel: self.out.__setitem__(('cs', c), value)
            for n in range(3):
                registers.on_write[self.USER + 0x100 * n + 4 * channel] = \
                    lambda value, n=n, c=channel: self.out.__setitem__((n, c), value)

    def put_user(self, channel, words):
        for n, word in enumerate(words):
            self.r.put(self.USER + 0x100 * n + 4 * channel, word)

    def command(self, value):
        if value == 0x80000000:
            return
        if value & 0xF000 == 0x2000:
            self.r.put(self.DATA, self.local.get(value & 0xFFF, 0))
        elif value & 0xF00 == 0xF00:
            self.running = False
            self.set_up(value & 0xFF)
        elif value & 0xF000 == 0x1000:
            self.do_it(value & 0xFF)
        elif value & 0xF00 == 0x900:
            self.running = True
        elif value & 0xF00 == 0x800:
            self.running = False
        self.r.put(self.COMMAND, value if self.r.get(CARD_LATE) else 0)

    def step(self):
        self.r.take(CARD_LATE)
        if not self.r.get(CARD_LATE):
            self.r.put(self.COMMAND, 0)

    def set_up(self, mask):
        for channel in range(8):
            card = self.cards.get(channel) if mask >> channel & 1 else None
            name = int.from_bytes(card.name.encode(), 'little') if card else 0
            self.put_user(channel, [card.serial, name, card.PTOC | card.GTOC << 16] if card else [0, 0, 0])

    def do_it(self, mask):
        self.r.put(self.DATA, 0)
        for channel, card in self.cards.items():
            if not mask >> channel & 1:
                continue
            if self.running:
                card.outputs = [self.out.get((n, channel), 0) for n in range(3)]
                self.put_user(channel, card.inputs(self.r.get(CARD_COUNT) & 0xFF))
                self.r.put(self.CS + 4 * channel, self.r.get(CARD_STATUS))
            else:
                self.single(channel, card)
        if self.running and self.r.take(CARD_FAULTS):
            failed = self.r.get(CARD_FAULTS + 4)
            self.r.put(self.DATA, failed)
            for channel in (c for c in self.cards if failed >> c & 1):
                self.r.put(self.CS + 4 * channel, self.r.get(CARD_FAULTS + 8))

    def single(self, channel, card):
        what, user = self.out.get(('cs', channel), 0), self.out.get((0, channel), 0)
        operation, addr = what >> 24, what & 0xFFFF
        if operation == 0x4C:
            self.put_user(channel, [card.memory[addr]])
        elif 0x44 <= operation <= 0x47:
            value = int.from_bytes(card.memory[addr:addr + (1 << operation - 0x44)], 'little')
            self.put_user(channel, [value & 0xFFFFFFFF, value >> 32])
        elif operation == 0xDF:
            self.put_user(channel, [0x5A])
        elif operation == 0xEC:
            card.locked = user == 0
        elif 0x64 <= operation <= 0x67:
            if addr == card.UNIT and card.locked:
                return
            size = 1 << (operation - 0x64)
            card.memory[addr:addr + size] = user.to_bytes(8, 'little')[:size]


class Registers:
    """64 KiB of registers, with actions at some addresses."""

    def __init__(self):
        self.memory = bytearray(0x10000)
        self.on_write, self.on_read = {}, {}

    def read(self, addr, size):
        for at in range(addr, addr + size, 4):
            if at in self.on_read:
                self.put(at, self.on_read[at]())
        return self.memory[addr:addr + size]

    def get(self, addr):
        return struct.unpack_from('<I', self.memory, addr)[0]

    def get_signed(self, addr):
        return struct.unpack_from('<i', self.memory, addr)[0]

    def put(self, addr, value):
        struct.pack_into('<I', self.memory, addr, value & 0xFFFFFFFF)

    def take(self, addr):
        """A counter of things to happen: one less, and was there one?"""
        n = self.get(addr)
        if n:
            self.put(addr, n - 1)
        return n > 0

    def write(self, addr, data):
        for at in range(0, len(data), 4):
            value = struct.unpack_from('<I', data, at)[0]
            action = self.on_write.get(addr + at)
            if action:
                action(value)
            else:
                self.put(addr + at, value)


class Watchdog:
    TIMER, STATUS, RESET = 0x0C00, 0x0D00, 0x0E00

    def __init__(self, registers):
        self.r = registers
        self.r.put(self.TIMER, 0x80000000)
        self.left = 0
        self.r.on_write[self.TIMER] = self.set_timer
        self.r.on_write[self.RESET] = self.pet

    def set_timer(self, value):
        self.r.put(self.TIMER, value)
        self.left = value

    def pet(self, value):
        if value == 0x5A000000:
            self.left = self.r.get(self.TIMER)

    def step(self, clocks):
        if self.r.get(self.TIMER) & 0x80000000:
            return
        self.left -= clocks
        if self.left < 0:
            self.r.put(self.STATUS, 1)

    @property
    def bitten(self):
        return self.r.get(self.STATUS) & 1


class Ports:
    BASE = 0x1000

    def __init__(self, registers, watchdog, count):
        self.r, self.watchdog, self.count = registers, watchdog, count
        self.out = [0] * count
        for port in range(count):
            self.r.on_write[self.BASE + 4 * port] = lambda value, port=port: self.set_out(port, value)

    def set_out(self, port, value):
        self.out[port] = value

    def step(self):
        for port in range(self.count):
            at = self.BASE + 4 * port
            ddr = 0 if self.watchdog.bitten else self.r.get(at + 0x100)
            drives = ddr & ~(self.r.get(at + 0x300) & self.out[port])
            value = self.out[port] ^ self.r.get(at + 0x400)
            self.r.put(LEVELS + 4 * port, value & drives)
            self.r.put(LEVELS + 0x20 + 4 * port, drives)
            self.r.put(at, (value & drives) | (self.r.get(INPUTS + 4 * port) & ~drives))


class StepGens:
    BASE = 0x2000

    def __init__(self, registers, count):
        self.r, self.count = registers, count
        self.exact = [0] * count          # 2^-32 steps

    def step(self, clocks):
        for i in range(self.count):
            self.exact[i] += self.r.get_signed(self.BASE + 4 * i) * clocks
            self.r.put(self.BASE + 0x100 + 4 * i, self.exact[i] >> 16)


class Encoder:
    """Counts at a rate; knows when it counted last."""
    BASE = 0x3000

    def __init__(self, registers, unit):
        self.r, self.unit = registers, unit
        self.position = 0                 # 1/65536 counts
        self.stamp = self.control = self.latched = 0
        self.r.on_write[self.BASE + 0x100 + 4 * unit] = self.set_control

    def set_control(self, value):
        self.control = value & 0x7FFF

    def step(self, begin, ticks):
        rate = self.r.get_signed(ENCODER_RATE + 4 * self.unit)
        before, old = self.position >> 16, self.position
        self.position += rate
        now = self.position >> 16
        if now != before:
            edge = (now if rate > 0 else now + 1) << 16
            self.stamp = int(begin + ticks * (edge - old) / rate)
        self.watch_index(before, now)
        self.r.put(self.BASE + 4 * self.unit, now & 0xFFFF | (self.stamp & 0xFFFF) << 16)
        inputs = self.r.get(ENCODER_INPUTS) if self.unit == 0 else 0
        self.r.put(self.BASE + 0x100 + 4 * self.unit, self.control | inputs | (self.latched & 0xFFFF) << 16)

    def watch_index(self, before, now):
        every = self.r.get(ENCODER_INDEX)
        if not every or not self.control & 0x10 or before // every == now // every:
            return
        self.latched = max(before, now) // every * every
        self.control &= ~0x10


class FrameChannel:
    """PktUART 0 with a Modbus device at address 5, whose answers are there at once."""
    TX, RX, ADDRESS = 0x8000, 0x8800, 5

    def __init__(self, registers):
        self.r = registers
        self.device = modbus_device.Device()
        self.out, self.frames, self.words = b'', [], []
        registers.on_write[self.TX] = lambda value: setattr(self, 'out', self.out + value.to_bytes(4, 'little'))
        registers.on_write[self.TX + 0x100] = self.send
        registers.on_write[self.RX + 0x300] = self.set_mode
        registers.on_read[self.RX] = lambda: self.words.pop(0) if self.words else 0
        registers.on_read[self.RX + 0x100] = lambda: self.frames.pop(0) if self.frames else 0
        registers.on_read[self.RX + 0x300] = lambda: len(self.frames) << 16

    def set_mode(self, value):
        if value == 0x80010000:
            self.frames, self.words = [], []

    def send(self, size):
        frame, self.out = self.out[:size], b''
        self.r.put(PACKETS + 4, self.r.get(PACKETS + 4) + 1)
        if frame[0] != self.ADDRESS or modbus_device.crc(frame[:-2]) != frame[-2:] or self.r.take(MODBUS_SILENT):
            return
        answer = frame[:1] + self.device.answer(frame[1:-2])
        answer += modbus_device.crc(answer)
        if self.r.take(MODBUS_DAMAGED):
            answer = answer[:-1] + bytes([answer[-1] ^ 1])
        self.frames.append(len(answer))
        answer += bytes(-len(answer) % 4)
        self.words += struct.unpack(f'<{len(answer) // 4}I', answer)


class Board:
    NAME_LEN = 16

    def __init__(self, name, firmware, port_width, stride):
        modules, pins = firmware
        self.registers = r = Registers()
        self.info = name.encode().ljust(self.NAME_LEN, b'\0') + bytes(48)
        self.timers, self.status = bytearray(64), bytearray(64)
        self.eeprom = b'\0\0' + bytes(reversed(bytes.fromhex('00601b123456'))) + bytes(120)
        self.write_identity(name, modules, pins, port_width, stride)
        self.watchdog = Watchdog(r)
        self.ports = Ports(r, self.watchdog, len(pins) // port_width)
        tags = [m[0] for m in modules]
        self.stepgens = StepGens(r, 4)
        self.encoders = [Encoder(r, unit) for unit in range(2) if {4, 12} & set(tags)]
        self.card_port = None
        self.frame_channel = FrameChannel(r) if 27 in tags else None
        self.ticks, self.last, self.random = 0.0, b'', random.Random(1)

    def write_identity(self, name, modules, pins, port_width, stride):
        r, count = self.registers, len(pins)
        r.put(0x100, 0x55AACAFE)
        r.memory[0x104:0x10C] = b'HOSTMOT2'
        r.put(0x10C, IDROM)
        words = [3, 0x40, 0x200, 0, 0, 9, 144, count // port_width, count, port_width, CLOCK_LOW, CLOCK_HIGH, 4, stride,
                 0x100, 4]
        for i, word in enumerate(words):
            r.put(IDROM + 4 * i, word)
        r.memory[IDROM + 12:IDROM + 20] = ('MESA' + name)[:8].encode().ljust(8, b'\0')
        text = b''.join(modules)
        r.memory[IDROM + 0x40:IDROM + 0x40 + len(text)] = text
        text = b''.join(pins)
        r.memory[IDROM + 0x200:IDROM + 0x200 + len(text)] = text

    def step(self, ns):
        clocks = ns * CLOCK_LOW // 1_000_000_000
        divisor = self.registers.get(0x3200) + 2
        ticks = clocks / divisor
        self.watchdog.step(clocks)
        self.stepgens.step(clocks)
        for encoder in self.encoders:
            encoder.step(self.ticks, ticks)
        self.ticks += ticks
        self.registers.put(0x3300, int(self.ticks) & 0xFFFF)
        self.ports.step()
        if self.card_port:
            self.card_port.step()

    def memory_of(self, space):
        if space >= 8:
            return struct.pack('<HHHH8s', 0x5A00 | space & 7, 0x0104 if space == 8 else 0x0102, 0x10, 0, b'HostMot2')
        return {2: self.eeprom, 4: self.timers, 6: self.status, 7: self.info}.get(space)

    def write(self, space, addr, data, deaf):
        if space == 0:
            if not deaf:
                self.registers.write(addr, data)
        elif space == 4:
            if addr == 0x10:
                late = self.registers.get(LATE)
                self.registers.put(LATE, 0)
                self.step(CYCLE_NS + late)
            if not deaf or addr == 0x10:
                self.timers[addr:addr + len(data)] = data

    def answer(self, packet):
        """Does what a packet says; the packets that the board sends back."""
        r, at, reply = self.registers, 0, b''
        r.put(PACKETS, r.get(PACKETS) + 1)
        writes = struct.unpack_from('<H', packet)[0] & 0x8000
        deaf = r.take(DEAF) or (writes and (r.take(LOSE_WRITES) or self.unlucky()))
        reads = []
        while at < len(packet):
            command, addr = struct.unpack_from('<HH', packet, at)
            at += 4
            space, size = command >> 10 & 7, (command & 0x7F) << (command >> 8 & 3)
            if command & 0x2000:
                space += 8
            if command & 0x8000:
                self.write(space, addr, packet[at:at + size], deaf)
                at += size
            else:
                reads.append((space, addr, size))
        for space, addr, size in reads:
            reply += bytes(self.registers.read(addr, size) if space == 0 else self.memory_of(space)[addr:addr + size])
        if not reads or deaf or r.take(LOSE):
            return []
        return self.wrong(reply) if self.unlucky() else [reply[:-1] if r.take(CUT) else reply]

    def unlucky(self):
        every = self.registers.get(CHAOS)
        return every and self.random.randrange(every) == 0

    def wrong(self, reply):
        """What a network can make of an answer: nothing is lost, so that nobody waits."""
        old, self.last = self.last, reply
        return self.random.choice([[old, reply], [reply, reply], [reply[:self.random.randrange(len(reply))]],
                                   [reply + bytes(1300)], [bytes(len(reply)), reply], [b'', reply],
                                   [self.random.randbytes(len(reply)), reply]])


def main():
    ip, name, firmware = (sys.argv[1:] + ['7I96S', 'plain'][len(sys.argv) - 2:])[:3]
    make, port_width, stride = FIRMWARE[firmware]
    board = Board(name, make(), port_width, stride)
    if firmware == 'full':
        board.registers.put(0x6300, 42)     # ddsize of the DPLL
        board.registers.put(0x7800, 21)     # highest input of the input multiplexer, and of the inputs
        board.registers.put(0x8000, 9)
    if firmware == 'serial':
        board.card_port = SerialPort(board.registers, {0: Card('7I76', 0x1234), 2: Card('7I73', 0xABCD)})
    if firmware == 'old-cards':
        board.card_port = SerialPort(board.registers, {0: MuteCard('8I20', 0x0102001F), 1: MuteCard('7I64', 7)})
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.bind((ip, PORT))
    print('ready', flush=True)
    while True:
        readable, _, _ = select.select([sock, sys.stdin], [], [])
        if sock in readable:
            packet, sender = sock.recvfrom(2000)
            for reply in board.answer(packet):
                sock.sendto(reply, sender)
        elif not sys.stdin.read(1):
            return


if __name__ == '__main__':
    main()
