/* SPDX-License-Identifier: GPL-2.0-or-later
 * Shared memory of a module: ids, counts, limits. */
#include "rtapi.h"
#include "rtapi_app.h"

int rtapi_app_main(void)
{
    void *a = 0, *b = 0;
    int module = rtapi_init("memory");
    int first = rtapi_shmem_new(0x1000, module, 5000), again = rtapi_shmem_new(0x1000, module, 9999999);
    rtapi_print("module id %s, segment id %s, same id %d\n", module > 0 ? "positive" : "BAD", first >= 0 ? "good" : "BAD",
                first == again);
    int got = rtapi_shmem_getptr(first, &a), got_again = rtapi_shmem_getptr(again, &b);
    rtapi_print("pointers %d %d %d\n", got, got_again, a == b);
    int zero = 1;
    for (int i = 0; i < 5000; i++) {
        zero &= ((char *)a)[i] == 0;
    }
    rtapi_print("zero %d, bad ids %d %d %d\n", zero, rtapi_shmem_getptr(64, &b), rtapi_shmem_getptr(-1, &b),
                rtapi_shmem_delete(40, module));
    int one = rtapi_shmem_delete(first, module), two = rtapi_shmem_delete(first, module);
    rtapi_print("delete %d %d %d\n", one, two, rtapi_shmem_delete(first, module));
    int count = 0, last, ids[64];
    while ((last = rtapi_shmem_new(0x2000 + count, module, 100)) >= 0 && count < 64) {
        ids[count++] = last;
    }
    rtapi_print("limit %s, then %d\n", count < 64 && count > 55 ? "reached" : "WRONG", last);
    while (count > 0) {
        rtapi_shmem_delete(ids[--count], module);
    }
    return rtapi_exit(module);
}

void rtapi_app_exit(void)
{
}
