# SPDX-License-Identifier: GPL-2.0-or-later
"""The MTConnect agent: what the controller does, as XML over HTTP, MQTT and SHDR (reading only).

settings.py reads the INI file, items.py names the data items and takes their values, observations.py keeps
them, documents.py writes the XML, models.py gives meshes of the machine, servers.py answers; agent.py is
the program.
"""
