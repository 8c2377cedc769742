// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_auth.hh - the other end of a connection. Passwords never travel: the server sends a random challenge, the
// client answers with HMAC-SHA256(password, challenge). [any]
#ifndef KERF_NML_AUTH_HH
#define KERF_NML_AUTH_HH

#include <string>
#include <vector>

struct sockaddr;

namespace nml {

struct Login { std::string name, password; };

// Lines "name password" of a passwd= file; '#' begins a comment. Empty and *problem set when the
// file can't be read, others than its owner may read it, or it names nobody.
std::vector<Login> read_logins(const std::string &file, std::string *problem);

// n random bytes of the kernel.
std::string random_bytes(size_t n);

// HMAC-SHA256, 32 bytes.
std::string hmac(const std::string &key, const std::string &data);

std::string to_hex(const std::string &bytes);

// The same time whatever differs.
bool equal_secret(const std::string &a, const std::string &b);

// A peer on this computer.
bool is_loopback(const sockaddr *address);

// The system asks a quiet peer every second whether it is still there, and ends the connection after ten questions.
void ask_when_quiet(int fd);
// Of a connection with ask_when_quiet(): for 3 s nothing has come of the peer's computer (a cable may be pulled).
bool peer_unheard(int fd);

} // namespace nml
#endif
