/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * g7x.cc - lathe contour cycles G70, G71, G72 and their variants.
 *
 * In:     the cycle's words; the contour from the sub that Q names
 * Out:    straight moves and arcs
 * Thread: [task]
 * Source: cycles sheet, section 3; G7x sheet
 */
#include <algorithm>

#include "comp_queue.hh"
#include "contour.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

constexpr double TINY_LEVEL = 1e-6;
enum { MAX_MOVES = 2000000 };

// ---- the contour from the sub ---------------------------------------------------------

struct ProfileReader {
    Setup &s;
    std::vector<Element> elements;
    Plane at;

    int end_point(const Block &b, Plane *end)
    {
        double z = at.real(), x = at.imag();
        if (s.distance_mode == MODE_INCREMENTAL) {
            CHECK(b.has('u'), "G7x error: Cannot use U in incremental mode (G91)");
            CHECK(b.has('w'), "G7x error: Cannot use W in incremental mode (G91)");
            x += b.value('x', 0);
            z += b.value('z', 0);
        } else {
            CHECK(b.has('u') && b.has('x'), "G7x error: Cannot use U and X in the same block");
            CHECK(b.has('w') && b.has('z'), "G7x error: Cannot use W and Z in the same block");
            x = b.value('x', x);
            z = b.value('z', z);
            if (b.has('u')) x += s.lathe_diameter ? b['u'] / 2 : b['u'];
            if (b.has('w')) z += b['w'];
        }
        *end = Plane(z, x);
        return INTERP_OK;
    }

    int arc(const Block &b, int g, Plane end)
    {
        const bool offsets = b.has('i') || b.has('k');
        CHECK(b.has('r') && offsets, "G7X error: both R and I or K flag used for arc");
        CHECK(!b.has('r') && !offsets, "G7X error: either I or K must be present for arc");
        Element e;
        e.kind = g == G_2 ? Element::CW : Element::CCW;
        e.start = at;
        e.end = end;
        if (b.has('r')) {
            const Plane chord = end - at;
            const double h2 = (b['r'] * b['r'] - std::norm(chord) / 4) / std::norm(chord);
            CHECK(h2 < -1e-6, "Arc radius too small to reach end point");
            const Plane side = Plane(0, 1) * chord * sqrt(std::max(h2, 0.0));
            e.centre = (at + end) / 2.0 + (g == G_3 ? side : -side);
        } else {
            e.centre = Plane(b.value('k', 0), b.value('i', 0));
            if (s.ijk_distance_mode == MODE_INCREMENTAL) e.centre += at;
            TRY(check_arc_radii(s, {at.real(), at.imag()}, {end.real(), end.imag()},
                                {e.centre.real(), e.centre.imag()}));
        }
        elements.push_back(e);
        return INTERP_OK;
    }

    // One block of the sub: only its motion counts.
    int take(const Block &b)
    {
        if (b.motion != G_0 && b.motion != G_1 && b.motion != G_2 && b.motion != G_3) return INTERP_OK;
        s.motion_mode = b.motion;
        Plane end;
        TRY(end_point(b, &end));
        if (end == at) return INTERP_OK;
        CHECK(elements.size() > 10000, "G7X error: the contour has more than 10000 elements");
        if (b.motion == G_0 || b.motion == G_1) {
            Element e;
            e.kind = Element::LINE;
            e.start = at;
            e.end = end;
            elements.push_back(e);
        } else {
            TRY(arc(b, b.motion, end));
        }
        at = end;
        CHECK(b.has('a') && b.has('c'), "G7X error: Both A and C parameters on a corner");
        if (b.has('a') || b.has('c')) {
            Element corner;
            corner.kind = b.has('a') ? Element::FILLET : Element::CHAMFER;
            corner.size = b.has('a') ? b['a'] : b['c'];
            corner.start = corner.end = end;
            elements.push_back(corner);
        }
        return INTERP_OK;
    }
};

