# SPDX-License-Identifier: GPL-2.0-or-later
"""Waiting and starting programs, in real or virtual time, for our Python programs.

A thin layer over the module kerf_clock (src/rtapi): a script that drives the controller
joins the clock, so that in virtual time nothing moves while it works.
"""

import os
import subprocess

import kerf_clock


def join(name, priority=100):
    """Takes part in the clock from now on; in real time this does nothing."""
    kerf_clock.join(name, priority)


def leave():
    kerf_clock.leave()


def suspend():
    """Time goes on without us until resume(): for waits that only the outside world ends."""
    kerf_clock.suspend()


def resume():
    kerf_clock.resume()


def now():
    """Seconds on the controller's clock."""
    return kerf_clock.now()


def sleep(seconds):
    """Waits on the controller's clock."""
    kerf_clock.sleep(seconds)


def wait_until(condition, timeout, step=0.01):
    """Polls until condition() is true. False after timeout seconds."""
    end = now() + timeout
    while not condition():
        if now() >= end:
            return False
        sleep(step)
    return True


def is_virtual():
    return kerf_clock.is_virtual()


def run(command, **options):
    """subprocess.run of a child that shares our place on the clock while we wait for it."""
    env = dict(options.pop("env", None) or os.environ)
    place = kerf_clock.lend()
    if place:
        env[kerf_clock.SLOT_ENV] = place
    else:
        env.pop(kerf_clock.SLOT_ENV, None)
    try:
        return subprocess.run(command, env=env, **options)
    finally:
        kerf_clock.reclaim()


def spawn(command, name, priority=100, **options):
    """subprocess.Popen of a child with a place of its own on the clock (held until it joins)."""
    env = dict(options.pop("env", None) or os.environ)
    place = kerf_clock.reserve(name, priority) if kerf_clock.joined() else ""
    if place:
        env[kerf_clock.SLOT_ENV] = place
    else:
        env.pop(kerf_clock.SLOT_ENV, None)
    try:
        child = subprocess.Popen(command, env=env, **options)
    except OSError:
        kerf_clock.unreserve(place)
        raise
    kerf_clock.reserved_for(place, child.pid)
    return child
