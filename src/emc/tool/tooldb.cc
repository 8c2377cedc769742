/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tooldb.cc - a program that keeps the tools in place of the file ([EMCIO]DB_PROGRAM).
 *
 * In/Out: lines over two pipes; each reply within 10 s
 * Thread: [task]
 * Source: tools sheet, section 11
 */
#include "tooldb.hh"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tooldata.h"
#include "replace_file.hh"
#include "tooltext.hh"

namespace
{

enum { MAX_ARGUMENTS = 10, REPLY_MS = 10000 };

struct Database {
    tooldb_t mode = DB_NOTUSED;
    pid_t child = -1;
    int to = -1, from = -1;
    std::string pending; // received, not yet a whole line
    std::string program;
    bool shown = false; // the first load has been printed
    bool random = false;
} db;

void stop(const char *why)
{
    if (why) fprintf(stderr, "!!!! %s: %s\n", db.program.c_str(), why);
    if (db.to >= 0) close(db.to);
    if (db.from >= 0) close(db.from);
    db.to = db.from = -1;
    db.mode = DB_NOTUSED;
    if (db.child > 0) {
        int status;
        if (waitpid(db.child, &status, WNOHANG) == db.child) {
            if (WIFSIGNALED(status)) fprintf(stderr, "!!!! %s: signal %d\n", db.program.c_str(), WTERMSIG(status));
            else fprintf(stderr, "!!!! %s: exit status %d\n", db.program.c_str(), WEXITSTATUS(status));
        }
    }
    db.child = -1;
}

bool send_line(const std::string &line)
{
    if (getenv("DB_DEBUG")) fprintf(stderr, "SEND: %s", line.c_str());
    size_t done = 0;
    while (done < line.size()) {
        const ssize_t n = write(db.to, line.data() + done, line.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        done += size_t(n);
    }
    return true;
}

bool receive_line(std::string *line)
{
    for (;;) {
        const size_t newline = db.pending.find('\n');
        if (newline != db.pending.npos) {
            *line = db.pending.substr(0, newline + 1);
            db.pending.erase(0, newline + 1);
            if (getenv("DB_DEBUG")) fprintf(stderr, "RECV: %s", line->c_str());
            return line->size() >= 2;
        }
        struct pollfd p = {db.from, POLLIN, 0};
        if (poll(&p, 1, REPLY_MS) <= 0) return false;
        char buf[4096];
        const ssize_t n = read(db.from, buf, sizeof buf);
        if (n <= 0) return false;
        db.pending.append(buf, size_t(n));
    }
}

} // namespace

int tooldata_db_active(void) { return db.mode == DB_ACTIVE; }
const char *tooldb_program() { return db.program.c_str(); }

int tooldb_save_spindle()
{
    if (!db.random) return 0;
    CANON_TOOL_TABLE t;
    if (tooldata_get(&t, 0) != IDX_OK) return -1;
    char line[CANON_TOOL_ENTRY_LEN];
    tooldata_format_toolline(0, 1, t, line);
    return linuxcnc::replace_file("./db_spindle.tbl", line, false) ? 0 : -1;
}

void tooldata_set_db(tooldb_t mode)
{
    if (mode == DB_NOTUSED && db.mode == DB_ACTIVE) stop(nullptr);
    db.mode = mode;
}

int tooldata_db_init(const char *program_with_args, int random_toolchanger)
{
    stop(nullptr);
    db.random = random_toolchanger;
    std::string text = program_with_args;
    std::vector<char *> args;
    char *save = nullptr;
    for (char *word = strtok_r(text.data(), " ", &save); word; word = strtok_r(nullptr, " ", &save))
        args.push_back(word);
    if (args.empty()) return -1;
    db.program = args[0];
    if (args.size() >= MAX_ARGUMENTS) {
        fprintf(stderr, "!!!!db_init: argc exceeds MAX_DB_PROGRAM_ARGS=%d\n", MAX_ARGUMENTS);
        return -1;
    }
    if (access(args[0], X_OK) != 0) {
        fprintf(stderr, "!!!!db_init: <%s> not executable\n", args[0]);
        return -1;
    }
    args.push_back(nullptr);
    int down[2], up[2];
    if (pipe2(down, O_CLOEXEC) != 0) return -1;
    if (pipe2(up, O_CLOEXEC | O_DIRECT) != 0) {
        close(down[0]), close(down[1]);
        return -1;
    }
    signal(SIGPIPE, SIG_IGN);
    db.child = fork();
    if (db.child == 0) {
        dup2(down[0], 0);
        dup2(up[1], 1);
        execv(args[0], args.data());
        _exit(127);
    }
    close(down[0]);
    close(up[1]);
    db.to = down[1];
    db.from = up[0];
    db.pending.clear();
    if (db.child < 0) {
        stop(strerror(errno));
        return -1;
    }
    fprintf(stderr, "====Waiting for v2.1 version reply from %s\n", args[0]);
    std::string version;
    if (!receive_line(&version)) {
        stop("no version reply");
        return -1;
    }
    while (!version.empty() && (version.back() == '\n' || version.back() == '\r')) version.pop_back();
    if (version != "v2.1") {
        fprintf(stderr, "!!!! db_version MISMATCH require:v2.1 received:%s\n", version.c_str());
        stop(nullptr);
        return -1;
    }
    fprintf(stderr, "====Connected to %s\n", args[0]);
    db.mode = DB_ACTIVE;
    return 0;
}

int tooldata_db_getall(void)
{
    if (db.mode != DB_ACTIVE) return -1;
    const bool show = !db.shown || getenv("DB_SHOW");
    db.shown = true;
    if (!send_line("g\n")) {
        stop("request failed");
        return -1;
    }
    for (;;) {
        std::string line;
        if (!receive_line(&line)) {
            stop("no reply");
            return -1;
        }
        if (line.find("FINI") != line.npos) break;
        if (show) fprintf(stderr, "GET:   %s", line.c_str());
        if (tooldata_read_entry(line.c_str()) < 0) {
            fprintf(stderr, "!!!tooldata_db_getall %s", line.c_str());
            return -1;
        }
    }
    tooldb_save_spindle();
    return 0;
}

int tooldata_db_notify(tool_notify_t type, int toolno, int pocketno, CANON_TOOL_TABLE rec)
{
    if (db.mode != DB_ACTIVE) return 0;
    std::string line;
    if (type == TOOL_OFFSET) {
        char text[CANON_TOOL_ENTRY_LEN];
        tooldata_format_toolline(pocketno, 0, rec, text);
        line = std::string("p ") + text;
    } else {
        line = std::string(type == SPINDLE_LOAD ? "l" : "u") + " T" + std::to_string(toolno) + " P" +
               std::to_string(pocketno) + " \n";
        if (db.random) tooldb_save_spindle();
    }
    std::string reply;
    if (!send_line(line) || !receive_line(&reply)) {
        stop("no reply");
        return -1;
    }
    if (reply.find("NAK") != reply.npos) fprintf(stderr, "!!!! %s", reply.c_str());
    return 0;
}