// Runs the sub; parameter settings and flow are executed, moves are collected.
int read_profile(Setup &s, int sub, ProfileReader &reader)
{
    const Block cycle = s.block;
    char raw[sizeof s.raw], text[sizeof s.text];
    memcpy(raw, s.raw, sizeof raw);
    memcpy(text, s.text, sizeof text);
    const int raw_length = s.raw_length, number = s.sequence_number, level = s.call_level;
    const int64_t line_offset = s.line_offset, after_offset = s.after_offset;

    s.block.clear();
    s.block.o_type = O_CALL;
    s.block.o_name = std::to_string(sub);
    s.g7x_reading = true;
    int status = run_call(s);
    while (status == INTERP_OK && (s.call_level > level || !s.skipping.empty())) {
        if (s.source < 0) {
            status = s.fail(__func__, "Unknown oword number");
            break;
        }
        status = read_next_block(s);
        if (status != INTERP_OK) break;
        if (s.block.o_type != O_NONE) {
            status = execute_oword(s);
        } else {
            status = store_settings(s);
            if (status == INTERP_OK) status = reader.take(s.block);
        }
    }
    s.g7x_reading = false;
    if (status != INTERP_OK) return status > INTERP_MIN_ERROR ? status : s.fail(__func__, "Unknown oword number");
    s.block = cycle;
    memcpy(s.raw, raw, sizeof raw);
    memcpy(s.text, text, sizeof text);
    s.raw_length = raw_length;
    s.sequence_number = number;
    s.line_offset = line_offset;
    s.after_offset = after_offset;
    return INTERP_OK;
}

// ---- moves ------------------------------------------------------------------------------

/// Sends moves of an image of the plane through the ordinary motion functions.
struct Tool {
    Setup &s;
    const Image &image;
    Plane location; // in the image
    int moves = 0;

    int run(int g, Plane to, const Plane *centre = nullptr)
    {
        CHECK(++moves > MAX_MOVES, "G7X error: more than %d moves", MAX_MOVES);
        const Plane p = image.from(to);
        Block &b = s.block;
        const Block cycle = b;
        b.clear();
        b.set('x', p.imag());
        b.set('z', p.real());
        if (cycle.has('f')) b.set('f', cycle['f']);
        int status;
        if (centre) {
            const Plane c = image.from(*centre);
            b.set('i', c.imag());
            b.set('k', c.real());
            status = convert_arc(s, image.flips_arcs() ? (g == G_2 ? G_3 : G_2) : g);
        } else {
            status = convert_straight(s, g);
        }
        b = cycle;
        location = to;
        return status;
    }
    int rapid(Plane to) { return run(G_0, to); }
    int feed(Plane to) { return run(G_1, to); }
    int arc(const Element &e, Plane to) { return run(e.kind == Element::CCW ? G_3 : G_2, to, &e.centre); }
    /// Along the element to a point on it.
    int along(const Element &e, Plane to) { return e.is_arc() ? arc(e, to) : feed(to); }
};

// ---- roughing ---------------------------------------------------------------------------

struct Roughing {
    Setup &s;
    Tool &tool;
    const std::vector<Element> &path;
    double step;       // between levels
    Plane escape;      // after a cut
    int subcycle;      // 0, 1: no pockets, 2: only the pockets after the first
    std::vector<Plane> references;

    /// Down the element to level x. *rises: it does not go down.
    int dive(size_t k, double x, bool *rises)
    {
        const Element &e = path[k];
        *rises = false;
        const bool fast = k == 0;
        auto go = [&](Plane to) { return fast ? tool.rapid(to) : tool.feed(to); };
        if (!e.is_arc()) {
            if (e.start.imag() <= e.end.imag() + TINY_LEVEL) {
                *rises = true;
                return INTERP_OK;
            }
            if (x < e.end.imag()) return go(e.end);
            Plane p;
            CHECK(!meets_level(e, x, Crossing::FIRST, &p), "G7X error: x too large in straight dive");
            return go(p);
        }
        if (std::abs(tool.location - e.end) < 1e-3 || tool.location.real() < e.end.real()) return INTERP_OK;
        const double middle = e.centre.real();
        Plane p;
        if (e.kind == Element::CCW) {
            if (tool.location.real() > middle + TINY_LEVEL) {
                *rises = true;
                return INTERP_OK;
            }
            if (!meets_level(e, x, Crossing::LAST, &p) || p.real() > middle) p = e.end;
            return std::abs(tool.location - p) > 1e-3 ? tool.arc(e, p) : int(INTERP_OK);
        }
        if (tool.location.real() <= middle + TINY_LEVEL) {
            *rises = true;
            return INTERP_OK;
        }
        if (!meets_level(e, x, Crossing::FIRST, &p)) return tool.arc(e, e.end);
        if (p.real() < middle) return INTERP_OK;
        return tool.arc(e, p);
    }

