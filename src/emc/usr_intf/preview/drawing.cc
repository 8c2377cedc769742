// SPDX-License-Identifier: GPL-2.0-or-later
#include "drawing.hh"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace kerf {

namespace {

constexpr uint8_t JUMP = 3;             // kinds up to 2 are drawn
constexpr int FINEST = 16384, COARSEST = 32; // tolerances: parts of the drawing's size
constexpr size_t MOST_SKIPPED = 24;      // vertices that one piece replaces in a level
constexpr size_t THIN_PIECES = 64, LEAST_PIECE = 8; // of a drawing that is thinner than its coarsest level
constexpr double TURN_STEP_DEG = 10, MIN_TURN_STEPS = 10;
constexpr const char *LETTERS = "XYZABCUVW";

void turn(double &a, double &b, double degrees)
{
    const double t = degrees * (M_PI / 180), c = std::cos(t), s = std::sin(t), na = a * c - b * s;
    b = a * s + b * c;
    a = na;
}

/// Outcode of a point against the window: one bit for each side that it is beyond.
unsigned outside(const Matrix &m, double x, double y, double z)
{
    const double cx = m[0] * x + m[1] * y + m[2] * z + m[3], cy = m[4] * x + m[5] * y + m[6] * z + m[7],
                 cw = m[12] * x + m[13] * y + m[14] * z + m[15];
    return (cx < -cw ? 1u : 0u) | (cx > cw ? 2u : 0u) | (cy < -cw ? 4u : 0u) | (cy > cw ? 8u : 0u) |
           (cw <= 0 ? 16u : 0u);
}

/// False when a box is surely not in the window.
bool visible(const Matrix &m, const std::array<float, 6> &b)
{
    unsigned all = ~0u;
    for (unsigned i = 0; i < 8; ++i) all &= outside(m, b[i & 1 ? 3 : 0], b[i & 2 ? 4 : 1], b[i & 4 ? 5 : 2]);
    return all == 0;
}

/// The pixels that an inch at the drawing's nearest corner takes at most.
double pixels_per_inch(const Matrix &m, int width, int height, const std::array<double, 3> &low,
                       const std::array<double, 3> &high) {
    double w = 1e300;
    for (unsigned i = 0; i < 8; ++i) {
        const double x = i & 1 ? high[0] : low[0], y = i & 2 ? high[1] : low[1], z = i & 4 ? high[2] : low[2];
        w = std::min(w, m[12] * x + m[13] * y + m[14] * z + m[15]);
    }
    const double x = std::hypot(m[0], std::hypot(m[1], m[2])) * width / 2,
                 y = std::hypot(m[4], std::hypot(m[5], m[6])) * height / 2;
    return std::max(x, y) / std::max(w, 0.05);
}

/// Square of the distance of a point from the piece a b.
float beside2(const float *p, const float *a, const float *b)
{
    const float dx = b[0] - a[0], dy = b[1] - a[1], dz = b[2] - a[2], px = p[0] - a[0], py = p[1] - a[1],
                pz = p[2] - a[2];
    const float length2 = dx * dx + dy * dy + dz * dz, along = px * dx + py * dy + pz * dz;
    const float t = along <= 0 || length2 == 0 ? 0 : along >= length2 ? 1 : along / length2;
    const float ex = px - t * dx, ey = py - t * dy, ez = pz - t * dz;
    return ex * ex + ey * ey + ez * ez;
}

} // namespace

Places::Places(const Placement &placement) : p_(placement)
{
    double sign = 1;
    bool respect = false;
    for (char c : p_.geometry) {
        const char letter = char(toupper(static_cast<unsigned char>(c)));
        if (letter == '-') sign = -1;
        else if (letter == '!') respect = true;
        else if (letter && strchr(LETTERS, letter)) {
            letters_.emplace_back(letter, sign);
            sign = 1;
        }
    }
    for (auto &l : letters_)
        if (respect && strchr("ABC", l.first) && p_.coordinates.find(l.first) != std::string::npos) turns_ = true;
}

std::array<float, 3> Places::operator()(const float *p) const
{
    if (p_.plane == 0) return {p[0], p[1], float(p_.plane_z)};
    if (p_.plane == 1) return {p[6], p[7], float(p_.plane_z)};
    double q[3] = {0, 0, 0};
    for (const auto &[letter, sign] : letters_) {
        const size_t n = size_t(strchr(LETTERS, letter) - LETTERS);
        if (n < 3 || n > 5) {
            q[n % 3] += sign * (p[n] - (turns_ ? p_.offset[n] : 0));
        } else if (turns_ && p_.coordinates.find(letter) != std::string::npos) {
            const double degrees = sign * (p[n] - p_.offset[n]);
            if (n == 3) turn(q[1], q[2], degrees);
            else if (n == 4) turn(q[0], q[2], degrees);
            else turn(q[0], q[1], degrees);
        }
    }
    for (size_t i = 0; i < 3 && turns_; ++i) q[i] += p_.offset[i];
    return {float(q[0]), float(q[1]), float(q[2])};
}

