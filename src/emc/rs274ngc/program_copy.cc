/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * program_copy.cc - see program_copy.hh.
 *
 * Method: short texts stay in memory, long ones go to a file without a name beside the
 *         other temporary files, or to memory when there is no room. The hash is made on the way.
 *         Whether the file changed is seen by its identity, size and times, and found out by
 *         the hash where these differ or can not be trusted: times of a write that is just
 *         over, and of other computers.
 */
#include "program_copy.hh"

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include <fcntl.h>
#include <linux/magic.h>
#include <openssl/evp.h>
#include <sys/mman.h>
#include <sys/vfs.h>
#include <time.h>
#include <unistd.h>

namespace ngc
{
namespace
{

constexpr size_t PIECE = 256 * 1024;
constexpr int64_t SETTLED_S = 2; // the coarsest clock of a local file system

ssize_t read_some(int fd, char *to, size_t length)
{
    ssize_t n;
    do n = read(fd, to, length);
    while (n < 0 && errno == EINTR);
    return n;
}

bool same(const struct stat &a, const struct stat &b)
{
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size &&
           a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec &&
           a.st_ctim.tv_sec == b.st_ctim.tv_sec && a.st_ctim.tv_nsec == b.st_ctim.tv_nsec;
}

// The times are of this computer's clock, and every later write gets another one.
bool times_settled(int fd, const struct stat &st)
{
    const uint32_t remote[] = {NFS_SUPER_MAGIC,  SMB_SUPER_MAGIC,  CIFS_SUPER_MAGIC,
                               SMB2_SUPER_MAGIC, FUSE_SUPER_MAGIC, V9FS_MAGIC};
    struct statfs fs;
    if (fstatfs(fd, &fs) != 0) return false;
    for (uint32_t type : remote)
        if (uint32_t(fs.f_type) == type) return false;
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    const int64_t written = std::max<int64_t>(st.st_mtim.tv_sec, st.st_ctim.tv_sec);
    return now.tv_sec > written + SETTLED_S;
}

} // namespace

Sha256::Sha256() : context(EVP_MD_CTX_new())
{
    EVP_DigestInit_ex(static_cast<EVP_MD_CTX *>(context), EVP_sha256(), nullptr);
}

Sha256::~Sha256() { EVP_MD_CTX_free(static_cast<EVP_MD_CTX *>(context)); }

void Sha256::add(const char *text, size_t length)
{
    EVP_DigestUpdate(static_cast<EVP_MD_CTX *>(context), text, length);
}

std::string Sha256::hex()
{
    unsigned char sum[EVP_MAX_MD_SIZE];
    unsigned int n = 0;
    EVP_DigestFinal_ex(static_cast<EVP_MD_CTX *>(context), sum, &n);
    std::string digits;
    for (unsigned int i = 0; i < n; ++i) {
        digits += "0123456789abcdef"[sum[i] >> 4];
        digits += "0123456789abcdef"[sum[i] & 15];
    }
    return digits;
}

// ---- one file ---------------------------------------------------------------------------

ProgramCopy::~ProgramCopy()
{
    if (source >= 0) close(source);
    if (file >= 0) close(file);
}

std::shared_ptr<ProgramCopy> ProgramCopy::begin(const std::string &path)
{
    std::shared_ptr<ProgramCopy> copy(new ProgramCopy);
    copy->name = path;
    copy->source = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (copy->source < 0 || fstat(copy->source, &copy->seen) != 0) return nullptr;
    if (S_ISDIR(copy->seen.st_mode)) {
        errno = EISDIR;
        return nullptr;
    }
    if (copy->seen.st_size > IN_MEMORY && !copy->make_room()) return nullptr;
    return copy;
}

std::shared_ptr<ProgramCopy> ProgramCopy::of(const std::string &path)
{
    std::shared_ptr<ProgramCopy> copy = begin(path);
    int more = copy ? 1 : -1;
    while (more > 0) more = copy->step(PIECE);
    return more == 0 ? copy : nullptr;
}

// A place for a long text: on disk, else in memory.
bool ProgramCopy::make_room()
{
    const char *dir = getenv("TMPDIR");
    file = open(dir && *dir ? dir : "/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0 && fallocate(file, 0, 0, seen.st_size) != 0 && errno != EOPNOTSUPP) {
        close(file);
        file = -1;
    }
    if (file < 0) file = memfd_create("program", MFD_CLOEXEC);
    return file >= 0;
}

int ProgramCopy::step(size_t bytes)
{
    std::vector<char> piece(PIECE);
    while (bytes > 0 && source >= 0) {
        const ssize_t n = read_some(source, piece.data(), std::min(bytes, piece.size()));
        if (n < 0) return -1;
        if (n == 0) {
            sum = hasher.hex();
            settled = times_settled(source, seen);
            close(source);
            source = -1;
            break;
        }
        hasher.add(piece.data(), size_t(n));
        if (file < 0) text.append(piece.data(), size_t(n)); // of a pipe: whatever comes
        for (ssize_t done = 0; file >= 0 && done < n;) {
            const ssize_t w = pwrite(file, piece.data() + done, size_t(n - done), length + done);
            if (w < 0 && errno != EINTR) return -1;
            done += std::max<ssize_t>(w, 0);
        }
        length += n;
        bytes -= size_t(n);
    }
    return source >= 0 ? 1 : 0;
}

ssize_t ProgramCopy::read(char *to, size_t most, int64_t at) const
{
    if (file >= 0) return pread(file, to, most, at);
    if (at >= int64_t(text.size())) return 0;
    return ssize_t(text.copy(to, most, size_t(at)));
}

bool ProgramCopy::changed()
{
    if (!S_ISREG(seen.st_mode)) return false; // a pipe gives its text once
    const int fd = open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return true;
    struct stat now;
    bool other = fstat(fd, &now) != 0 || (now.st_size != length);
    if (!other && !(settled && same(now, seen))) {
        const bool trusted = times_settled(fd, now);
        std::vector<char> piece(PIECE);
        Sha256 fresh;
        ssize_t n;
        while ((n = read_some(fd, piece.data(), piece.size())) > 0) fresh.add(piece.data(), size_t(n));
        other = n < 0 || fresh.hex() != sum;
        if (!other) {
            seen = now;
            settled = trusted;
        }
    }
    close(fd);
    return other;
}

// ---- a program with what it calls -------------------------------------------------------

void ProgramCopies::set_program(std::shared_ptr<ProgramCopy> program)
{
    main = std::move(program);
    called.clear();
}

std::shared_ptr<ProgramCopy> ProgramCopies::get(const std::string &path)
{
    if (main && main->path() == path) return main;
    Called &entry = called[path];
    if (!entry.copy || (!keep_called && entry.copy->changed())) entry.copy = ProgramCopy::of(path);
    if (!entry.copy) {
        const int why = errno;
        called.erase(path);
        errno = why;
        return nullptr;
    }
    return entry.copy;
}

std::vector<std::string> ProgramCopies::news()
{
    std::vector<std::string> paths;
    if (!keep_called) return paths;
    for (auto &[path, entry] : called) {
        if (entry.told || !entry.copy->changed()) continue;
        entry.told = true;
        paths.push_back(path);
    }
    return paths;
}

std::string ProgramCopies::changed()
{
    if (main && main->changed()) return main->path();
    if (keep_called)
        for (auto &[path, entry] : called)
            if (entry.copy->changed()) return path;
    return {};
}

} // namespace ngc
