# SPDX-License-Identifier: GPL-2.0-or-later
# A probe move that ends without contact is an error from its end on, also where a cycle of motion is many of task's.
from mill import *

on()
wrong = []
for n in range(60):
    result = mdi(f"G38.2 Z{-0.05 * (n % 7) - 0.013} F3000", 20)
    texts = messages()
    if result != RCS_ERROR or texts != ["G38.2 move finished without making contact."] or s.probing:
        wrong.append((n, result, texts))
print("no contact:", wrong[:3], len(wrong))
