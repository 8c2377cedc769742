/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rs274_expect.hh - what the unit tests of the interpreter share: expectations, and a main part.
 */
#ifndef KERF_RS274_EXPECT_HH
#define KERF_RS274_EXPECT_HH

#include <cstdio>
#include <cstdlib>
#include <initializer_list>

#include <unistd.h>

inline int failures = 0;

#define EXPECT(condition) \
    do { \
        if (!(condition)) { \
            printf("%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            ++failures; \
        } \
    } while (0)

struct UnitTest {
    const char *name;
    void (*run)();
};

/// In a scratch folder: one line for each test. Exit status 1 when one fails.
inline int run_tests(std::initializer_list<UnitTest> tests)
{
    char dir[] = "/tmp/interp-unit.XXXXXX";
    if (!mkdtemp(dir) || chdir(dir) != 0) return 1;
    for (const UnitTest &t : tests) {
        const int before = failures;
        t.run();
        printf("%s: %s\n", failures == before ? "ok" : "FAILED", t.name);
    }
    if (chdir("/") == 0) rmdir(dir);
    return failures ? 1 : 0;
}

#endif