Drawing::Drawing(const float *points, const uint8_t *kinds, const int32_t *lines, size_t count, size_t columns,
                 const Placement &placement)
{
    const Places place(placement);
    std::vector<float> xyz;
    std::vector<uint8_t> all_kinds;
    std::vector<int32_t> all_lines;
    xyz.reserve(3 * count);
    all_kinds.reserve(count);
    all_lines.reserve(count);
    auto add = [&](const float *nine, uint8_t kind, int32_t line) {
        const auto p = place(nine);
        xyz.insert(xyz.end(), p.begin(), p.end());
        all_kinds.push_back(kind);
        all_lines.push_back(line);
    };
    float from[9] = {}, to[9] = {};
    for (size_t i = 0; i < count; ++i) {
        std::copy_n(points + columns * i, columns, to);
        if (place.turns() && i > 0 && kinds[i] < JUMP) { // a rotary move is a curve
            const double most =
                std::max({std::fabs(to[3] - from[3]), std::fabs(to[4] - from[4]), std::fabs(to[5] - from[5])});
            const int steps =
                most > 0 ? int(std::min(10000.0, std::ceil(std::max(MIN_TURN_STEPS, most / TURN_STEP_DEG)))) : 1;
            for (int k = 1; k < steps; ++k) {
                float between[9];
                for (size_t a = 0; a < 9; ++a) between[a] = from[a] + (to[a] - from[a]) * float(k) / float(steps);
                add(between, kinds[i], lines[i]);
            }
        }
        add(to, kinds[i], lines[i]);
        std::copy_n(to, 9, from);
    }
    xyz_ = std::move(xyz);
    kinds_ = std::move(all_kinds);
    lines_ = std::move(all_lines);
    build_levels();
}

// ---- from one process to another -----------------------------------------------------------

namespace {

constexpr uint64_t MARK = 0x31676e6977617264; // "drawing1"
constexpr size_t ALIGN = 16;

struct Head {
    uint64_t mark, vertices, levels, size; // size: of the whole file, bytes
};
struct LevelHead {
    double tolerance;
    uint64_t entries, boxes;
};

size_t padded(size_t bytes) { return (bytes + ALIGN - 1) / ALIGN * ALIGN; }

void put(int fd, const void *data, size_t bytes)
{
    static const char zeros[ALIGN] = {};
    const struct {
        const char *at;
        size_t left;
    } parts[] = {{static_cast<const char *>(data), bytes}, {zeros, padded(bytes) - bytes}};
    for (auto [at, left] : parts)
        while (left > 0) {
            const ssize_t n = ::write(fd, at, left);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) throw std::runtime_error(std::string("a drawing can not be written: ") + strerror(errno));
            at += n;
            left -= size_t(n);
        }
}

template <class T> void put(int fd, const Row<T> &row) { put(fd, row.data(), row.size() * sizeof(T)); }

/// Takes rows off a file in the order in which they were put.
class Taker {
public:
    explicit Taker(const MappedFile &file) : file_(file) {}
    template <class T> Row<T> take(uint64_t count)
    {
        if (count > (file_.size() - at_) / sizeof(T) || padded(count * sizeof(T)) > file_.size() - at_)
            throw std::runtime_error("a drawing is not complete");
        const T *data = reinterpret_cast<const T *>(file_.data() + at_);
        at_ += padded(count * sizeof(T));
        return Row<T>(data, count);
    }

private:
    const MappedFile &file_;
    size_t at_ = 0;
};

} // namespace

MappedFile::MappedFile(int fd)
{
    struct stat found;
    if (fstat(fd, &found) != 0) throw std::runtime_error(std::string("a drawing can not be read: ") + strerror(errno));
    size_ = size_t(found.st_size);
    void *at = size_ ? mmap(nullptr, size_, PROT_READ, MAP_SHARED | MAP_POPULATE, fd, 0) : nullptr;
    if (at == MAP_FAILED) throw std::runtime_error(std::string("a drawing can not be read: ") + strerror(errno));
    data_ = static_cast<const char *>(at);
}

MappedFile::~MappedFile()
{
    if (data_) munmap(const_cast<char *>(data_), size_);
}