    /// Up the element to its end. *falls: it goes down (after its top).
    int climb(const Element &e, bool *falls)
    {
        *falls = false;
        if (!e.is_arc()) {
            if (e.end.imag() < e.start.imag() - TINY_LEVEL) {
                *falls = true;
                return INTERP_OK;
            }
            return std::abs(tool.location - e.end) > 1e-9 ? tool.feed(e.end) : int(INTERP_OK);
        }
        const double middle = e.centre.real();
        if (e.kind == Element::CW) {
            if (tool.location.real() > middle + TINY_LEVEL) {
                *falls = true;
                return INTERP_OK;
            }
            return std::abs(tool.location - e.end) > 1e-3 ? tool.arc(e, e.end) : int(INTERP_OK);
        }
        if (tool.location.real() < middle - TINY_LEVEL) {
            *falls = true;
            return INTERP_OK;
        }
        if (e.end.real() >= middle) return std::abs(tool.location - e.end) > 1e-3 ? tool.arc(e, e.end) : int(INTERP_OK);
        const Plane top = e.centre + Plane(0, e.radius());
        *falls = true;
        return std::abs(tool.location - top) > 1e-3 ? tool.arc(e, top) : int(INTERP_OK);
    }

    // .1: the contour without its pockets.
    int climb_only(size_t k)
    {
        for (; k < path.size(); ++k) {
            const Element &e = path[k];
            const double level = tool.location.imag();
            Plane p;
            const bool rises = e.is_arc() ? (e.kind == Element::CW || e.start.real() > e.centre.real())
                                          : e.end.imag() >= e.start.imag() - TINY_LEVEL;
            if (!rises) continue;
            const Plane top = e.kind == Element::CCW && e.end.real() < e.centre.real()
                                  ? e.centre + Plane(0, e.radius())
                                  : e.end;
            if (top.imag() < level - TINY_LEVEL) continue;
            if (!meets_level(e, level, e.kind == Element::CW ? Crossing::LAST : Crossing::FIRST, &p)) continue;
            if (p.real() < tool.location.real() + TINY_LEVEL) TRY(tool.feed(p));
            if (std::abs(top - tool.location) > 1e-3) TRY(tool.along(e, top));
        }
        return INTERP_OK;
    }

    /// From here the contour rises: finish it, or begin the next pocket.
    int follow(size_t k, bool first_of_two)
    {
        if (subcycle == 1) return climb_only(k);
        for (; k < path.size(); ++k) {
            bool falls;
            TRY(climb(path[k], &falls));
            if (!falls) continue;
            if (subcycle == 2) {
                // Levels hang from the start and from the highest peak so far.
                bool higher = first_of_two;
                for (; references.size() > 1 && references.back().imag() < tool.location.imag(); higher = true)
                    references.pop_back();
                if (higher) references.push_back(tool.location);
            }
            return rough(k, references.back().imag(), false);
        }
        return INTERP_OK;
    }

    /// The next crossing of the level behind the location: where, and on which element.
    bool next_wall(size_t k, double x, size_t *element, Plane *point) const
    {
        for (size_t n = k; n < path.size(); ++n) {
            Plane p;
            if (!meets_level(path[n], x, n == k ? Crossing::LAST : Crossing::FIRST, &p)) continue;
            if (p.real() > tool.location.real() + TINY_LEVEL) continue;
            if (n == k && std::abs(p - tool.location) < 1e-3) continue; // where the tool is
            *element = n;
            *point = p;
            return true;
        }
        return false;
    }

