/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * replace_file.cc - see replace_file.hh.
 */
#include "replace_file.hh"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace linuxcnc
{
namespace
{

bool write_all(int fd, const std::string &text)
{
    for (size_t done = 0; done < text.size();) {
        const ssize_t n = write(fd, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        done += size_t(n);
    }
    return true;
}

// A terminal, a pipe: nothing is kept there.
bool write_there(const std::string &place, const std::string &text)
{
    const int fd = open(place.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd < 0) return false;
    const bool good = write_all(fd, text);
    const int why = errno;
    close(fd);
    errno = why;
    return good;
}

} // namespace

bool replace_file(const std::string &filename, const std::string &text, bool backup)
{
    std::string place = filename;
    if (char *real = realpath(filename.c_str(), nullptr)) {
        place = real;
        free(real);
    }
    mode_t mode = 0644;
    struct stat st;
    const bool there = stat(place.c_str(), &st) == 0;
    if (there && S_ISDIR(st.st_mode)) {
        errno = EISDIR;
        return false;
    }
    if (there && !S_ISREG(st.st_mode)) return write_there(place, text);
    if (there) mode = st.st_mode & 0777;
    const std::string fresh = place + ".new", old = place + ".bak";
    const int fd = open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
    if (fd < 0) return false;
    if (there && fchown(fd, st.st_uid, st.st_gid) != 0) {
        // only root can give a file back to its owner
    }
    bool good = write_all(fd, text) && fchmod(fd, mode) == 0 && fsync(fd) == 0;
    int why = errno;
    good = close(fd) == 0 && good;
    if (good && backup) {
        unlink(old.c_str());
        if (link(place.c_str(), old.c_str()) != 0 && errno != ENOENT)
            fprintf(stderr, "can't keep the old file as %s: %s\n", old.c_str(), strerror(errno));
    }
    if (good && rename(fresh.c_str(), place.c_str()) != 0) {
        good = false;
        why = errno;
    }
    if (!good) {
        unlink(fresh.c_str());
        errno = why;
        return false;
    }
    const size_t slash = place.find_last_of('/');
    const int dir = open(slash == place.npos ? "."
                         : slash == 0        ? "/"
                                             : place.substr(0, slash).c_str(),
                         O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (dir >= 0) {
        fsync(dir); // the name too is on the disk
        close(dir);
    }
    return true;
}

} // namespace linuxcnc
