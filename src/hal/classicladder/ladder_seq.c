/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ladder_seq.c - one pass over a page of the sequential chart (Grafcet).
 *
 * Thread: [rt]; bounded by MAX_PASSES x TRANSITIONS x SWITCHES
 */
#include "classicladder/ladder.h"

static struct step *step(struct ladder *l, int number)
{
    return number >= 0 && number < STEPS && l->step[number].used ? &l->step[number] : NULL;
}

static void set_steps(struct ladder *l, const int32_t *steps, int active)
{
    int i;
    for(i = 0; i < SWITCHES; i++) {
        struct step *s = step(l, steps[i]);
        if(!s) continue;
        s->active = active;
        s->active_ms = 0;
    }
}

/* Every step before the transition is active, and there is one. */
static int is_enabled(struct ladder *l, const struct transition *t)
{
    int i, any = 0;
    for(i = 0; i < SWITCHES; i++) {
        const struct step *s = step(l, t->deactivate[i]);
        if(!s) continue;
        if(!s->active) return 0;
        any = 1;
    }
    return any;
}

void ladder_sequential(struct ladder *l, int page, int ms)
{
    int pass, i, changed = 1;
    for(i = 0; i < STEPS; i++) {
        struct step *s = &l->step[i];
        if(s->used && s->page == page && s->active) s->active_ms += ms;
    }
    for(pass = 0; changed && pass < MAX_PASSES; pass++) {
        changed = 0;
        for(i = 0; i < TRANSITIONS; i++) {
            struct transition *t = &l->transition[i];
            if(!t->used || t->page != page || !is_enabled(l, t) || !ladder_read_ref(l, &t->condition)) continue;
            set_steps(l, t->deactivate, 0);
            set_steps(l, t->activate, 1);
            changed = 1;
        }
    }
    for(i = 0; i < STEPS; i++) {
        struct step *s = &l->step[i];
        if(!s->used || s->page != page) continue;
        s->shown = s->active;
        s->shown_ms = s->active_ms;
    }
}
