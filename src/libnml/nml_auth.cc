// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_auth.cc - see nml_auth.hh.
#include "nml_auth.hh"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace nml {

std::vector<Login> read_logins(const std::string &file, std::string *problem) {
    std::vector<Login> logins;
    struct stat info;
    std::ifstream in(file);
    if (!in || stat(file.c_str(), &info) != 0) {
        *problem = "can't read the password file '" + file + "': " + strerror(errno);
        return logins;
    }
    if (info.st_mode & (S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH)) {
        *problem = "others may read the password file '" + file + "'; say: chmod 600 '" + file + "'";
        return logins;
    }
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        Login l;
        if (words >> l.name >> l.password) logins.push_back(l);
    }
    if (logins.empty()) *problem = "the password file '" + file + "' has no line 'name password'";
    return logins;
}

std::string random_bytes(size_t n) {
    std::string out(n, 0);
    for (size_t got = 0; got < n;) {
        ssize_t r = getrandom(&out[got], n - got, 0);
        if (r > 0) got += static_cast<size_t>(r);
        else if (errno != EINTR) abort(); // no secret can be made: nothing may be let in
    }
    return out;
}

std::string hmac(const std::string &key, const std::string &data) {
    unsigned char sum[EVP_MAX_MD_SIZE];
    unsigned int n = 0;
    HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), reinterpret_cast<const unsigned char *>(data.data()),
         data.size(), sum, &n);
    return std::string(reinterpret_cast<char *>(sum), n);
}

std::string to_hex(const std::string &bytes) {
    static const char digits[] = "0123456789abcdef";
    std::string out;
    for (char c : bytes) {
        out += digits[static_cast<unsigned char>(c) >> 4];
        out += digits[static_cast<unsigned char>(c) & 15];
    }
    return out;
}

bool equal_secret(const std::string &a, const std::string &b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

bool is_loopback(const sockaddr *address) {
    if (address->sa_family == AF_INET)
        return ntohl(reinterpret_cast<const sockaddr_in *>(address)->sin_addr.s_addr) >> 24 == 127;
    if (address->sa_family != AF_INET6) return false;
    const in6_addr &six = reinterpret_cast<const sockaddr_in6 *>(address)->sin6_addr;
    return IN6_IS_ADDR_LOOPBACK(&six) || (IN6_IS_ADDR_V4MAPPED(&six) && six.s6_addr[12] == 127);
}

void ask_when_quiet(int fd) {
    const int on = 1, seconds = 1, questions = 10;
    setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPIDLE, &seconds, sizeof seconds);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPINTVL, &seconds, sizeof seconds);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPCNT, &questions, sizeof questions);
}

bool peer_unheard(int fd) {
    constexpr unsigned LONGEST_MS = 3000;
    tcp_info info{};
    socklen_t size = sizeof info;
    return getsockopt(fd, IPPROTO_TCP, TCP_INFO, &info, &size) == 0 && info.tcpi_last_ack_recv > LONGEST_MS &&
           info.tcpi_last_data_recv > LONGEST_MS;
}

} // namespace nml
