/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ladder_scan.c - one pass over the rungs and charts of a ladder.
 *
 * Thread: [rt]; bounded by rungs x cells, MAX_JUMPS and MAX_CALLS
 *
 * A rung is evaluated column by column from the left, rows from the top. `output` of a
 * cell is the state of the line on its right. Blocks of several cells act in their
 * top-right (wide ones: rightmost) cell and take their inputs at their left side.
 */
#include "classicladder/ladder.h"

#define COUNTER_MAX 9999

/* Where the scan is: a place in a section, on the stack of calls. */
struct frame {
    const struct section *section;
    int rung, x, y;
};

static struct rung *rung_at(struct ladder *l, int number)
{
    struct rung *r;
    if(number < 0 || number >= l->sizes.rungs) return NULL;
    r = &LADDER(l, rungs, struct rung)[number];
    return r->used ? r : NULL;
}


/* State of the line at the left side of a cell. */
static int left_of(const struct rung *r, int x, int y)
{
    int row;
    if(x == 0) return 1;
    if(r->cell[y][x - 1].output) return 1;
    for(row = y; row > 0 && r->cell[row][x].with_top; row--)
        if(r->cell[row - 1][x - 1].output) return 1;
    for(row = y + 1; row < RUNG_HEIGHT && r->cell[row][x].with_top; row++)
        if(r->cell[row][x - 1].output) return 1;
    return 0;
}

/* ---- Elements -------------------------------------------------------------- */

static void contact(struct ladder *l, struct rung *r, struct cell *c, int x, int y)
{
    int value = ladder_read_ref(l, &c->var) != 0;
    int pass = c->type == EL_NC || c->type == EL_FALLING ? !value : value;
    if(c->type == EL_RISING || c->type == EL_FALLING) {
        pass = pass && value != c->before;
        c->before = value;
    }
    c->output = pass && left_of(r, x, y);
}

static void coil(struct ladder *l, struct rung *r, struct cell *c, int x, int y)
{
    int left = left_of(r, x, y);
    c->output = left;
    if(c->type == EL_COIL) ladder_write_ref(l, &c->var, left);
    else if(c->type == EL_COIL_NC) ladder_write_ref(l, &c->var, !left);
    else if(left) ladder_write_ref(l, &c->var, c->type == EL_SET);
}

/* Sets the lines at the right side of a block, from its top row on. */
static void set_outputs(struct rung *r, int x, int y, int first, int second, int third)
{
    r->cell[y][x].output = first;
    if(y + 1 < RUNG_HEIGHT) r->cell[y + 1][x].output = second;
    if(y + 2 < RUNG_HEIGHT && third >= 0) r->cell[y + 2][x].output = third;
}

/* Input of a block in a row; rows beyond the rung are off. */
static int input(const struct rung *r, int x, int y)
{
    return x >= 0 && y < RUNG_HEIGHT && left_of(r, x, y);
}

static void timer(struct ladder *l, struct rung *r, const struct cell *c, int x, int y, int ms)
{
    struct timer *t;
    if(c->var.number < 0 || c->var.number >= l->sizes.timers) return;
    t = &LADDER(l, timers, struct timer)[c->var.number];
    if(!input(r, x - 1, y)) {
        t->value = t->preset;
        t->running = t->done = 0;
    } else if(t->value > 0) {
        if(input(r, x - 1, y + 1)) t->value -= ms;
        if(t->value < 0) t->value = 0;
        t->running = 1;
        t->done = 0;
    } else {
        t->running = 0;
        t->done = 1;
    }
    set_outputs(r, x, y, t->done, t->running, -1);
}

static void monostable(struct ladder *l, struct rung *r, const struct cell *c, int x, int y, int ms)
{
    struct timer *m;
    int in = input(r, x - 1, y);
    if(c->var.number < 0 || c->var.number >= l->sizes.monostables) return;
    m = &LADDER(l, monostables, struct timer)[c->var.number];
    if(in && !m->input && m->value == 0) {
        m->value = m->preset;
        m->running = 1;
    }
    if(m->value > 0) {
        m->value -= ms;
        if(m->value < 0) m->value = 0;
    } else {
        m->running = 0;
    }
    m->input = in;
    set_outputs(r, x, y, m->running, 0, -1);
}

