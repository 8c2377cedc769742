/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tool_mmap_read.cc - program tool_mmap_read: prints the tool records that task shares.
 * Source: tools sheet, section 3
 */
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tooldata.h"

namespace
{

int usage(const char *me)
{
    fprintf(
        stderr,
        "Usage: %s [nbegin [nend]]\n       prints the tool records nbegin to nend (default 0 to 10; limits 0 to %d)\n",
        me, CANON_POCKETS_MAX - 1);
    return 1;
}

} // namespace

int main(int argc, char **argv)
{
    int first = 0, last = 10;
    if (argc > 1) {
        if (strchr(argv[1], '-')) return usage(argv[0]);
        first = last = atoi(argv[1]);
    }
    if (argc > 2) last = atoi(argv[2]);
    if (first < 0 || last < first || last >= CANON_POCKETS_MAX) return usage(argv[0]);
    if (tool_mmap_user() != 0) {
        printf("No active mmapped tooldata file, bye\n");
        return 1;
    }
    const int most = tooldata_last_index_get();
    first = std::min(first, most);
    last = std::min(last, most);
    printf("%s idx: %d-->%d lastidx=%d (maxidx=%d) random_tc=%d\n", argv[0], first, last, most, CANON_POCKETS_MAX - 1,
           tool_mmap_is_random_toolchanger());
    printf("%5s %6s %6s %6s %6s %6s %6s %6s %6s %6s\n", "idx", "toolno", "pocket", "diam", "z-off", "y-off", "x-off",
           "f-ang", "b-ang", "orient");
    for (int idx = first; idx <= last; ++idx) {
        CANON_TOOL_TABLE t;
        if (tooldata_get(&t, idx) != IDX_OK) continue;
        printf("%5d %6d %6d %6.3f %6.3f %6.3f %6.3f %6.3f %6.3f %6d\n", idx, t.toolno, t.pocketno, t.diameter,
               t.offset.tran.z, t.offset.tran.y, t.offset.tran.x, t.frontangle, t.backangle, t.orientation);
    }
    return 0;
}
