// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_config.hh - the .nml file: B (buffer) and P (process) lines. [task]
#ifndef KERF_NML_CONFIG_HH
#define KERF_NML_CONFIG_HH

#include <optional>
#include <string>
#include <vector>

namespace nml {

enum class BufferKind { shmem, locmem, phantom };
enum class ProcessKind { local, remote, automatic, phantom };
enum class Coding { xdr, disp, raw }; // raw: as in memory, for computers of one kind
enum class Lock { os_sem, none, refused };

struct BufferLine {
    std::string name, host;
    BufferKind kind = BufferKind::shmem;
    long size = 0;          // bytes, with name, connection table and header
    bool neutral = false;   // data stands encoded in the buffer
    int number = 0;         // identifies the buffer on its TCP port
    int max_procs = 1;
    int key = 0;            // SysV key before it is mapped to the instance
    bool queue = false, diag = false, split = false, serial = false, confirm_write = false;
    bool autocnum = false, udp = false;
    Coding coding = Coding::xdr;
    Lock lock = Lock::os_sem;
    int tcp_port = 0;
    int subdivisions = 1;
    long enc_max_size = 0;
    int bsem = -1;
    double poll_interval = 0.02; // s, blocking read of a remote buffer
    int force_type = 0;
    double version = 0;
    std::string passwd;     // file with the logins of remote clients; empty: none needed
};

struct ProcessLine {
    std::string name, host;
    ProcessKind kind = ProcessKind::local;
    bool read = true, write = true;
    int server = 0;
    double timeout = -1; // s, < 0: for ever
    bool master = false;
    int cnum = 0;
};

struct Connection {
    BufferLine buffer;
    ProcessLine process;
    std::string login_name, login_password; // for the server; empty: those of buffer.passwd
};

// Looks the connection up; on failure prints the reason (if verbose) and returns nothing.
std::optional<Connection> find_connection(const std::string &file, const std::string &buffer,
                                          const std::string &process);

// All B lines of a file, in order; empty when it cannot be read.
std::vector<BufferLine> buffers_of(const std::string &file);

} // namespace nml
#endif
