# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that a power cut leaves whole: how every Python program of ours writes what it keeps."""

import os

import kerf_tooltext


def replace(path, text, backup=True):
    """Writes a new file, syncs it and puts it in the place of the old one, which stays as FILE.bak if `backup`.

    text: bytes, or str (read with surrogateescape, bytes that were no UTF-8 come back). OSError: the old file is
    untouched.
    """
    data = text if isinstance(text, bytes) else text.encode("utf-8", "surrogateescape")
    kerf_tooltext.replace_file(os.fspath(path), data, backup)
