# SPDX-License-Identifier: GPL-2.0-or-later
"""The operator's screen: model (status and commands), view (widgets), bindings (keys and actions)."""
