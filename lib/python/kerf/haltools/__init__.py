# SPDX-License-Identifier: GPL-2.0-or-later
"""Tools around HAL: halreport, hal-histogram, latency-test, -histogram and -plot.

Models (what is measured and computed) and views (Tk) are apart: every model works and is
tested without a screen.
"""
