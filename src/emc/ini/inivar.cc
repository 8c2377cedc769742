// SPDX-License-Identifier: GPL-2.0-or-later
//
// inivar.cc - the older spelling of inivalue: single-dash options, each at most once.
// Runs the inivalue that stands beside it (INI reference, section 3).

#include <cstdio>
#include <cstring>
#include <string>
#include <unistd.h>
#include <climits>

namespace
{
struct Option {
    const char *name;
    bool takes_argument;
    bool given;
    std::string value;
};
Option options[] = {
    {"-var", true, false, ""}, {"-sec", true, false, ""}, {"-num", true, false, ""},
    {"-tildeexpand", false, false, ""}, {"-ini", true, false, "emc.ini"}};
enum { VAR, SEC, NUM, TILDE, INI };

int fail(const std::string &text)
{
    fprintf(stderr, "inivar: %s\n", text.c_str());
    return 1;
}
} // namespace

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        Option *o = nullptr;
        for (auto &candidate : options)
            if (!strcmp(argv[i], candidate.name)) o = &candidate;
        if (!o) return fail("Invalid option '" + std::string(argv[i]) + "'");
        if (o->given) return fail("Duplicate " + std::string(o->name) + " option");
        o->given = true;
        if (!o->takes_argument) continue;
        if (++i >= argc) return fail("Missing argument to " + std::string(o->name));
        o->value = argv[i];
    }
    if (!options[VAR].given) return fail("No variable supplied (missing -var)");

    char self[PATH_MAX];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    if (n < 0) return fail("cannot find out where this program stands");
    self[n] = 0;
    std::string program = std::string(self, size_t(strrchr(self, '/') - self)) + "/inivalue";

    std::string var = "--var=" + options[VAR].value, sec = "--sec=" + options[SEC].value,
                num = "--num=" + options[NUM].value, tilde = "--tildeexpand";
    char *args[8];
    int count = 0;
    args[count++] = program.data();
    args[count++] = var.data();
    if (options[SEC].given) args[count++] = sec.data();
    if (options[NUM].given) args[count++] = num.data();
    if (options[TILDE].given) args[count++] = tilde.data();
    args[count++] = const_cast<char *>("--");
    args[count++] = options[INI].value.data();
    args[count] = nullptr;
    execv(args[0], args);
    return fail("cannot run " + program + ": " + strerror(errno));
}
