#!/bin/bash
exec /usr/bin/python3 stubs.py
