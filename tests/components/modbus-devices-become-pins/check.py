# SPDX-License-Identifier: GPL-2.0-or-later
"""mb2hal with a device on TCP and one on a serial line: every function, both generations of
names, faults and their end."""
import os
import signal
import subprocess
import tempfile
from pathlib import Path

from hal_outside import halcmd, pins, until
from modbus_device import SerialDevice, TcpDevice

folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)


def get(pin):
    return halcmd("getp", pin)


def start(text, name="mb2hal"):
    Path("mb.ini").write_text(text)
    program = subprocess.Popen(["mb2hal", "config=mb.ini"], stderr=open("told", "a"))
    until(lambda: name in halcmd("list", "comp").split(), "loaded")
    return program


def end(program):
    program.send_signal(signal.SIGTERM)
    print("ends with", program.wait(20))


tcp, line = TcpDevice(), SerialDevice(7)
tcp.registers[5:7] = [65535, 12]
tcp.holding[100] = 40000
tcp.inputs[3] = True
line.coils[1] = True
print("== names of version 1.1")
program = start(f"""[MB2HAL_INIT]
INIT_DEBUG = 1
VERSION = 1.1
HAL_MODULE_NAME = mb
TOTAL_TRANSACTIONS = 9
[TRANSACTION_00]
LINK_TYPE = tcp
TCP_IP = 127.0.0.1
TCP_PORT = {tcp.port}
MB_SLAVE_ID = 1
FIRST_ELEMENT = 5
NELEMENTS = 2
MAX_UPDATE_RATE = 200
MB_RESPONSE_TIMEOUT_MS = 200
MB_TX_CODE = fnct_04_read_input_registers
HAL_TX_NAME = in
[TRANSACTION_01]
MB_TX_CODE = FNCT_03_READ_HOLDING_REGISTERS
FIRST_ELEMENT = 100
PIN_NAMES = speed,load
[TRANSACTION_02]
MB_TX_CODE = fnct_02_read_discrete_inputs
FIRST_ELEMENT = 2
NELEMENTS = 2
[TRANSACTION_03]
MB_TX_CODE = fnct_06_write_single_register
FIRST_ELEMENT = 20
NELEMENTS = 1
[TRANSACTION_04]
MB_TX_CODE = fnct_16_write_multiple_registers
FIRST_ELEMENT = 30
PIN_NAMES = a,b
[TRANSACTION_05]
LINK_TYPE = serial
SERIAL_PORT = {line.path}
SERIAL_BAUD = 19200
SERIAL_BITS = 8
SERIAL_PARITY = none
SERIAL_STOP = 1
MB_SLAVE_ID = 7
FIRST_ELEMENT = 0
NELEMENTS = 3
MB_TX_CODE = fnct_01_read_coils
MAX_UPDATE_RATE = 200
[TRANSACTION_06]
MB_TX_CODE = fnct_05_write_single_coil
FIRST_ELEMENT = 10
NELEMENTS = 1
[TRANSACTION_07]
MB_TX_CODE = fnct_15_write_multiple_coils
FIRST_ELEMENT = 12
NELEMENTS = 9
[TRANSACTION_08]
MB_TX_CODE = fnct_05_write_single_coil
FIRST_ELEMENT = 40
NELEMENTS = 2
""", "mb")
print(pins("mb.*"))
until(lambda: get("mb.in.00.float") == "65535" and get("mb.in.01.int") == "12" and get("mb.01.speed.float") == "40000",
      "registers are read")
until(lambda: get("mb.02.01.bit") == "TRUE" and get("mb.02.01.bit-inv") == "FALSE"
      and get("mb.02.00.bit-inv") == "TRUE", "inputs are read")
until(lambda: get("mb.05.01.bit") == "TRUE" and get("mb.05.02.bit") == "FALSE", "coils are read")
halcmd("setp", "mb.03.00.float", "12.9")
halcmd("setp", "mb.03.00.int", "5")
until(lambda: tcp.holding[20] == 17, "float and integer are added")
halcmd("setp", "mb.03.00.float", "70000")
until(lambda: tcp.holding[20] == 65535, "at most 65535")
halcmd("setp", "mb.03.00.float", "-8")
until(lambda: tcp.holding[20] == 65533, "negative numbers are 16 bits")
halcmd("setp", "mb.04.b.float", "nan")
halcmd("setp", "mb.04.a.int", "3")
until(lambda: tcp.holding[30:32] == [3, 0], "several registers")
halcmd("setp", "mb.06.00.bit", "1")
halcmd("setp", "mb.07.08.bit", "1")
until(lambda: line.coils[10:21] == [True, False] + [False] * 8 + [True], "coils are written")
until(lambda: int(get("mb.08.num_errors")) > 2 and get("mb.06.num_errors") == "0",
      "too many elements are an error, each time")