void Drawing::write(int fd) const
{
    std::vector<LevelHead> heads;
    size_t size = padded(sizeof(Head)) + padded(levels_.size() * sizeof(LevelHead)) +
                  padded(xyz_.size() * sizeof(float)) + padded(kinds_.size()) + padded(lines_.size() * sizeof(int32_t));
    for (const Level &l : levels_) {
        heads.push_back({l.tolerance, l.index.size(), l.boxes.size()});
        size += padded(l.index.size() * sizeof(uint32_t)) + padded(l.boxes.size() * sizeof(l.boxes[0]));
    }
    const Head head{MARK, kinds_.size(), levels_.size(), size};
    put(fd, &head, sizeof head);
    put(fd, heads.data(), heads.size() * sizeof(LevelHead));
    put(fd, xyz_);
    put(fd, kinds_);
    put(fd, lines_);
    for (const Level &l : levels_) {
        put(fd, l.index);
        put(fd, l.boxes);
    }
}

Drawing::Drawing(std::unique_ptr<MappedFile> file) : file_(std::move(file))
{
    Taker from(*file_);
    const Head head = from.take<Head>(1)[0];
    if (head.mark != MARK || head.size != file_->size() || head.vertices > file_->size())
        throw std::runtime_error("a drawing is not complete");
    const Row<LevelHead> heads = from.take<LevelHead>(head.levels);
    xyz_ = from.take<float>(3 * head.vertices);
    kinds_ = from.take<uint8_t>(head.vertices);
    lines_ = from.take<int32_t>(head.vertices);
    for (const LevelHead &h : heads) {
        Level level;
        level.tolerance = h.tolerance;
        level.index = from.take<uint32_t>(h.entries);
        level.boxes = from.take<std::array<float, 6>>(h.boxes);
        levels_.push_back(std::move(level));
    }
}

bool Drawing::extents(std::array<double, 3> &low, std::array<double, 3> &high) const
{
    low = {1e300, 1e300, 1e300};
    high = {-1e300, -1e300, -1e300};
    if (levels_.empty()) return false;
    for (const auto &b : levels_[0].boxes)
        for (size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], double(b[a]));
            high[a] = std::max(high[a], double(b[a + 3]));
        }
    return low[0] <= high[0];
}

void Drawing::add_boxes(Level &level) const
{
    const size_t n = entries(level);
    std::vector<std::array<float, 6>> boxes;
    for (size_t first = 0; first < n; first += CHUNK) {
        std::array<float, 6> b{1e30f, 1e30f, 1e30f, -1e30f, -1e30f, -1e30f};
        for (size_t i = first ? first - 1 : 0; i < std::min(n, first + CHUNK); ++i) {
            const float *p = &xyz_[3 * vertex(level, i)];
            for (size_t a = 0; a < 3; ++a) {
                b[a] = std::min(b[a], p[a]);
                b[a + 3] = std::max(b[a + 3], p[a]);
            }
        }
        boxes.push_back(b);
    }
    level.boxes = std::move(boxes);
}

/// A vertex is left out while all that were left out since the last kept one lie within `reach` of the straight
/// piece that replaces them; where the kind changes, never.
void Drawing::simplify(const Level &from, float reach, std::vector<uint32_t> &kept) const
{
    const size_t n = entries(from);
    const float reach2 = reach * reach;
    const float *skipped[MOST_SKIPPED]; // further than reach from the last kept one
    size_t count = 0;
    kept.push_back(vertex(from, 0));
    const float *anchor = &xyz_[3 * kept.back()];
    auto keep = [&](uint32_t v) {
        kept.push_back(v);
        anchor = &xyz_[3 * v];
        count = 0;
    };
    uint32_t before = kept.back();
    for (size_t i = 1; i < n; ++i) {
        const uint32_t v = vertex(from, i);
        const float *p = &xyz_[3 * v];
        bool straight = count < MOST_SKIPPED;
        for (size_t k = count; straight && k > 0; --k) straight = beside2(skipped[k - 1], anchor, p) <= reach2;
        if (!straight) keep(before);
        if (i + 1 == n || kinds_[vertex(from, i + 1)] != kinds_[v]) keep(v);
        else if (beside2(p, anchor, anchor) > reach2) skipped[count++] = p;
        before = v;
    }
}

void Drawing::build_levels()
{
    const size_t n = kinds_.size();
    if (n < 2) return;
    levels_.emplace_back(); // its list is all vertices in order and is not kept
    add_boxes(levels_[0]);
    std::array<double, 3> low, high;
    extents(low, high);
    const double size = std::hypot(high[0] - low[0], std::hypot(high[1] - low[1], high[2] - low[2]));
    for (int parts = FINEST; parts >= COARSEST && entries(levels_.back()) > CHUNK; parts /= 2) {
        const Level &from = levels_.back();
        Level level;
        level.tolerance = size / parts;
        // Kept vertices of level k are within size/2parts of those dropped before: half of the tolerance is left.
        const size_t before = entries(from);
        std::vector<uint32_t> kept;
        simplify(from, float(level.tolerance / 2), kept);
        if (kept.size() > before * 9 / 10) continue; // not worth a list
        kept.shrink_to_fit();
        level.index = std::move(kept);
        add_boxes(level);
        levels_.push_back(std::move(level));
    }
}

