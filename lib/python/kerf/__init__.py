# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of Kerf that its own programs share: launcher, program runner, INI checks."""
