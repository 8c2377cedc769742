/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * program_copy.hh - the text of a program as it was when it was opened: what is executed,
 * shown and compared, whatever happens to the file.
 *
 * In:     a path
 * Out:    the text, its SHA-256, whether the file on disk holds another text by now
 * Thread: [task]; reads files, so it may wait for a disk
 */
#ifndef KERF_PROGRAM_COPY_HH
#define KERF_PROGRAM_COPY_HH

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <sys/types.h>

namespace ngc
{

/// SHA-256, piece by piece.
class Sha256
{
  public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256 &) = delete;
    Sha256 &operator=(const Sha256 &) = delete;
    void add(const char *text, size_t length);
    std::string hex(); ///< once, at the end: 64 digits

  private:
    void *context;
};

class ProgramCopy
{
  public:
    /// Opens a file to be copied. Null: errno says why.
    static std::shared_ptr<ProgramCopy> begin(const std::string &path);
    /// Opens and copies. Null: errno says why.
    static std::shared_ptr<ProgramCopy> of(const std::string &path);
    ~ProgramCopy();
    ProgramCopy(const ProgramCopy &) = delete;
    ProgramCopy &operator=(const ProgramCopy &) = delete;

    /// Copies at most so many bytes; 1 there is more, 0 done, -1 failed: errno says why.
    int step(size_t bytes);

    // ---- when it is done ----
    const std::string &path() const { return name; }
    const std::string &hash() const { return sum; } ///< SHA-256, 64 hexadecimal digits
    /// As pread(2).
    ssize_t read(char *to, size_t length, int64_t at) const;
    /// The file is gone or holds another text. It is read only when it may have been written
    /// since this was last found out; a new time alone is no change.
    bool changed();

  private:
    ProgramCopy() = default;
    bool make_room();

    enum { IN_MEMORY = 1024 * 1024 }; // texts up to here, larger ones are in a file without a name
    std::string name, sum, text;
    int source = -1, file = -1;
    int64_t length = 0;
    Sha256 hasher;
    struct stat seen = {};
    bool settled = false; // a write after `seen` would show in the file's times
};

/// The program that is open and the files that it has called so far.
class ProgramCopies
{
  public:
    /// false: each call of a file takes what is on disk then ([RS274NGC]CALLED_FILES = FRESH).
    bool keep_called = true;

    void set_program(std::shared_ptr<ProgramCopy> program);
    const std::shared_ptr<ProgramCopy> &program() const { return main; }
    /// Of a file: the one made first, or a new one. Null: errno says why.
    std::shared_ptr<ProgramCopy> get(const std::string &path);
    /// Paths of called files that hold another text now and were not told before.
    std::vector<std::string> news();
    /// Path of the program or a called file that holds another text now; empty: none.
    std::string changed();

  private:
    struct Called {
        std::shared_ptr<ProgramCopy> copy;
        bool told = false;
    };
    std::shared_ptr<ProgramCopy> main;
    std::map<std::string, Called> called;
};

} // namespace ngc

#endif
