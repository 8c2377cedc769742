// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_code.hh - a message's fields to bytes and back: XDR (RFC 4506), big endian, or (disp)
// text for people: each number or string followed by a comma, docs/nml.md.
//
// Encoder and Decoder are visitors: a message class shows each of its fields as
//     visitor(Field{name, attribute, doc}, member)
// bool, char and 8-bit scalars take 4 bytes, long and 64-bit integers 8, char arrays are
// counted byte strings, other arrays are their elements in a row. [any]
#ifndef KERF_NML_CODE_HH
#define KERF_NML_CODE_HH

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "emcpos.h"
#include "nml.hh"
#include "nml_config.hh"

namespace nml {

struct Field {
    const char *name;      // member, as in the manual
    const char *attribute; // Python attribute or dict key, "" for none
    const char *doc;       // meaning with unit
};

template <class T> constexpr bool is_scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class Encoder {
public:
    explicit Encoder(bool text = false) : text_(text) {}
    template <class T> void operator()(const Field &, const T &v) { put(v); }
    const std::vector<unsigned char> &bytes() const { return out_; }
    // Type and size: 12 bytes of XDR, or 16 of text.
    void head(int32_t type, int64_t size);
    void word(uint32_t w) { for (int s = 24; s >= 0; s -= 8) out_.push_back(static_cast<unsigned char>(w >> s)); }
    void hyper(uint64_t w) { word(static_cast<uint32_t>(w >> 32)); word(static_cast<uint32_t>(w)); }

    void put(double v) {
        if (text_) return put_text(v);
        uint64_t w;
        std::memcpy(&w, &v, 8);
        hyper(w);
    }
    template <class T> std::enable_if_t<is_scalar<T> && !std::is_floating_point_v<T>> put(const T &v) {
        if (text_) put_text(static_cast<int64_t>(v));
        else if constexpr (std::is_enum_v<T> || sizeof(T) <= 4) word(static_cast<uint32_t>(static_cast<int64_t>(v)));
        else hyper(static_cast<uint64_t>(v));
    }
    // Text goes whole, with the zeros behind it: a reader may decode into what it read before.
    template <size_t N> void put(const char (&v)[N]) {
        const size_t n = strnlen(v, N);
        if (text_) put_text(v, n);
        else bytes(v, n, N);
    }
    template <size_t N> void put(const unsigned char (&v)[N]) { // anything
        size_t n = N;
        while (n > 0 && v[n - 1] == 0) n--;
        if (text_) put_text(reinterpret_cast<const char *>(v), n);
        else bytes(v, n, N);
    }
    template <class T, size_t N> void put(const T (&v)[N]) { for (const T &e : v) put(e); }
    void put(const PmCartesian &p) { put(p.x); put(p.y); put(p.z); }
    void put(const EmcPose &p) { put(p.tran); put(p.a); put(p.b); put(p.c); put(p.u); put(p.v); put(p.w); }
    // A structure that shows its fields; if it is a status, its head goes first.
    template <class T> auto put(const T &v) -> decltype(T::fields(*this, v)) {
        if constexpr (std::is_base_of_v<RCS_STAT_MSG, T>) put_status(v);
        T::fields(*this, v);
    }
    void put_status(const RCS_STAT_MSG &m) {
        put(m.command_type); put(m.echo_serial_number); put(m.status); put(m._state);
    }
private:
    // `used` of `all` bytes, then zeros.
    void bytes(const void *v, size_t used, size_t all) {
        word(static_cast<uint32_t>(all));
        const unsigned char *from = static_cast<const unsigned char *>(v);
        out_.insert(out_.end(), from, from + used);
        out_.resize(out_.size() + ((all + 3) & ~size_t(3)) - used);
    }
    void put_text(double v);
    void put_text(int64_t v);
    void put_text(const char *v, size_t n);
    std::vector<unsigned char> out_;
    bool text_;
};

// Reads what Encoder wrote. Reading past the end or a string that does not fit sets
// failed() and leaves zeros: bytes from the network are never trusted.
class Decoder {
public:
    Decoder(const unsigned char *data, size_t size, bool text = false) : at_(data), end_(data + size), text_(text) {}
    int32_t head(); // the type
    bool failed() const { return failed_; }
    template <class T> void operator()(const Field &, T &v) { get(v); }

