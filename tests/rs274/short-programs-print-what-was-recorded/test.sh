#!/bin/bash
# 1677 short generated programs, half of them with an error (all kinds of words on all kinds of codes,
# compensated paths, threads, splines, contour cycles, comments, expressions, O words), against
# recordings of LinuxCNC 2.9 where 2.10 does the same.
exec /usr/bin/python3 ../compare.py -v ../golden.tbl ../golden-short.tar.xz ../golden-kinds.tar.xz
