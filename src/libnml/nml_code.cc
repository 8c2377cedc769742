// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_code.cc - see nml_code.hh: whole messages, and the text form.
#include "nml_code.hh"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace nml {

void Encoder::head(int32_t type, int64_t size) {
    if (!text_) {
        word(static_cast<uint32_t>(type));
        hyper(static_cast<uint64_t>(size));
        return;
    }
    char t[40];
    const int n = snprintf(t, sizeof t, "%7d,%7lld,", type, static_cast<long long>(size));
    out_.insert(out_.end(), t, t + n);
}

void Encoder::put_text(double v) {
    char t[40];
    const int n = snprintf(t, sizeof t, "%.17g,", v);
    out_.insert(out_.end(), t, t + n);
}

void Encoder::put_text(int64_t v) {
    char t[40];
    const int n = snprintf(t, sizeof t, "%lld,", static_cast<long long>(v));
    out_.insert(out_.end(), t, t + n);
}

void Encoder::put_text(const char *v, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const unsigned char c = static_cast<unsigned char>(v[i]);
        if (c >= ' ' && c != ',' && c != '\\' && c != 127) {
            out_.push_back(c);
            continue;
        }
        char t[8];
        snprintf(t, sizeof t, "\\x%02x", c);
        out_.insert(out_.end(), t, t + 4);
    }
    out_.push_back(',');
}

int32_t Decoder::head() {
    if (!text_) {
        const int32_t type = static_cast<int32_t>(word());
        hyper();
        return type;
    }
    const int64_t type = get_text();
    get_text();
    return static_cast<int32_t>(type);
}

// What stands before the next comma.
bool Decoder::token(std::string *out) {
    const void *comma = failed_ || at_ == end_ ? nullptr : memchr(at_, ',', static_cast<size_t>(end_ - at_));
    if (!comma) {
        failed_ = true;
        at_ = end_;
        return false;
    }
    const unsigned char *to = static_cast<const unsigned char *>(comma);
    out->assign(at_, to);
    at_ = to + 1;
    return true;
}

void Decoder::get_text(double &v) {
    std::string t;
    v = 0;
    if (!token(&t)) return;
    char *end;
    v = strtod(t.c_str(), &end);
    if (*end || end == t.c_str()) failed_ = true;
}

int64_t Decoder::get_text() {
    std::string t;
    if (!token(&t)) return 0;
    char *end;
    errno = 0;
    const long long v = strtoll(t.c_str(), &end, 10);
    if (*end || end == t.c_str() || errno) failed_ = true;
    return v;
}

void Decoder::get_text(char *v, size_t room, bool ends) {
    std::string t;
    memset(v, 0, room);
    if (!token(&t)) return;
    size_t n = 0;
    for (size_t i = 0; i < t.size(); i++, n++) {
        unsigned char c = static_cast<unsigned char>(t[i]);
        if (c == '\\') {
            const std::string hex = t.substr(i, 4);
            unsigned x;
            if (hex.size() < 4 || sscanf(hex.c_str(), "\\x%2x", &x) != 1) break;
            c = static_cast<unsigned char>(x);
            i += 3;
        }
        if (n + ends >= room) break;
        v[n] = static_cast<char>(c);
        if (i + 1 == t.size()) return;
    }
    if (!t.empty()) failed_ = true;
}

std::vector<unsigned char> encode_message(const MessageSet &set, const NMLmsg &msg, Coding coding) {
    const MessageType *m = set.find(msg._type);
    if (!m) return {};
    if (coding == Coding::raw) {
        const unsigned char *from = reinterpret_cast<const unsigned char *>(&msg);
        return {from, from + m->size};
    }
    Encoder e(coding == Coding::disp);
    e.head(msg._type, msg.size);
    m->encode(msg, e);
    return e.bytes();
}

bool decode_message(const MessageSet &set, const unsigned char *data, size_t size, NMLmsg *msg, size_t room,
                    Coding coding) {
    if (coding == Coding::raw) {
        NMLmsg head;
        if (size < sizeof head || size > room) return false;
        memcpy(static_cast<void *>(&head), data, sizeof head);
        const MessageType *m = set.find(head._type);
        if (!m || static_cast<size_t>(m->size) != size) return false;
        memcpy(static_cast<void *>(msg), data, size);
        msg->size = m->size;
        // Strings must end and values must be ones of their types: what XDR can carry.
        Encoder e;
        m->encode(*msg, e);
        std::vector<unsigned char> copy(size);
        Decoder d(e.bytes().data(), e.bytes().size());
        m->decode(*reinterpret_cast<NMLmsg *>(copy.data()), d);
        return !d.failed();
    }
    Decoder d(data, size, coding == Coding::disp);
    const NMLTYPE type = d.head();
    const MessageType *m = d.failed() ? nullptr : set.find(type);
    if (!m || static_cast<size_t>(m->size) > room) return false;
    memset(static_cast<void *>(msg), 0, static_cast<size_t>(m->size));
    msg->_type = type;
    msg->size = m->size;
    m->decode(*msg, d);
    return !d.failed();
}

} // namespace nml
