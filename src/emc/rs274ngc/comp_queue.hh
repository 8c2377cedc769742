/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp_queue.hh - calls held back while compensation looks ahead by one move.
 *
 * At most one compensated move waits until the next one tells where it ends; what
 * follows it in the program waits behind it, in order.
 * Units:  program units; plane coordinates as in ARC_FEED
 * Source: cutter compensation sheet, section 3
 */
#ifndef KERF_COMP_QUEUE_HH
#define KERF_COMP_QUEUE_HH

#include <string>
#include <vector>

#include "arc.hh"
#include "setup.hh"

namespace ngc
{

struct QueuedCall {
    enum Kind : uint8_t {
        FEED, TRAVERSE, ARC,
        FEED_RATE, FEED_MODE, DWELL, COMMENT,
        SPINDLE_MODE, SPINDLE_SPEED, SPINDLE_START, SPINDLE_STOP, ORIENT, WAIT_ORIENT,
        COOLANT, USER_M
    } kind;
    int line = 0;
    EmcPose end{};       // moves, not yet shifted for the tool's orientation
    Point2 centre{};     // arcs
    int turn = 0;
    double direction_x = 0, direction_y = 0; // straight: as programmed
    double sweep = 0;    // arcs: as programmed, radians, absolute
    state_tag_t tag;     // filled when the canon wants tags
    int i = 0, j = 0;
    double a = 0, b = 0;
    std::string text;
};

struct CompQueue {
    std::vector<QueuedCall> calls;
    // Where the last compensated move that was sent ended: the start of the pending one.
    bool start_known = false;
    Point2 start{};

    bool empty() const { return calls.empty(); }
    /// The pending move, if it is the first thing in the queue.
    QueuedCall *pending()
    {
        return !calls.empty() && calls[0].kind <= QueuedCall::ARC ? &calls[0] : nullptr;
    }
};

void enqueue_straight(Setup &s, bool traverse, const EmcPose &end, double dx, double dy);
void enqueue_arc(Setup &s, const EmcPose &end, Point2 centre, int turn, double sweep);
/// The pending move ends at this point (plane coordinates) instead; then all is sent.
[[nodiscard]] int move_end_and_flush(Setup &s, Point2 end);

} // namespace ngc

#endif
