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
    REQ_READ = 1, REQ_WRITE, REQ_CHECK_IF_READ, REQ_CLEAN, REQ_CLEAR, REQ_CLOSE_CHANNEL, REQ_GET_KEYS, REQ_LOGIN, REQ_SET_SUBSCRIPTION,
    REQ_READ_COMBINED, REQ_BLOCKING_READ, REQ_GET_BUF_NAME, REQ_CANCEL_SUBSCRIPTION, REQ_SET_DIAG_INFO, REQ_GET_DIAG_INFO,
    REQ_GET_MSG_COUNT, REQ_GET_QUEUE_LENGTH, REQ_GET_SPACE_AVAILABLE
};

enum Access : uint32_t { ACCESS_READ = 1, ACCESS_CHECK_IF_READ, ACCESS_PEEK, ACCESS_WRITE, ACCESS_WRITE_IF_READ, ACCESS_CLEAR };

constexpr size_t REQUEST_BYTES = 20, MAX_REQUEST_DATA = 0x2000;

inline void put_word(std::vector<unsigned char> &out, uint32_t w) {
    for (int s = 24; s >= 0; s -= 8) out.push_back(static_cast<unsigned char>(w >> s));
}

inline uint32_t get_word(const unsigned char *p) { return uint32_t(p[0]) << 24 | uint32_t(p[1]) << 16 | uint32_t(p[2]) << 8 | p[3]; }

} // namespace nml
#endif
