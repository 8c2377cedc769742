#!/bin/bash
# Without a controller: what each call raises, and the values before the first poll.
exec /usr/bin/python3 calls.py
