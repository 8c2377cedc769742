// SPDX-License-Identifier: GPL-2.0-or-later
//
// tool_watch.cc - program tool_watch: once a second the tool in the spindle and the one prepared.
// Source: tools sheet, section 3
#include <cstdio>

#include "client.hh"
#include "kerf_clock.h"
#include "tooldata.h"

int main(int argc, char **argv) {
    constexpr int64_t SECOND = 1'000'000'000;
    constexpr int HEADER_EVERY = 20, PATIENCE = 2;
    kerf_clock_join("tool_watch", KERF_CLOCK_PRIO_USER);
    EmcClient client(argc > 1 ? argv[1] : "");
    if (!client.valid() || tool_mmap_user() != 0) {
        fprintf(stderr, "tool_watch: no controller is running\n");
        return 1;
    }
    fprintf(stderr, "sizes: EMC_STAT %zu, EMC_IO_STAT %zu, EMC_TOOL_STAT %zu, tool record %zu\n", sizeof(EMC_STAT),
            sizeof(EMC_IO_STAT), sizeof(EMC_TOOL_STAT), sizeof(CANON_TOOL_TABLE));
    int bad = 0;
    unsigned long heartbeat = 0;
    for (int line = 0; bad <= PATIENCE; kerf_clock_sleep_ns(SECOND)) {
        NML &channel = client.status_channel();
        if (channel.peek() < 0 || channel.get_address()->_type != EMC_STAT_TYPE) {
            bad++;
            continue;
        }
        const EMC_STAT &s = static_cast<const EMC_STAT &>(*channel.get_address());
        bad = s.task.taskbeat == heartbeat ? bad + 1 : 0;
        heartbeat = s.task.taskbeat;
        CANON_TOOL_TABLE t = tooldata_entry_init();
        tooldata_get(&t, 0);
        if (line++ % HEADER_EVERY == 0)
            fprintf(stderr, "%8s %8s %6s %6s %8s %8s %8s %8s\n", "PrepIDX", "Spindle", "Tool", "Pocket", "Diam",
                    "X-off", "Y-off", "Z-off");
        fprintf(stderr, "%8d %8d %6d %6d %8.3f %8.3f %8.3f %8.3f\n", s.io.tool.pocketPrepped, s.io.tool.toolInSpindle,
                t.toolno, t.pocketno, t.diameter, t.offset.tran.x, t.offset.tran.y, t.offset.tran.z);
    }
    fprintf(stderr, "tool_watch: the controller gives no new status any more\n");
    return 0;
}
