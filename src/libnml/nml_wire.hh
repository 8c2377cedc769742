// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_wire.hh - requests and replies of the TCP protocol: nml sheet, section 6. All numbers
// are big-endian 32-bit words. [any]
#ifndef KERF_NML_WIRE_HH
#define KERF_NML_WIRE_HH

#include <cstdint>
#include <cstddef>
#include <vector>

namespace nml {

enum Request : uint32_t {
    REQ_READ = 1,
    REQ_WRITE,
    REQ_CHECK_IF_READ,
    REQ_CLEAN,
    REQ_CLEAR,
    REQ_CLOSE_CHANNEL,
    REQ_GET_KEYS,
    REQ_LOGIN,
    REQ_SET_SUBSCRIPTION,
    REQ_READ_COMBINED,
    REQ_BLOCKING_READ,
    REQ_GET_BUF_NAME,
    REQ_CANCEL_SUBSCRIPTION,
    REQ_SET_DIAG_INFO,
    REQ_GET_DIAG_INFO,
    REQ_GET_MSG_COUNT,
    REQ_GET_QUEUE_LENGTH,
    REQ_GET_SPACE_AVAILABLE
};

enum Access : uint32_t {
    ACCESS_READ = 1,
    ACCESS_CHECK_IF_READ,
    ACCESS_PEEK,
    ACCESS_WRITE,
    ACCESS_WRITE_IF_READ,
    ACCESS_CLEAR
};

// SET_SUBSCRIPTION. The server sends what comes new into the buffer as the answers of READ requests
// with the serial number of the subscription: `polled` at most once in the period that the request
// names (ms) and of a value the newest, `variable` each message that the server sees.
enum Subscribe : uint32_t { SUBSCRIBE_POLLED = 1, SUBSCRIBE_VARIABLE };

constexpr size_t DIAG_NAME_BYTES = 16; // GET_DIAG_INFO: process

constexpr size_t REQUEST_BYTES = 20, MAX_REQUEST_DATA = 0x2000;

inline void put_word(std::vector<unsigned char> &out, uint32_t w) {
    for (int s = 24; s >= 0; s -= 8) out.push_back(static_cast<unsigned char>(w >> s));
}

inline void put_long(std::vector<unsigned char> &out, int64_t v) {
    put_word(out, static_cast<uint32_t>(v >> 32));
    put_word(out, static_cast<uint32_t>(v));
}

inline uint32_t get_word(const unsigned char *p) {
    return uint32_t(p[0]) << 24 | uint32_t(p[1]) << 16 | uint32_t(p[2]) << 8 | p[3];
}
inline int64_t get_long(const unsigned char *p) {
    return static_cast<int64_t>(uint64_t(get_word(p)) << 32 | get_word(p + 4));
}

} // namespace nml
#endif
