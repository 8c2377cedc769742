// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_config.cc - reads .nml files. [task] Files are small and read once per connection.
#include "nml_config.hh"

#include <netdb.h>
#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "nml.hh"
#include "rcs_print.hh"

namespace {

std::map<std::string, std::string> &aliases() {
    static std::map<std::string, std::string> map;
    return map;
}

enum class Force { none, remote, local } force_kind = Force::none;

std::string upper(std::string s) {
    for (char &c : s) c = static_cast<char>(toupper(static_cast<unsigned char>(c)));
    return s;
}

std::string folder_of(const std::string &file) { return file.substr(0, file.rfind('/') + 1); }

long number(const std::string &s) { return strtol(s.c_str(), nullptr, 0); }

using Words = std::vector<std::string>;

// The B and P lines as words, joined over a trailing backslash.
bool read_lines(const std::string &file, std::vector<Words> *out) {
    std::ifstream in(file);
    if (!in) {
        rcs_print_error("cms_config: can't open '%s'. Error = %d -- %s\n", file.c_str(), errno, strerror(errno));
        return false;
    }
    std::string line, more;
    while (std::getline(in, line)) {
        while (!line.empty() && line.back() == '\\' && std::getline(in, more))
            line = line.substr(0, line.size() - 1) + more;
        if (line.size() < 3 || line[0] == '#' || line[0] == ' ' || line[0] == '\t') continue;
        std::istringstream words(line);
        Words w;
        for (std::string word; words >> word;) w.push_back(word);
        if (w.size() >= 4) out->push_back(w);
    }
    return true;
}

// folder: of the .nml file, for relative names in it.
std::optional<nml::BufferLine> parse_buffer(const Words &w, const std::string &folder) {
    if (w.size() < 10) return {};
    nml::BufferLine b;
    b.name = w[1];
    if (w[2] == "SHMEM") b.kind = nml::BufferKind::shmem;
    else if (w[2] == "LOCMEM") b.kind = nml::BufferKind::locmem;
    else if (w[2] == "PHANTOM") b.kind = nml::BufferKind::phantom;
    else {
        rcs_print_error("cms_config: buffer %s: type %s is not available\n", w[1].c_str(), w[2].c_str());
        return {};
    }
    auto alias = aliases().find(w[3]);
    b.host = alias == aliases().end() ? w[3] : alias->second;
    b.size = number(w[4]);
    b.neutral = number(w[5]) != 0;
    b.number = static_cast<int>(number(w[7]));
    b.max_procs = static_cast<int>(number(w[8]));
    b.key = static_cast<int>(number(w[9]));
    for (size_t i = 10; i < w.size(); i++) {
        std::string o = upper(w[i]), v = o.find('=') == std::string::npos ? "" : o.substr(o.find('=') + 1);
        auto is = [&](const char *prefix) { return o.compare(0, strlen(prefix), prefix) == 0; };
        if (o == "QUEUE") b.queue = true;
        else if (o == "DIAG") b.diag = true;
        else if (o == "SPLIT") b.split = true;
        else if (o == "DISP") b.coding = nml::Coding::disp;
        else if (o == "SERIAL") b.serial = true;
        else if (o == "CONFIRM_WRITE") b.confirm_write = true;
        else if (o == "FORCE_RAW") b.coding = nml::Coding::raw;
        else if (o == "AUTOCNUM") b.autocnum = true;
        else if (is("TCP=")) b.tcp_port = static_cast<int>(number(v));
        else if (is("UDP=")) b.udp = true;
        else if (is("VERSION=")) b.version = strtod(v.c_str(), nullptr);
        else if (is("SUBDIV=")) b.subdivisions = std::max(1, static_cast<int>(number(v)));
        else if (is("ENC_MAX_SIZE=")) b.enc_max_size = number(v);
        else if (is("BSEM=")) b.bsem = static_cast<int>(number(v));
        else if (is("BRPI=")) b.poll_interval = strtod(v.c_str(), nullptr);
        else if (is("PASSWD=")) {
            b.passwd = w[i].substr(w[i].find('=') + 1);
            if (!b.passwd.empty() && b.passwd[0] != '/') b.passwd = folder + b.passwd;
        } else if (is("FORCE_TYPE=")) b.force_type = static_cast<int>(number(v));
        else if (o == "MUTEX=NONE") b.lock = nml::Lock::none;
        else if (o == "MUTEX=NO_INTERRUPTS" || o == "MUTEX=NO_SWITCHING") b.lock = nml::Lock::refused;
    }
    if (b.udp) { rcs_print_error("UPDMEM not supported.\n"); return {}; }
    if (b.split && b.queue) { rcs_print_error("CMS: Can not split buffer with queuing enabled.\n"); return {}; }
    if (b.version > 0 && b.version < 3.44) b.subdivisions = 1;
    if (b.version > 0 && b.version <= 3.71 && b.diag) { b.diag = false; rcs_print("NO DIAGNOSTICS\n"); }
    return b;
}

bool is_this_host(const std::string &host) {
    if (host == "localhost" || host == "127.0.0.1") return true;
    char name[256] = "";
    gethostname(name, sizeof name - 1);
    return host == name;
}

std::optional<nml::ProcessLine> parse_process(const Words &w, const nml::BufferLine &b) {
    if (w.size() < (b.autocnum ? 9u : 10u)) return {};
    for (const std::string &word : w)
        if (upper(word).compare(0, 18, "SERIALPORTDEVNAME=") == 0) {
            rcs_print_error("TTYMEM not supported on this platform.\n");
            return {};
        }
    nml::ProcessLine p;
    std::string kind = upper(w[3]);
    p.name = w[1];
    p.host = w[4];
    if (kind == "LOCAL") p.kind = nml::ProcessKind::local;
    else if (kind == "REMOTE") p.kind = nml::ProcessKind::remote;
    else if (kind == "PHANTOM") p.kind = nml::ProcessKind::phantom;
    else if (kind == "AUTO") p.kind = is_this_host(b.host) ? nml::ProcessKind::local : nml::ProcessKind::remote;
    else {
        rcs_print_error("cms_config: process %s: type %s is not available\n", w[1].c_str(), w[3].c_str());
        return {};
    }
    if (force_kind == Force::remote && p.kind == nml::ProcessKind::local) p.kind = nml::ProcessKind::remote;
    if (force_kind == Force::local && p.kind == nml::ProcessKind::remote) p.kind = nml::ProcessKind::local;
    p.read = w[5].find('R') != std::string::npos;
    p.write = w[5].find('W') != std::string::npos;
    p.server = p.kind == nml::ProcessKind::remote ? 0 : static_cast<int>(number(w[6]));
    if (p.server) p.read = p.write = true;
    p.timeout = upper(w[7]) == "INF" ? -1 : strtod(w[7].c_str(), nullptr);
    p.master = number(w[8]) != 0;
    p.cnum = b.autocnum ? 0 : static_cast<int>(number(w[9]));
    if (p.kind == nml::ProcessKind::local && p.cnum >= b.max_procs) {
        rcs_print_error("CMS: connection number(%d) must be less than total connections (%d).\n", p.cnum, b.max_procs);
        return {};
    }
    return p;
}

} // namespace

