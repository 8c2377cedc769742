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
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <sys/stat.h>

#include "program_copy.hh"

namespace ngc
{

class LineSource
{
  public:
    LineSource() = default;
    ~LineSource();
    LineSource(const LineSource &) = delete;
    LineSource &operator=(const LineSource &) = delete;

    /// False: errno says why.
    bool open(const std::string &path);
    /// Reads a copy, which changes on disk do not reach.
    void open(std::shared_ptr<ProgramCopy> text);
    void close();
    bool is_open() const { return fd >= 0 || copy; }
    const std::string &path() const { return name; }
    /// What is read; null: the file itself.
    const std::shared_ptr<ProgramCopy> &read_copy() const { return copy; }

    /// The next line without its newline; the view is valid until the next call. False at the end.
    bool next(std::string_view &line, bool &had_newline);
    int64_t tell() const { return window_start + int64_t(cursor); }
    void seek(int64_t offset);

    int line_number = 0; ///< of the line last read, from 1; the caller sets it after seek()
    /// The file on disk is no longer what is read: another text than the copy, or another
    /// identity, size or time.
    bool changed() const;

  private:
    bool fill(size_t keep_from);
    bool slurp();
    void skip_mark();

    enum { WINDOW = 256 * 1024 };
    int fd = -1;
    std::shared_ptr<ProgramCopy> copy;
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