    int rough(size_t k, double x, bool top)
    {
        if (top && subcycle == 2) {
            for (; k < path.size(); ++k) {
                bool rises;
                TRY(dive(k, -1e99, &rises));
                if (rises) return follow(k, true);
            }
            return INTERP_OK;
        }
        for (;;) {
            while (x > tool.location.imag() + TINY_LEVEL) x -= step;
            bool rises;
            TRY(dive(k, x, &rises));
            if (rises) return follow(k, false);
            if (fabs(tool.location.imag() - x) > TINY_LEVEL || std::abs(tool.location - path[k].end) < TINY_LEVEL) {
                if (++k == path.size()) return INTERP_OK;
                continue;
            }
            size_t wall;
            Plane dest;
            if (!next_wall(k, x, &wall, &dest)) {
                x -= step;
                continue;
            }
            const double length = std::abs(dest - tool.location);
            if (length < 1e-3) {
                if (wall != k) k = wall;
                else x -= step;
                continue;
            }
            const Plane from = tool.location;
            TRY(tool.feed(dest));
            const double scale = std::abs(escape) > 0 ? std::min(1.0, length / (2 * escape.real())) : 0;
            TRY(tool.rapid(dest + scale * escape));
            TRY(tool.rapid(from - scale * std::conj(escape)));
            TRY(k == 0 ? tool.rapid(from) : tool.feed(from));
            x -= step;
        }
    }
};

int finish_error(Setup &s, const Contour &c) { FAIL("G7X error: %s", c.error.c_str()); }

// A straight rapid from `from` to `to` would touch the contour.
bool crosses(const Contour &c, Plane from, Plane to)
{
    for (size_t k = 1; k < c.elements.size(); ++k) {
        const Element &e = c.elements[k];
        for (Plane p : {e.start, e.end, e.kind == Element::CCW ? e.centre + Plane(0, e.radius()) : e.end}) {
            if (std::abs(p - from) < 1e-9 || p.real() <= from.real() || p.real() >= to.real()) continue;
            const double t = (p.real() - from.real()) / (to.real() - from.real());
            if (p.imag() > from.imag() + t * (to.imag() - from.imag()) + TINY_LEVEL) return true;
        }
    }
    return false;
}

// G70: the contour, once for each pass.
int finish(Setup &s, Contour contour, double d, double e, int passes)
{
    const Contour raw = contour;
    if (!contour.normalise(false)) return finish_error(s, contour);
    if (!contour.is_monotonic()) {
        contour = raw;
        if (!contour.normalise(true)) return finish_error(s, contour);
        CHECK(!contour.is_monotonic(), "G7X error: Not monotonic");
    }
    const int side = s.comp_side;
    for (int pass = passes; pass > 0; --pass) {
        Contour c = contour;
        if (!c.offset((pass - 1) * (d - e) / passes + e)) return finish_error(s, c);
        Tool tool{s, c.image, c.elements.back().end};
        TRY(finish_comp(s));
        s.comp_side = COMP_OFF;
        const Plane start = c.elements.front().start;
        int status = INTERP_OK;
        if (pass != passes && crosses(c, tool.location, start)) {
            // Out of the work first, then back beside it.
            double above = start.imag();
            for (const Element &x : c.elements)
                above = std::max(
                    {above, x.start.imag(), x.kind == Element::CCW ? x.centre.imag() + x.radius() : x.end.imag()});
            status = tool.rapid(Plane(tool.location.real(), above));
            if (status == INTERP_OK) status = tool.rapid(Plane(start.real(), above));
        }
        if (status == INTERP_OK) status = tool.rapid(start);
        s.comp_side = side;
        s.comp_first_move = true;
        s.queue->start_known = false;
        TRY(status);
        TRY(tool.rapid(c.elements.front().end));
        for (size_t k = 1; k < c.elements.size(); ++k) TRY(tool.along(c.elements[k], c.elements[k].end));
    }
    return INTERP_OK;
}

