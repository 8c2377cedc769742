#!/bin/bash
# The C library and the Python package must name the same segments.
for name in "" a mill-2 "with blank/slash" 12345678901234567890123456789012345678901234567; do
    KERF_INSTANCE=$name /usr/bin/python3 - <<'END'
import ctypes, os, sys
from kerf import instance
lib = ctypes.CDLL("liblinuxcnchal.so.0")
same = all(lib.kerf_instance_key(k) & 0xffffffff == instance.key(k) for k in (0, 1, 100, 1001, 0x48414c32))
print(repr(instance.name()), "agree" if same else "DIFFER")
END
done
