/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * subfiles.cc - which file holds a called sub, and the files that are open.
 *
 * Method: files of calls under way stay open; a few more are kept for the next call. Task
 *         reads copies: a program has those of its first calls, an MDI line what is on disk now.
 * Thread: [task]
 * Source: O-word sheet, section 3 "File search"
 */
#include <cerrno>
#include <cstdlib>

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include "stages.hh"

namespace ngc
{
namespace
{

bool is_file(const std::string &path)
{
    struct stat st;
    return stat(path.c_str(), &st) == 0 && !S_ISDIR(st.st_mode);
}

std::string in_tree(const std::string &root, const std::string &name, int depth)
{
    const std::string here = root + "/" + name;
    if (is_file(here)) return here;
    if (depth == 0) return {};
    DIR *dir = opendir(root.c_str());
    if (!dir) return {};
    std::string found;
    while (struct dirent *e = readdir(dir)) {
        if (e->d_name[0] == '.') continue;
        const std::string sub = root + "/" + e->d_name;
        struct stat st;
        if (stat(sub.c_str(), &st) != 0 || !S_ISDIR(st.st_mode)) continue;
        found = in_tree(sub, name, depth - 1);
        if (!found.empty()) break;
    }
    closedir(dir);
    return found;
}

} // namespace

std::string expand_path(const std::string &path)
{
    if (path.empty() || path[0] != '~') return path;
    return linuxcnc::IniFile::tildeExpand(path).value_or(path);
}

std::string find_sub_file(const Setup &s, const std::string &name)
{
    if (name.empty()) return {};
    const std::string file = expand_path(name + ".ngc");
    if (is_file(file)) return file;
    if (file[0] == '/') return {};
    if (!s.program_prefix.empty()) {
        const std::string path = s.program_prefix + "/" + file;
        if (is_file(path)) return path;
    }
    for (const std::string &dir : s.sub_path) {
        const std::string path = dir + "/" + file;
        if (is_file(path)) return path;
    }
    return s.wizard_root.empty() ? std::string() : in_tree(s.wizard_root, file, 8);
}

bool open_file(Setup &s, LineSource &file, const std::string &path, bool now)
{
    if (!s.options.copies) return file.open(path);
    std::shared_ptr<ProgramCopy> copy = now ? ProgramCopy::of(path) : s.options.copies->get(path);
    if (!copy) return false;
    file.open(std::move(copy));
    return true;
}

namespace
{

bool in_use(const Setup &s, int i)
{
    bool found = i == s.source;
    for (int level = 0; level < s.call_level; ++level) found = found || s.frames[level].source == i;
    return found;
}

// Its labels are not known any more: they must be found again.
void forget_labels(Setup &s, int i)
{
    for (auto &entry : s.labels)
        if (entry.value.source == i) entry.value.source = -2;
}

} // namespace

bool is_current(Setup &s, int i)
{
    const LineSource &file = *s.sources[size_t(i)];
    if (!s.options.copies || i == 0 || in_use(s, i)) return true;
    return s.mdi ? !file.changed() : file.read_copy() == s.options.copies->get(file.path());
}

int open_source(Setup &s, const std::string &path)
{
    for (size_t i = 0; i < s.sources.size(); ++i) {
        if (!s.sources[i]->is_open() || s.sources[i]->path() != path) continue;
        if (is_current(s, int(i))) return int(i);
        forget_labels(s, int(i));
        return open_file(s, *s.sources[i], path, s.mdi) ? int(i) : -1;
    }
    auto fresh = std::make_unique<LineSource>();
    if (!open_file(s, *fresh, path, s.mdi)) return -1;
    // Keep a bounded number open: the program, those in the call stack, and some more.
    enum { KEPT = 32 };
    if (s.sources.size() >= KEPT) {
        for (size_t i = 1; i < s.sources.size(); ++i) {
            if (in_use(s, int(i))) continue;
            forget_labels(s, int(i));
            s.sources[i] = std::move(fresh);
            return int(i);
        }
    }
    if (s.sources.empty()) s.sources.push_back(std::make_unique<LineSource>()); // 0 is the program's place
    s.sources.push_back(std::move(fresh));
    return int(s.sources.size()) - 1;
}

} // namespace ngc