std::optional<nml::Connection> nml::find_connection(const std::string &file, const std::string &buffer,
                                                    const std::string &process) {
    std::vector<Words> lines;
    if (!read_lines(file, &lines)) return {};
    Connection c;
    const Words *b = nullptr, *exact = nullptr, *any = nullptr, *neither = nullptr;
    for (const Words &w : lines) {
        if (w[0] == "B" && w[1] == buffer && !b) b = &w;
        if (w[0] != "P") continue;
        if (w[1] == process && w[2] == buffer && !exact) exact = &w;
        if (w[1] == process && w[2] == "default" && !any) any = &w;
        if (w[1] == "default" && w[2] == "default" && !neither) neither = &w;
    }
    if (!b) {
        rcs_print_error("No buffer-line entry found for buffer %s in config file %s.\n", buffer.c_str(), file.c_str());
        return {};
    }
    const Words *p = exact ? exact : any ? any : neither;
    if (!p) {
        rcs_print_error("No process-line entry found for process %s connecting to buffer %s in config file %s and no "
                        "applicable defaults were found.\n",
                        process.c_str(), buffer.c_str(), file.c_str());
        return {};
    }
    auto bl = parse_buffer(*b, folder_of(file));
    if (!bl) return {};
    auto pl = parse_process(*p, *bl);
    if (!pl) return {};
    c.buffer = *bl;
    c.process = *pl;
    c.process.name = process;
    return c;
}

std::vector<nml::BufferLine> nml::buffers_of(const std::string &file) {
    std::vector<Words> lines;
    std::vector<BufferLine> out;
    if (read_lines(file, &lines))
        for (const Words &w : lines)
            if (w[0] == "B") if (auto b = parse_buffer(w, folder_of(file))) out.push_back(*b);
    return out;
}

void nmlSetHostAlias(const char *host, const char *alias) { if (host && alias) aliases()[alias] = host; }
void nmlClearHostAliases() { aliases().clear(); }
void nmlForceRemoteConnection() { force_kind = Force::remote; }
void nmlForceLocalConnection() { force_kind = Force::local; }
