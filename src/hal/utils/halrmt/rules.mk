# SPDX-License-Identifier: GPL-2.0-or-later
# halrmt: HAL over TCP.
$(eval $(call program,halrmt,$(addprefix src/hal/utils/halrmt/,main.cc server.cc commands.cc) $(addprefix src/hal/utils/halcmd/,text.cc \
	session.cc table.cc format.cc config.cc load.cc rtapi_client.cc snapshot.cc show.cc save.cc json.cc graph.cc),linuxcnchal linuxcncini))
