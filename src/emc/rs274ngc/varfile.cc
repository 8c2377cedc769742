/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * varfile.cc - the parameter file: numbers that survive.
 *
 * In/Out: lines "NUMBER<tab>VALUE", ascending
 * Thread: [task]
 * Method: written to NAME.new, synced, the old file linked to NAME.bak, renamed.
 *         A file that could not be read whole is never overwritten.
 * Source: G-code sheet, section 4 "Var file"
 */
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>

#include <sys/stat.h>
#include <unistd.h>

#include "replace_file.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

bool required(int n)
{
    if (n < 5161) return false;
    if (n <= 5169) return true;
    if (n >= 5181 && n <= 5189) return true;
    if (n >= 5210 && n <= 5230) return true;
    return n > 5230 && n <= 5390 && n % 20 >= 1 && n % 20 <= 10;
}

// "NUMBER VALUE"; false when the line does not scan as two numbers.
bool parse_line(const char *line, int *number, double *value)
{
    char *end;
    errno = 0;
    long n = strtol(line, &end, 10);
    if (end == line || (*end != ' ' && *end != '\t')) return false;
    if (n > 1000000) n = 1000000;
    if (n < -1000000) n = -1000000;
    while (*end == ' ' || *end == '\t') ++end;
    const char *first = *end == '+' ? end + 1 : end;
    auto result = std::from_chars(first, first + strlen(first), *value);
    if (result.ec != std::errc()) return false;
    *number = int(n);
    return true;
}

// Calls take(number, value) for each line of the file. 0, or the number of the bad line.
template <class Take> int scan(FILE *f, Take take, const char **why)
{
    char line[256];
    int count = 0, last = 0;
    while (fgets(line, sizeof line, f)) {
        ++count;
        int number;
        double value;
        if (!parse_line(line, &number, &value)) continue;
        if (number < 1 || number > MAX_PARAMETER) {
            *why = "Parameter number out of range";
            return count;
        }
        if (number <= last) {
            *why = "Parameter file out of order";
            return count;
        }
        last = number;
        take(number, value);
    }
    return 0;
}

int write_file(Setup &s, const std::string &text)
{
    CHECK(!linuxcnc::replace_file(s.parameter_file, text, true), "Cannot open variable file");
    return INTERP_OK;
}

} // namespace

int load_parameters(Setup &s)
{
    s.parameter_file_bad = false;
    for (double &v : s.parameters) v = 0;
    if (s.parameter_file.empty()) {
        CHECK(s.options.task, "Parameter file name is missing");
        return INTERP_OK;
    }
    FILE *f = fopen(s.parameter_file.c_str(), "re");
    if (!f) {
        if (errno != ENOENT) perror(s.parameter_file.c_str());
        CHECK(errno != ENOENT, "Unable to open parameter file: '%s'", s.parameter_file.c_str());
        return INTERP_OK;
    }
    struct stat st;
    if (fstat(fileno(f), &st) == 0 && S_ISDIR(st.st_mode)) {
        fclose(f);
        s.parameter_file_bad = true;
        FAIL("Unable to open parameter file: '%s'", s.parameter_file.c_str());
    }
    std::vector<double> loaded(s.parameters.size(), 0.0);
    const char *why = nullptr;
    int entries = 0;
    int bad = scan(f, [&](int n, double v) { loaded[size_t(n)] = v, ++entries; }, &why);
    long size = ftell(f);
    fclose(f);
    if (bad) {
        s.parameter_file_bad = true;
        int result = s.fail(__func__, "%s", why);
        s.fault.file = s.parameter_file;
        s.fault.line = bad;
        s.fault.column = 0;
        s.fault.text.clear();
        s.fault.fix = "the file is left as it is; correct the line, or restore " + s.parameter_file + ".bak";
        return result;
    }
    s.parameters = std::move(loaded);
    if (entries == 0)
        fprintf(stderr, "%s: %s; all parameters start at 0%s\n", s.parameter_file.c_str(),
                size ? "no line holds a number and a value" : "the parameter file is empty",
                access((s.parameter_file + ".bak").c_str(), R_OK) == 0 ? " (the previous version is in .bak)" : "");
    return INTERP_OK;
}

int save_parameters(Setup &s)
{
    if (s.parameter_file.empty() || s.parameter_file_bad || s.parameters_read_only) return INTERP_OK;
    std::bitset<MAX_PARAMETER + 1> kept;
    for (int n = 1; n <= MAX_PARAMETER; ++n) kept[size_t(n)] = required(n);
    if (FILE *old = fopen(s.parameter_file.c_str(), "re")) {
        const char *why;
        int bad = scan(old, [&](int n, double) { kept[size_t(n)] = true; }, &why);
        fclose(old);
        CHECK(bad, "%s", why);
    }
    std::string text;
    for (int n = 1; n <= MAX_PARAMETER; ++n) {
        if (!kept[size_t(n)]) continue;
        char line[400];
        snprintf(line, sizeof line, "%d\t%f\n", n, parameter_now(s, n));
        for (char *c = line; *c; ++c)
            if (*c == ',') *c = '.'; // whatever the locale says
        text += line;
    }
    // Synchs are frequent and mostly change nothing.
    struct stat st;
    const bool there = stat(s.parameter_file.c_str(), &st) == 0;
    const bool untouched = there && st.st_mtim.tv_sec == s.parameter_file_time.tv_sec &&
                           st.st_mtim.tv_nsec == s.parameter_file_time.tv_nsec && st.st_ino == s.parameter_file_inode;
    if (untouched && text == s.parameter_file_text) return INTERP_OK;
    TRY(write_file(s, text));
    if (stat(s.parameter_file.c_str(), &st) == 0) {
        s.parameter_file_time = st.st_mtim;
        s.parameter_file_inode = st.st_ino;
        s.parameter_file_text = std::move(text);
    }
    return INTERP_OK;
}

} // namespace ngc