static void set_count(struct counter *k, int value)
{
    k->previous = k->value;
    k->value = value;
}

static void counter(struct ladder *l, struct rung *r, const struct cell *c, int x, int y)
{
    int reset = input(r, x - 1, y), preset = input(r, x - 1, y + 1), up = input(r, x - 1, y + 2);
    int down = input(r, x - 1, y + 3);
    struct counter *k;
    if(c->var.number < 0 || c->var.number >= l->sizes.counters) return;
    k = &LADDER(l, counters, struct counter)[c->var.number];
    if(up && !k->up) set_count(k, k->value >= COUNTER_MAX ? 0 : k->value + 1);
    if(down && !k->down) set_count(k, k->value <= 0 ? COUNTER_MAX : k->value - 1);
    k->up = up;
    k->down = down;
    if(preset) set_count(k, k->preset);
    if(reset) set_count(k, 0);
    k->done = k->value == k->preset;
    k->empty = k->value == COUNTER_MAX && k->previous == 0;
    k->full = k->value == 0 && k->previous == COUNTER_MAX;
    set_outputs(r, x, y, k->empty, k->done, k->full);
}

/* Counts units of the base; the rest of a unit is kept. */
static void count_units(struct timer_iec *t, int ms)
{
    t->rest_ms += ms;
    t->value += t->rest_ms / t->base_ms;
    t->rest_ms %= t->base_ms;
}

static void timer_iec(struct ladder *l, struct rung *r, const struct cell *c, int x, int y, int ms)
{
    struct timer_iec *t;
    int in = input(r, x - 1, y);
    if(c->var.number < 0 || c->var.number >= l->sizes.timers_iec) return;
    t = &LADDER(l, timers_iec, struct timer_iec)[c->var.number];
    switch(t->mode) {
    case IEC_TON:
        if(!in) {
            t->output = 0;
            t->value = 0;
        } else if(t->value < t->preset) {
            count_units(t, ms);
        } else {
            t->output = 1;
        }
        break;
    case IEC_TOF:
        if(in) {
            t->output = 1;
            t->value = 0;
            t->running = 0;
        } else {
            if(t->input) t->running = 1;
            if(t->running) {
                count_units(t, ms);
                if(t->value >= t->preset) {
                    t->output = 0;
                    t->value = 0;
                    t->running = 0;
                }
            }
        }
        break;
    default:
        if(in && !t->input && !t->running) {
            t->running = 1;
            t->output = 1;
            t->value = 0;
        } else if(t->running) {
            count_units(t, ms);
            if(t->value >= t->preset) {
                t->output = 0;
                t->value = 0;
                t->running = 0;
            }
        }
    }
    t->input = in;
    set_outputs(r, x, y, t->output, 0, -1);
}

static const struct expression *expression(const struct ladder *l, int number)
{
    if(number < 0 || number >= l->sizes.expressions) return NULL;
    return &LADDER((struct ladder *)(uintptr_t)l, expressions, struct expression)[number];
}

/* ---- Rungs ----------------------------------------------------------------- */

enum next { GO_ON, JUMP, CALL };

