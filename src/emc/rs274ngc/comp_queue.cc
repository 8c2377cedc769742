/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp_queue.cc - see comp_queue.hh.
 *
 * Thread: [task]
 * Source: cutter compensation sheet, sections 3 and 7
 */
#include "comp_queue.hh"

#include "stages.hh"

namespace ngc
{
namespace
{

// From the path of the nose centre to that of the imaginary tool point (G18).
void lathe_shift(const Setup &s, double *x, double *z)
{
    static const signed char dx[] = {0, -1, -1, 1, 1, 0, -1, 0, 1, 0};
    static const signed char dz[] = {0, 1, -1, -1, 1, 1, 0, -1, 0, 0};
    if (s.plane != CANON_PLANE_XZ || s.comp_orientation < 1 || s.comp_orientation > 8) return;
    *x += dx[s.comp_orientation] * s.comp_radius;
    *z += dz[s.comp_orientation] * s.comp_radius;
}

void send_move(Setup &s, const QueuedCall &c)
{
    EmcPose end = c.end;
    lathe_shift(s, &end.tran.x, &end.tran.z);
    if (s.canon.wants_tags()) s.canon.UPDATE_TAG(c.tag);
    const ArcPlane &plane = arc_plane(s.plane);
    if (c.kind == QueuedCall::FEED) {
        s.canon.STRAIGHT_FEED(c.line, end);
    } else if (c.kind == QueuedCall::TRAVERSE) {
        s.canon.STRAIGHT_TRAVERSE(c.line, end);
    } else {
        EmcPose centre{};
        axis(centre, plane.first) = c.centre.x;
        axis(centre, plane.second) = c.centre.y;
        lathe_shift(s, &centre.tran.x, &centre.tran.z);
        s.canon.ARC_FEED(c.line, axis(end, plane.first), axis(end, plane.second), axis(centre, plane.first),
                         axis(centre, plane.second), c.turn, axis(end, plane.normal), end);
    }
    s.queue->start = in_plane(c.end, plane);
    s.queue->start_known = true;
}

void send(Setup &s, const QueuedCall &c)
{
    Canon &canon = s.canon;
    switch (c.kind) {
    case QueuedCall::FEED: case QueuedCall::TRAVERSE: case QueuedCall::ARC: send_move(s, c); break;
    case QueuedCall::FEED_RATE: canon.SET_FEED_RATE(c.a); break;
    case QueuedCall::FEED_MODE: canon.SET_FEED_MODE(c.i, c.j); break;
    case QueuedCall::DWELL: canon.DWELL(c.a); break;
    case QueuedCall::COMMENT: canon.COMMENT(c.text.c_str()); break;
    case QueuedCall::SPINDLE_MODE: canon.SET_SPINDLE_MODE(c.i, c.a); break;
    case QueuedCall::SPINDLE_SPEED: canon.SET_SPINDLE_SPEED(c.i, c.a); break;
    case QueuedCall::SPINDLE_START:
        if (c.j == CANON_CLOCKWISE) canon.START_SPINDLE_CLOCKWISE(c.i);
        else canon.START_SPINDLE_COUNTERCLOCKWISE(c.i);
        break;
    case QueuedCall::SPINDLE_STOP: canon.STOP_SPINDLE_TURNING(c.i); break;
    case QueuedCall::ORIENT: canon.ORIENT_SPINDLE(c.i, c.a, c.j); break;
    case QueuedCall::WAIT_ORIENT: canon.WAIT_SPINDLE_ORIENT_COMPLETE(c.i, c.a); break;
    case QueuedCall::COOLANT:
        if (c.i) c.j ? canon.MIST_ON() : canon.MIST_OFF();
        else c.j ? canon.FLOOD_ON() : canon.FLOOD_OFF();
        break;
    case QueuedCall::USER_M: canon.USER_DEFINED_FUNCTION(c.i, c.a, c.b); break;
    }
}

QueuedCall make_call(QueuedCall::Kind kind)
{
    QueuedCall c;
    c.kind = kind;
    return c;
}

void add_move(Setup &s, QueuedCall &c)
{
    c.line = line_of(s);
    if (s.canon.wants_tags()) fill_tag(s, &c.tag);
    s.queue->calls.push_back(c);
}

// Behind a pending move things wait; otherwise they go out at once.
bool waits(const Setup &s) { return !s.queue->empty(); }

} // namespace

void enqueue_straight(Setup &s, bool rapid, const EmcPose &end, double dx, double dy)
{
    QueuedCall c = make_call(rapid ? QueuedCall::TRAVERSE : QueuedCall::FEED);
    c.end = end;
    c.direction_x = dx;
    c.direction_y = dy;
    add_move(s, c);
}

void enqueue_arc(Setup &s, const EmcPose &end, Point2 centre, int turn, double sweep)
{
    QueuedCall c = make_call(QueuedCall::ARC);
    c.end = end;
    c.centre = centre;
    c.turn = turn;
    c.sweep = fabs(sweep);
    add_move(s, c);
}

void flush_comp(Setup &s)
{
    for (const QueuedCall &c : s.queue->calls) send(s, c);
    s.queue->calls.clear();
}

void drop_comp(Setup &s)
{
    s.queue->calls.clear();
    s.queue->start_known = false;
}

void scale_comp(Setup &s, double factor)
{
    s.comp_radius *= factor;
    s.queue->start.x *= factor;
    s.queue->start.y *= factor;
    for (QueuedCall &c : s.queue->calls) {
        if (c.kind == QueuedCall::FEED_RATE) c.a *= factor;
        if (c.kind > QueuedCall::ARC) continue;
        for (int i = 0; i < AXES; ++i)
            if (is_linear(i)) axis(c.end, i) *= factor;
        c.centre.x *= factor;
        c.centre.y *= factor;
    }
}

int move_end_and_flush(Setup &s, Point2 end)
{
    QueuedCall *move = s.queue->pending();
    const ArcPlane &plane = arc_plane(s.plane);
    if (move) {
        const Point2 start = s.queue->start;
        if (move->kind == QueuedCall::ARC) {
            const Point2 old_end = in_plane(move->end, plane);
            const double r1 = hypot(old_end.x - move->centre.x, old_end.y - move->centre.y);
            const double r2 = hypot(end.x - move->centre.x, end.y - move->centre.y);
            CHECK(fabs(r1 - r2) > 0.01,
                  "BUG: cutter compensation has generated an invalid arc with mismatched radii r1 %f r2 %f", r1, r2);
            if (s.queue->start_known && move->sweep != 0) {
                const double sweep = fabs(arc_sweep(start, end, move->centre, move->turn));
                const double slack = s.units == CANON_UNITS_INCHES ? 0.001 : 0.0254;
                CHECK(sweep > move->sweep + slack,
                      "Arc move in concave corner cannot be reached by the tool without gouging");
            }
        } else if (s.queue->start_known) {
            const double along = move->direction_x * (end.x - start.x) + move->direction_y * (end.y - start.y);
            CHECK(along < 0, "Straight %s in concave corner cannot be reached by the tool without gouging",
                  move->kind == QueuedCall::FEED ? "feed" : "traverse");
        }
        // Moves of other axes at the corner follow it.
        for (QueuedCall &c : s.queue->calls) {
            if (c.kind > QueuedCall::ARC) continue;
            axis(c.end, plane.first) = end.x;
            axis(c.end, plane.second) = end.y;
        }
    }
    flush_comp(s);
    return INTERP_OK;
}

int finish_comp(Setup &s)
{
    if (s.queue->empty()) return INTERP_OK;
    return move_end_and_flush(s, in_plane(s.current, arc_plane(s.plane)));
}

void enqueue_feed_rate(Setup &s, double rate)
{
    if (!waits(s)) return s.canon.SET_FEED_RATE(rate);
    QueuedCall c = make_call(QueuedCall::FEED_RATE);
    c.a = rate;
    s.queue->calls.push_back(c);
}

void enqueue_feed_mode(Setup &s, int spindle, int mode)
{
    if (!waits(s)) return s.canon.SET_FEED_MODE(spindle, mode);
    QueuedCall c = make_call(QueuedCall::FEED_MODE);
    c.i = spindle;
    c.j = mode;
    s.queue->calls.push_back(c);
}

void enqueue_dwell(Setup &s, double seconds)
{
    if (!waits(s)) return s.canon.DWELL(seconds);
    QueuedCall c = make_call(QueuedCall::DWELL);
    c.a = seconds;
    s.queue->calls.push_back(c);
}

void enqueue_comment(Setup &s, const char *text)
{
    if (!waits(s)) return s.canon.COMMENT(text);
    QueuedCall c = make_call(QueuedCall::COMMENT);
    c.text = text;
    s.queue->calls.push_back(c);
}

void enqueue_spindle_mode(Setup &s, int spindle, double css_max)
{
    if (!waits(s)) return s.canon.SET_SPINDLE_MODE(spindle, css_max);
    QueuedCall c = make_call(QueuedCall::SPINDLE_MODE);
    c.i = spindle;
    c.a = css_max;
    s.queue->calls.push_back(c);
}

void enqueue_spindle_speed(Setup &s, int spindle, double speed)
{
    if (!waits(s)) return s.canon.SET_SPINDLE_SPEED(spindle, speed);
    QueuedCall c = make_call(QueuedCall::SPINDLE_SPEED);
    c.i = spindle;
    c.a = speed;
    s.queue->calls.push_back(c);
}

void enqueue_spindle_start(Setup &s, int spindle, CANON_DIRECTION direction)
{
    QueuedCall c = make_call(QueuedCall::SPINDLE_START);
    c.i = spindle;
    c.j = direction;
    if (waits(s)) s.queue->calls.push_back(c);
    else send(s, c);
}

void enqueue_spindle_stop(Setup &s, int spindle)
{
    if (!waits(s)) return s.canon.STOP_SPINDLE_TURNING(spindle);
    QueuedCall c = make_call(QueuedCall::SPINDLE_STOP);
    c.i = spindle;
    s.queue->calls.push_back(c);
}

void enqueue_orient(Setup &s, int spindle, double degrees, int direction)
{
    if (!waits(s)) return s.canon.ORIENT_SPINDLE(spindle, degrees, direction);
    QueuedCall c = make_call(QueuedCall::ORIENT);
    c.i = spindle;
    c.a = degrees;
    c.j = direction;
    s.queue->calls.push_back(c);
}

void enqueue_wait_orient(Setup &s, int spindle, double timeout)
{
    if (!waits(s)) return s.canon.WAIT_SPINDLE_ORIENT_COMPLETE(spindle, timeout);
    QueuedCall c = make_call(QueuedCall::WAIT_ORIENT);
    c.i = spindle;
    c.a = timeout;
    s.queue->calls.push_back(c);
}

void enqueue_coolant(Setup &s, bool mist, bool on)
{
    QueuedCall c = make_call(QueuedCall::COOLANT);
    c.i = mist;
    c.j = on;
    if (waits(s)) s.queue->calls.push_back(c);
    else send(s, c);
}

void enqueue_user_m(Setup &s, int num, double p, double q)
{
    QueuedCall c = make_call(QueuedCall::USER_M);
    c.i = num;
    c.a = p;
    c.b = q;
    if (waits(s)) s.queue->calls.push_back(c);
    else send(s, c);
}

} // namespace ngc