    uint32_t word() {
        if (end_ - at_ < 4) { failed_ = true; at_ = end_; return 0; }
        uint32_t w = uint32_t(at_[0]) << 24 | uint32_t(at_[1]) << 16 | uint32_t(at_[2]) << 8 | at_[3];
        at_ += 4;
        return w;
    }
    uint64_t hyper() { uint64_t h = word(); return h << 32 | word(); }

    void get(double &v) {
        if (text_) return get_text(v);
        uint64_t w = hyper();
        std::memcpy(&v, &w, 8);
    }
    template <class T> std::enable_if_t<is_scalar<T> && !std::is_floating_point_v<T>> get(T &v) {
        if (text_) v = static_cast<T>(get_text());
        else if constexpr (std::is_same_v<T, bool>) v = word() != 0;
        else if constexpr (std::is_enum_v<T> || sizeof(T) <= 4) v = static_cast<T>(static_cast<int32_t>(word()));
        else v = static_cast<T>(hyper());
    }
    template <size_t N> void get(char (&v)[N]) {
        if (text_) return get_text(v, N, true);
        bytes(v, N);
        if (memchr(v, 0, N)) return;
        failed_ = true; // text ends
        v[N - 1] = 0;
    }
    template <size_t N> void get(unsigned char (&v)[N]) {
        if (text_) get_text(reinterpret_cast<char *>(v), N, false);
        else bytes(v, N);
    }
    template <class T, size_t N> void get(T (&v)[N]) { for (T &e : v) get(e); }
    void get(PmCartesian &p) { get(p.x); get(p.y); get(p.z); }
    void get(EmcPose &p) { get(p.tran); get(p.a); get(p.b); get(p.c); get(p.u); get(p.v); get(p.w); }
    template <class T> auto get(T &v) -> decltype(T::fields(*this, v)) {
        if constexpr (std::is_base_of_v<RCS_STAT_MSG, T>) {
            T fresh;
            v._type = fresh._type;
            v.size = fresh.size;
            get_status(v);
        }
        T::fields(*this, v);
    }
    void get_status(RCS_STAT_MSG &m) { get(m.command_type); get(m.echo_serial_number); get(m.status); get(m._state); }
private:
    // At most `room` bytes, then zeros.
    void bytes(void *v, size_t room) {
        const size_t n = word(), padded = (n + 3) & ~size_t(3);
        std::memset(v, 0, room);
        if (n > room || padded > static_cast<size_t>(end_ - at_)) { failed_ = true; at_ = end_; return; }
        std::memcpy(v, at_, n);
        at_ += padded;
    }
    bool token(std::string *out);
    void get_text(double &v);
    int64_t get_text();
    void get_text(char *v, size_t room, bool ends); // ends: with a zero
    const unsigned char *at_, *end_;
    bool failed_ = false, text_;
};

// The entry of a message class in a MessageSet.
template <class T> MessageType describe(const char *name) {
    MessageType m{};
    T sample;
    m.type = sample._type;
    m.name = name;
    m.size = sizeof(T);
    m.kind = std::is_base_of_v<RCS_CMD_MSG, T>    ? Kind::command
             : std::is_base_of_v<RCS_STAT_MSG, T> ? Kind::status
                                                  : Kind::plain;
    m.encode = [](const NMLmsg &msg, Encoder &e) {
        const T &t = static_cast<const T &>(msg);
        if constexpr (std::is_base_of_v<RCS_CMD_MSG, T>) e.put(t.serial_number);
        if constexpr (std::is_base_of_v<RCS_STAT_MSG, T>) e.put_status(t);
        T::fields(e, t);
    };
    m.decode = [](NMLmsg &msg, Decoder &d) {
        T &t = static_cast<T &>(msg);
        if constexpr (std::is_base_of_v<RCS_CMD_MSG, T>) d.get(t.serial_number);
        if constexpr (std::is_base_of_v<RCS_STAT_MSG, T>) d.get_status(t);
        T::fields(d, t);
    };
    return m;
}

// A whole message; empty when its type is unknown.
std::vector<unsigned char> encode_message(const MessageSet &set, const NMLmsg &msg, Coding coding);
// Fills msg (room bytes). False: unknown type, does not fit, malformed.
bool decode_message(const MessageSet &set, const unsigned char *data, size_t size, NMLmsg *msg, size_t room,
                    Coding coding);

} // namespace nml
#endif