Choice Drawing::choose(const Matrix &matrix, int width, int height, double pixels, size_t budget) const
{
    Choice out;
    if (levels_.empty()) return out;
    std::array<double, 3> low, high;
    extents(low, high);
    const double allowed = pixels / pixels_per_inch(matrix, width, height, low, high);
    size_t level = 0;
    while (level + 1 < levels_.size() && levels_[level + 1].tolerance <= allowed) ++level;
    for (;; ++level) {
        const Level &l = levels_[level];
        out.level = level;
        out.first.clear();
        out.count.clear();
        out.vertices = 0;
        for (size_t c = 0; c < l.boxes.size(); ++c) {
            if (!visible(matrix, l.boxes[c])) continue;
            const size_t first = c ? c * CHUNK - 1 : 0, last = std::min(entries(l), (c + 1) * CHUNK);
            if (!out.first.empty() && size_t(out.first.back() + out.count.back()) == first + 1) {
                out.count.back() += int32_t(last - first - 1);
            } else {
                out.first.push_back(int32_t(first));
                out.count.push_back(int32_t(last - first));
            }
            out.vertices += last - first;
        }
        if (!budget || out.vertices <= budget || level + 1 == levels_.size()) break;
    }
    out.exact = level == 0 || levels_[level].tolerance <= allowed;
    if (budget && out.vertices > budget) { // every n-th piece: thinner, but all over the part
        const size_t piece = std::min<size_t>(std::max<size_t>(budget / THIN_PIECES, LEAST_PIECE), CHUNK / 4);
        const size_t step = (out.vertices + budget - 1) / budget;
        Choice thin;
        thin.level = level;
        thin.exact = false;
        for (size_t i = 0; i < out.first.size(); ++i)
            for (int32_t at = 0; at < out.count[i]; at += int32_t(piece * step)) {
                thin.first.push_back(out.first[i] + at);
                thin.count.push_back(std::min<int32_t>(int32_t(piece), out.count[i] - at));
                thin.vertices += size_t(thin.count.back());
            }
        return thin;
    }
    return out;
}

void Drawing::draw(Raster &raster, const std::vector<Rgba> &palette, const Matrix &matrix, double pixels) const
{
    const Choice choice = choose(matrix, raster.width(), raster.height(), pixels, 0);
    draw(raster, palette, matrix, choice.level, choice.first, choice.count);
}

void Drawing::draw(Raster &raster, const std::vector<Rgba> &palette, const Matrix &matrix, size_t level,
                   const std::vector<int32_t> &first, const std::vector<int32_t> &count) const
{
    if (first.empty()) return;
    const Level &l = levels_.at(level);
    Path path{xyz_.data(), kinds_.data(), entries(l), 3};
    if (l.tolerance > 0) path.index = l.index.data();
    for (size_t i = 0; i < first.size(); ++i) {
        const size_t begin = size_t(first[i]), end = begin + size_t(count.at(i));
        if (first[i] < 0 || count[i] < 0 || end > path.count) throw std::out_of_range("a piece is not in its level");
        raster.draw(path, palette, matrix, begin, end);
    }
}

std::vector<std::pair<uint32_t, uint32_t>> Drawing::spans(int32_t line) const
{
    std::vector<std::pair<uint32_t, uint32_t>> out;
    for (size_t i = 1; i < lines_.size(); ++i) {
        if (lines_[i] != line || kinds_[i] >= JUMP) continue;
        if (!out.empty() && out.back().second == i) ++out.back().second;
        else out.emplace_back(uint32_t(i - 1), uint32_t(i + 1));
    }
    return out;
}

int32_t Drawing::pick(const Matrix &matrix, int width, int height, double x, double y, double radius,
                      unsigned shown) const {
    std::vector<Rgba> palette;
    for (unsigned kind = 0; kind < JUMP; ++kind) palette.push_back({0, 0, 0, uint8_t(shown >> kind & 1 ? 255 : 0)});
    const Path path{xyz_.data(), kinds_.data(), kinds_.size(), 3};
    const long vertex = Raster::pick(path, palette, matrix, width, height, x, y, radius);
    return vertex < 0 ? -1 : lines_[size_t(vertex)];
}

} // namespace kerf