print("== faults")
tcp.silent = True
until(lambda: int(get("mb.in.num_errors")) > 0, "no answer")
tcp.silent = False
until(lambda: get("mb.in.num_errors") == "0", "an answer again")
tcp.size = 50
until(lambda: int(get("mb.01.num_errors")) > 1 and get("mb.in.num_errors") == "0", "refused: the others go on")
tcp.size = 200
until(lambda: get("mb.01.num_errors") == "0", "taken again")
port = tcp.port
tcp.stop()
until(lambda: int(get("mb.in.num_errors")) > 1, "the device went away")
until(lambda: get("mb.05.num_errors") == "0", "the other link goes on")
tcp.registers[5] = 77
tcp.start(port)
until(lambda: get("mb.in.00.float") == "77" and get("mb.in.num_errors") == "0", "it is back")
end(program)
print("== names of version 1.0, two devices on one address")
second = TcpDevice()
second.inputs[0] = True
program = start(f"""[MB2HAL_INIT]
SLOWDOWN = 0.001
TOTAL_TRANSACTIONS = 4
[TRANSACTION_00]
LINK_TYPE = TCP
TCP_IP = 127.0.0.1
TCP_PORT = {tcp.port}
MB_SLAVE_ID = 1
FIRST_ELEMENT = 0
NELEMENTS = 2
PIN_NAMES = first
MB_TX_CODE = fnct_15_write_multiple_coils
[TRANSACTION_01]
MB_TX_CODE = fnct_06_write_single_register
FIRST_ELEMENT = 50
NELEMENTS = 1
[TRANSACTION_02]
MB_TX_CODE = fnct_04_read_input_registers
FIRST_ELEMENT = 5
NELEMENTS = 1
[TRANSACTION_03]
TCP_PORT = {second.port}
MB_TX_CODE = fnct_02_read_discrete_inputs
FIRST_ELEMENT = 0
NELEMENTS = 1
""")
print(pins("mb2hal.*"))
halcmd("setp", "mb2hal.00.01", "1")
halcmd("setp", "mb2hal.01.00", "9")
until(lambda: tcp.coils[:2] == [False, True] and tcp.holding[50] == 9 and get("mb2hal.03.00") == "TRUE", "works")
end(program)
told = Path("told").read_text().splitlines()
print("told once:", [told.count(f"mb link_loop_and_logic ERR: {text}")
                     for text in ("01: Illegal data address", "08: Too many data")])
print("== mistakes")
GOOD = "[MB2HAL_INIT]\nTOTAL_TRANSACTIONS = 1\n[TRANSACTION_00]\nLINK_TYPE = tcp\nTCP_IP = 127.0.0.1\nMB_SLAVE_ID = 1\nFIRST_ELEMENT = 0\nNELEMENTS = 1\nMB_TX_CODE = fnct_03_read_holding_registers\n"


def refused(*words, text=None):
    if text is not None:
        Path("bad.ini").write_text(text)
    done = subprocess.run(["mb2hal", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=20)
    print(done.returncode, done.stderr.splitlines()[-1:] or "silent")


refused()
refused("file.ini")
refused("config=none.ini")
for old, new in (("TOTAL_TRANSACTIONS = 1\n", ""), ("TOTAL_TRANSACTIONS = 1", "TOTAL_TRANSACTIONS = 2"), ("tcp", "usb"),
                 ("tcp", "serial"), ("LINK_TYPE = tcp\n", ""), ("NELEMENTS = 1\n", ""),
                 ("NELEMENTS = 1", "NELEMENTS = 0"), ("FIRST_ELEMENT = 0\n", ""),
                 ("fnct_03_read_holding_registers", "fnct_01_read_coils"), ("MB_TX_CODE", "MB_CODE"),
                 ("MB_SLAVE_ID = 1\n", ""), ("MB_SLAVE_ID = 1", "MB_SLAVE_ID = x"),
                 ("NELEMENTS = 1", "MAX_UPDATE_RATE = -1\nNELEMENTS = 1"), ("NELEMENTS = 1", "PIN_NAMES = a,a")):
    refused("config=bad.ini", text=GOOD.replace(old, new))
