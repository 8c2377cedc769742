#!/bin/bash
exec /usr/bin/python3 surface.py
