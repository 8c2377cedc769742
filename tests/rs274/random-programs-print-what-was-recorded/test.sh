#!/bin/bash
# 400 generated programs, errors among them, against recordings of LinuxCNC 2.10.
exec /usr/bin/python3 ../compare.py -v ../golden.tbl ../golden-random.tar.xz
