/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * follow.c - see follow.h; derivation in docs/planner.md.
 */
#include "follow.h"

#include <math.h>

#define FILTER_POSITION 0.2  /* share of the innovation taken into the position, each cycle; */
#define FILTER_SPEED 0.0222  /* into the speed: a^2 / (2 - a), well damped */
#define TRACK_SHARE 0.8      /* of the acceleration, for closing an error */
#define TRACK_CYCLES 8.0     /* time constant near the reference */

int follow_measure(struct follower *f, double revs, double dt)
{
    if (!f->cycles) {
        f->cycles = 1;
        f->revs = revs;
        f->speed = 0;
        return 0;
    }
    if (f->cycles < FOLLOW_SETTLED) f->cycles++;
    f->revs += f->speed * dt;
    double innovation = revs - f->revs;
    if (fabs(innovation) > 0.5) {
        f->revs = revs;
        f->origin += innovation;
        return 1;
    }
    f->revs += FILTER_POSITION * innovation;
    f->speed += FILTER_SPEED * innovation / dt;
    return 0;
}

void follow_index(struct follower *f, double revs)
{
    f->revs = revs;
}

double follow_reference(const struct follower *f, double upr, double lead)
{
    return upr * (f->revs + f->speed * lead - f->origin);
}

double follow_speed(double error, double speed, double acc, double dt)
{
    double gain = 1 / (TRACK_CYCLES * dt), a = TRACK_SHARE * acc;
    double e = fabs(error), linear = a / (gain * gain);
    double close = e < linear ? gain * e : sqrt(2 * a * (e - linear / 2));
    return error < 0 ? speed - close : speed + close;
}

void follow_start(struct follower *f, double upr, double acc, double lead, double dt)
{
    double v = upr * fabs(f->speed), a = TRACK_SHARE * acc, gain = 1 / (TRACK_CYCLES * dt);
    double run_up = v * v / (2 * a) + a / (2 * gain * gain) + v * dt;
    double now = f->revs + f->speed * lead;
    f->origin = ceil(now + run_up / upr);
}