int rough_out(Setup &s, Contour &c, int g)
{
    const Block &b = s.block;
    const double cut = b.value('i', 1), retract = b.value('r', 0.5);
    CHECK(cut <= 0, "G7X error: I must be greater than zero.");
    const Plane displacement(b.value('w', 0), b.value('u', 0));
    if (!c.normalise(g >= G_72)) return finish_error(s, c);
    CHECK(!c.is_monotonic(), "G7X error: Not monotonic");
    if (!c.offset(b.value('d', 0))) return finish_error(s, c);
    c.displace(displacement);
    const Plane start = c.elements.front().start;
    const Plane end = c.elements.back().end;
    if (end.imag() < start.imag()) {
        Element up;
        up.kind = Element::LINE;
        up.start = end;
        up.end = Plane(end.real(), start.imag());
        c.elements.push_back(up);
    }
    Tool tool{s, c.image, start};
    TRY(tool.rapid(start));
    Roughing work{s, tool, c.elements, std::max(cut, 2 * TINY_LEVEL), Plane(retract, retract), g % 10, {start}};
    return work.rough(0, start.imag(), true);
}

// A cycle draws in absolute modes and puts the program's back.
struct ModeGuard {
    Setup &s;
    const int distance, ijk;
    explicit ModeGuard(Setup &setup) : s(setup), distance(s.distance_mode), ijk(s.ijk_distance_mode) {}
    ~ModeGuard()
    {
        s.distance_mode = distance;
        s.ijk_distance_mode = ijk;
    }
    void absolute() { s.distance_mode = s.ijk_distance_mode = MODE_ABSOLUTE; }
};

} // namespace

int convert_g7x(Setup &s, int g)
{
    const Block &b = s.block;
    CHECK(!b.has('q'), "G7x.x  requires a Q word");
    CHECK(g != G_70 && s.comp_on(), "G%d.%d cannot be used with cutter compensation enabled", g / 10, g % 10);
    CHECK(s.plane != CANON_PLANE_XZ, "G%d.%d can only be used in XZ plane (G18)", g / 10, g % 10);
    const bool incremental = s.distance_mode == MODE_INCREMENTAL;
    const double x = s.current.tran.x, z = s.current.tran.z;
    const Plane start(incremental ? z + b.value('z', 0) : b.value('z', z),
                      incremental ? x + b.value('x', 0) : b.value('x', x));
    const int mode = s.motion_mode, side = s.comp_side;
    ModeGuard modes(s);
    modes.absolute();
    s.comp_side = COMP_OFF;
    {
        const Block cycle = b;
        for (char c : {'u', 'w'}) s.block.present &= ~word_bit(c);
        const int status = convert_straight(s, G_0);
        s.block = cycle;
        s.comp_side = side;
        TRY(status);
    }
    s.motion_mode = mode;
    s.distance_mode = modes.distance;
    s.ijk_distance_mode = modes.ijk;

    ProfileReader reader{s, {}, start};
    int sub;
    TRY(to_integer(s, b['q'], &sub));
    TRY(read_profile(s, sub, reader));
    const int left_mode = s.motion_mode;
    Contour contour;
    contour.elements = std::move(reader.elements);
    // A corner at the end has nothing to round, not even with the line that leads out.
    while (!contour.elements.empty() && contour.elements.back().is_corner()) contour.elements.pop_back();
    if (contour.elements.size() < 2) return INTERP_OK;
    if (g != G_70) {
        // A contour that ends inside the stock is led out of it.
        const Element &lead = contour.elements.front(), &last = contour.elements.back();
        const Plane run = last.end - last.start, in = lead.end - lead.start;
        const bool along_x = g < G_72;
        const bool straight_out = last.kind == Element::LINE && (along_x ? run.real() == 0 : run.imag() == 0);
        const double out = along_x ? start.imag() - last.end.imag() : start.real() - last.end.real();
        if (!straight_out && (along_x ? in.imag() : in.real()) * out < 0) {
            Element e;
            e.kind = Element::LINE;
            e.start = last.end;
            e.end = along_x ? Plane(last.end.real(), start.imag()) : Plane(start.real(), last.end.imag());
            contour.elements.push_back(e);
        }
    }
    modes.absolute();
    int status;
    if (g == G_70) {
        const int passes = b.has('p') ? std::max(1, int(std::min(rint(b['p']), 1000.0))) : 1;
        status = finish(s, contour, b.value('d', 0), b.value('e', 0), passes);
    } else {
        status = rough_out(s, contour, g);
    }
    s.motion_mode = left_mode;
    return status;
}

} // namespace ngc