/* Evaluates a cell; what comes next. */
static enum next evaluate(struct ladder *l, struct rung *r, int x, int y, int ms)
{
    struct cell *c = &r->cell[y][x];
    const struct expression *e;
    switch(c->type) {
    case EL_NO: case EL_NC: case EL_RISING: case EL_FALLING:
        contact(l, r, c, x, y);
        break;
    case EL_CONNECTION:
        c->output = left_of(r, x, y);
        break;
    case EL_COIL: case EL_COIL_NC: case EL_SET: case EL_RESET:
        coil(l, r, c, x, y);
        break;
    case EL_TIMER:
        timer(l, r, c, x, y, ms);
        break;
    case EL_MONOSTABLE:
        monostable(l, r, c, x, y, ms);
        break;
    case EL_COUNTER:
        counter(l, r, c, x, y);
        break;
    case EL_TIMER_IEC:
        timer_iec(l, r, c, x, y, ms);
        break;
    case EL_COMPARE:
        e = expression(l, c->var.number);
        c->output = input(r, x - 2, y) && e && ladder_compare(l, e);
        break;
    case EL_OPERATE:
        e = expression(l, c->var.number);
        c->output = input(r, x - 2, y);
        if(c->output && e) ladder_operate(l, e);
        break;
    case EL_JUMP: case EL_CALL:
        c->output = left_of(r, x, y);
        if(c->output) return c->type == EL_JUMP ? JUMP : CALL;
        break;
    case EL_OCCUPIED:
        break;                          /* the block sets its lines */
    default:
        c->output = 0;
    }
    return GO_ON;
}

static const struct section *subroutine(const struct ladder *l, int number)
{
    const struct section *s = LADDER((struct ladder *)(uintptr_t)l, sections, struct section);
    int i;
    for(i = 0; i < l->sizes.sections; i++)
        if(s[i].used && s[i].language == LANG_LADDER && s[i].subroutine == number) return &s[i];
    return NULL;
}

static void enter(struct frame *f, const struct section *s)
{
    f->section = s;
    f->rung = s->first_rung;
    f->x = f->y = 0;
}

/* Moves to the rung behind the present one; false at the end of the section. */
static int next_rung(struct ladder *l, struct frame *f)
{
    const struct rung *r = rung_at(l, f->rung);
    if(!r || f->rung == f->section->last_rung) return 0;
    f->rung = r->next;
    f->x = f->y = 0;
    return 1;
}

/* Evaluates from the frame's place to the end of its rung. */
static enum next rest_of_rung(struct ladder *l, struct rung *r, struct frame *f, int ms)
{
    for(; f->x < RUNG_WIDTH; f->x++, f->y = 0) {
        for(; f->y < RUNG_HEIGHT; f->y++) {
            enum next next = evaluate(l, r, f->x, f->y, ms);
            if(next != GO_ON) return next;
        }
    }
    return GO_ON;
}

/* How a section ended. */
enum end { END_DONE, END_GIVEN_UP, END_FAULT };

/* Scans a main section with the subroutines that it calls. A jump to a rung that does
 * not exist gives the scan up; too many jumps are a fault. */
static enum end scan_section(struct ladder *l, const struct section *section, int ms)
{
    struct frame stack[MAX_CALLS + 1];
    int top = 0, jumps = 0, rungs_left = MAX_JUMPS;
    enter(&stack[0], section);
    while(top >= 0 && rungs_left-- > 0) {
        struct frame *f = &stack[top];
        struct rung *r = rung_at(l, f->rung);
        enum next next;
        if(!r) {
            top--;
            continue;
        }
        next = rest_of_rung(l, r, f, ms);
        if(next == JUMP) {
            if(++jumps > MAX_JUMPS) return END_FAULT;
            f->rung = r->cell[f->y][f->x].var.number;
            f->x = f->y = 0;
            if(!rung_at(l, f->rung)) return END_GIVEN_UP;
        } else if(next == CALL) {
            const struct section *called = subroutine(l, r->cell[f->y][f->x].var.number);
            f->y++;                     /* go on there afterwards */
            if(called && top < MAX_CALLS) enter(&stack[++top], called);
        } else if(!next_rung(l, f)) {
            top--;
        }
    }
    return top < 0 ? END_DONE : END_FAULT;
}

int ladder_scan(struct ladder *l, int ms)
{
    const struct section *s = LADDER(l, sections, struct section);
    int i;
    for(i = 0; i < l->sizes.sections; i++) {
        if(!s[i].used) continue;
        if(s[i].language == LANG_SEQUENTIAL) {
            ladder_sequential(l, s[i].page, ms);
        } else if(s[i].subroutine < 0) {
            enum end end = scan_section(l, &s[i], ms);
            if(end != END_DONE) return end == END_FAULT ? -1 : 0;
        }
    }
    return 0;
}
