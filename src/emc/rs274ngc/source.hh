/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * source.hh - a program file, read by lines from a window of bounded size.
 *
 * In:     a path
 * Out:    lines with their offsets; memory does not depend on the file's length
 * Thread: [task]
 */
#ifndef KERF_SOURCE_HH
#define KERF_SOURCE_HH

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <sys/stat.h>

namespace ngc
{

class LineSource
{
  public:
    LineSource() = default;
    ~LineSource();
    LineSource(const LineSource &) = delete;
    LineSource &operator=(const LineSource &) = delete;

    /// False: errno says why. snapshot: a copy without a name is read, so that changes on
    /// disk do not reach it.
    bool open(const std::string &path, bool snapshot = false);
    void close();
    bool is_open() const { return fd >= 0; }
    const std::string &path() const { return name; }

    /// The next line without its newline; the view is valid until the next call. False at the end.
    bool next(std::string_view &line, bool &had_newline);
    int64_t tell() const { return window_start + int64_t(cursor); }
    void seek(int64_t offset);

    int line_number = 0; ///< of the line last read, from 1; the caller sets it after seek()
    /// The file's identity, size or time differ from those at open().
    bool changed() const;

  private:
    bool fill(size_t keep_from);
    bool slurp();
    bool copy_aside();

    enum { WINDOW = 256 * 1024 };
    int fd = -1;
    std::string name;
    std::vector<char> window;
    int64_t window_start = 0; // file offset of window[0]
    size_t filled = 0, cursor = 0;
    std::string overlong;
    bool at_end = false; // the window's end is the file's end
    struct stat opened = {};
};

} // namespace ngc

#endif
