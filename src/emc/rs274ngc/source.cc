/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * source.cc - see source.hh.
 *
 * Method: the window slides forward; a jump back inside it costs no read. A line
 *         that does not fit whole into the window is cut: such a line is an error
 *         anyway, and the rest of it is skipped by the reader.
 */
#include "source.hh"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace ngc
{

constexpr std::string_view MARK = "\xEF\xBB\xBF"; // of byte order: editors for Windows begin a text with it

LineSource::~LineSource() { close(); }

void LineSource::close()
{
    if (fd >= 0) ::close(fd);
    fd = -1;
    copy.reset();
    window_start = 0;
    filled = cursor = 0;
    at_end = false;
    line_number = 0;
}

void LineSource::open(std::shared_ptr<ProgramCopy> text)
{
    close();
    name = text->path();
    copy = std::move(text);
    if (window.size() != WINDOW) window.assign(WINDOW, 0);
}

bool LineSource::open(const std::string &path)
{
    close();
    name = path;
    fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return false;
    if (fstat(fd, &opened) != 0 || S_ISDIR(opened.st_mode)) {
        int why = S_ISDIR(opened.st_mode) ? EISDIR : errno;
        ::close(fd);
        fd = -1;
        errno = why;
        return false;
    }
    if (!S_ISREG(opened.st_mode)) return slurp();
    size_t wanted = WINDOW;
    wanted = std::min<size_t>(wanted, size_t(opened.st_size) + 4096);
    if (window.size() != wanted) window.assign(wanted, 0);
    return true;
}

// A pipe or device cannot be read twice at an offset: its whole text becomes the window.
bool LineSource::slurp()
{
    window.assign(WINDOW, 0);
    for (;;) {
        if (filled == window.size()) window.resize(window.size() * 2);
        ssize_t n = read(fd, window.data() + filled, window.size() - filled);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        filled += size_t(n);
    }
    at_end = true;
    return true;
}

// Moves what stands from keep_from on to the window's start and reads behind it.
bool LineSource::fill(size_t keep_from)
{
    size_t kept = filled - keep_from;
    if (keep_from > 0) {
        memmove(window.data(), window.data() + keep_from, kept);
        window_start += int64_t(keep_from);
        cursor -= keep_from;
        filled = kept;
    }
    if (filled == window.size()) return false;
    ssize_t n;
    do {
        char *to = window.data() + filled;
        const size_t room = window.size() - filled;
        const int64_t at = window_start + int64_t(filled);
        n = copy ? copy->read(to, room, at) : pread(fd, to, room, at);
    } while (n < 0 && errno == EINTR);
    if (n <= 0) {
        at_end = true;
        return false;
    }
    filled += size_t(n);
    return true;
}

// At the beginning of the text.
void LineSource::skip_mark()
{
    while (filled < MARK.size() && !at_end && fill(0)) {}
    if (std::string_view(window.data(), filled).substr(0, MARK.size()) == MARK) cursor = MARK.size();
}

bool LineSource::next(std::string_view &line, bool &had_newline)
{
    if (!is_open()) return false;
    if (window_start == 0 && cursor == 0) skip_mark();
    size_t scanned = cursor;
    for (;;) {
        const char *from = window.data() + scanned;
        const void *hit = filled > scanned ? memchr(from, '\n', filled - scanned) : nullptr;
        if (hit) {
            size_t end = size_t(static_cast<const char *>(hit) - window.data());
            line = std::string_view(window.data() + cursor, end - cursor);
            cursor = end + 1;
            had_newline = true;
            ++line_number;
            return true;
        }
        size_t pending = filled - cursor;
        if (at_end || !fill(cursor)) break;
        scanned = cursor + pending;
    }
    if (filled == cursor) return false;
    // The last line of a file without newline, or a line longer than the window.
    line = std::string_view(window.data() + cursor, filled - cursor);
    had_newline = false;
    cursor = filled;
    if (!at_end) { // longer than the window: give its beginning, skip the rest
        overlong.assign(line.substr(0, 1024));
        while (fill(cursor)) {
            const void *hit = memchr(window.data() + cursor, '\n', filled - cursor);
            if (hit) {
                cursor = size_t(static_cast<const char *>(hit) - window.data()) + 1;
                had_newline = true;
                break;
            }
            cursor = filled;
        }
        line = overlong;
    }
    ++line_number;
    return true;
}

void LineSource::seek(int64_t offset)
{
    if (offset >= window_start && offset <= window_start + int64_t(filled)) {
        cursor = size_t(offset - window_start);
        return;
    }
    window_start = offset;
    filled = cursor = 0;
    at_end = false;
}

bool LineSource::changed() const
{
    if (copy) return copy->changed();
    struct stat now;
    if (fd < 0) return false;
    if (stat(name.c_str(), &now) != 0) return true;
    return now.st_dev != opened.st_dev || now.st_ino != opened.st_ino || now.st_size != opened.st_size ||
           now.st_mtim.tv_sec != opened.st_mtim.tv_sec || now.st_mtim.tv_nsec != opened.st_mtim.tv_nsec;
}

} // namespace ngc
