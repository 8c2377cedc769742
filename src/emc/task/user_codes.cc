// SPDX-License-Identifier: GPL-2.0-or-later
//
// user_codes.cc - see user_codes.hh.
#include "user_codes.hh"

#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "kerf_clock.h"
#include "messages.hh"
#include "rcs_print.hh"

void UserCodes::scan(const linuxcnc::IniFile &ini, unsigned debug) {
    std::vector<std::string> dirs;
    auto add = [&](const std::string &dir) {
        auto full = linuxcnc::IniFile::tildeExpand(dir);
        if (full && !full->empty()) dirs.push_back(*full);
    };
    add(ini.findStringV("PROGRAM_PREFIX", "DISPLAY", "nc_files"));
    if (auto path = ini.findString("USER_M_PATH", "RS274NGC")) {
        std::vector<std::string> parts = linuxcnc::IniFile::split(":", *path);
        for (size_t i = 0; i < parts.size() && i < 5; i++) add(parts[i]);
    }
    for (int n = 0; n < 100; n++) {
        path_[static_cast<size_t>(n)].clear();
        for (const std::string &dir : dirs) {
            char name[16];
            snprintf(name, sizeof name, "M1%02d", n);
            std::string file = dir + "/" + name;
            struct stat st;
            if (file.size() > 255 || stat(file.c_str(), &st) != 0 || S_ISDIR(st.st_mode)) continue;
            if (!(st.st_mode & S_IXUSR)) {
                if (debug & EMC_DEBUG_CONFIG) rcs_print("not a program, its owner may not run it: %s\n", file.c_str());
                continue;
            }
            path_[static_cast<size_t>(n)] = file;
            break;
        }
    }
}

std::string UserCodes::command(int num, double p, double q) const {
    char words[100];
    snprintf(words, sizeof words, " %f %f", p, q);
    const std::string &file = path_[static_cast<size_t>(num)];
    return (file.find(' ') == std::string::npos ? file : "\"" + file + "\"") + words;
}

bool Child::start(const char *command_line) {
    std::vector<std::string> words;
    std::string word;
    bool quoted = false, any = false;
    for (const char *c = command_line;; c++) {
        if (*c == '"') { quoted = !quoted; any = true; continue; }
        if (*c == 0 || (!quoted && isspace(static_cast<unsigned char>(*c)))) {
            if (any) words.push_back(word);
            word.clear();
            any = false;
            if (*c == 0) break;
            continue;
        }
        word += *c;
        any = true;
    }
    collect();
    if (words.empty()) {
        failure_ = "a user's program without a name can not be started";
        return false;
    }
    name_ = words[0];
    std::vector<char *> argv;
    for (std::string &w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    char slot[KERF_CLOCK_SLOT_LEN] = "";
    kerf_clock_reserve(slot, sizeof slot, "user-code", KERF_CLOCK_PRIO_USER);
    fflush(nullptr);
    pid_ = fork();
    if (pid_ < 0) {
        kerf_clock_unreserve(slot);
        pid_ = 0;
        failure_ = name_ + " can not be started: " + strerror(errno);
        return false;
    }
    if (pid_ == 0) {
        for (int s : {SIGINT, SIGTERM, SIGCHLD}) signal(s, SIG_DFL);
        if (*slot) setenv(KERF_CLOCK_SLOT_ENV, slot, 1);
        else unsetenv(KERF_CLOCK_SLOT_ENV);
        execvp(argv[0], argv.data());
        fprintf(stderr, "can't run %s: %s\n", argv[0], strerror(errno));
        _exit(127);
    }
    kerf_clock_reserved_for(slot, pid_);
    return true;
}

int Child::poll() {
    if (!running()) return -1;
    int status;
    pid_t r = waitpid(pid_, &status, WNOHANG);
    if (r == 0) return 0;
    if (r < 0 && errno == EINTR) return 0;
    pid_ = 0;
    if (r > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return 1;
    if (r < 0) failure_ = name_ + " is lost: " + strerror(errno);
    else if (WIFSIGNALED(status)) failure_ = name_ + " was ended by signal " + std::to_string(WTERMSIG(status));
    else if (WEXITSTATUS(status) == 127) failure_ = name_ + " can not be run (status 127)";
    else failure_ = name_ + " ended with status " + std::to_string(WEXITSTATUS(status));
    return -1;
}

void Child::interrupt() {
    if (!running()) return;
    kill(pid_, SIGINT);
    left_.push_back(pid_); // it may take its time
    pid_ = 0;
    collect();
}

void Child::collect() {
    left_.erase(
        std::remove_if(left_.begin(), left_.end(), [](pid_t pid) { return waitpid(pid, nullptr, WNOHANG) != 0; }),
        left_.end());
}
