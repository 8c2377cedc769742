/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * state_tag.h - the interpreter's modal state that travels with each move.
 *
 * Written by the interpreter (through canon), carried by the planner,
 * published in the motion status while the move executes.
 */
#ifndef KERF_STATE_TAG_H
#define KERF_STATE_TAG_H

typedef enum { /* bit numbers in packed_flags */
    GM_FLAG_UNITS = 0,       /* 1: inch */
    GM_FLAG_DISTANCE_MODE,   /* 1: absolute (G90) */
    GM_FLAG_TOOL_OFFSETS_ON,
    GM_FLAG_RETRACT_OLDZ,
    GM_FLAG_BLEND,
    GM_FLAG_EXACT_STOP,
    GM_FLAG_FEED_INVERSE_TIME,
    GM_FLAG_FEED_UPM,
    GM_FLAG_CSS_MODE,
    GM_FLAG_IJK_ABS,
    GM_FLAG_DIAMETER_MODE,
    GM_FLAG_G92_IS_APPLIED,
    GM_FLAG_SPINDLE_ON,
    GM_FLAG_SPINDLE_CW,
    GM_FLAG_MIST,
    GM_FLAG_FLOOD,
    GM_FLAG_FEED_OVERRIDE,
    GM_FLAG_SPEED_OVERRIDE,
    GM_FLAG_ADAPTIVE_FEED,
    GM_FLAG_FEED_HOLD,
    GM_FLAG_RESTORABLE,
    GM_FLAG_IN_REMAP,
    GM_FLAG_IN_SUB,
    GM_FLAG_EXTERNAL_FILE,
    GM_FLAG_IS_CIRCLE,
    GM_FLAG_MAX_FLAGS
} StateFlag;

typedef enum {
    GM_FIELD_LINE_NUMBER = 0,
    GM_FIELD_G_MODE_0,
    GM_FIELD_CUTTER_COMP,
    GM_FIELD_MOTION_MODE, /* G code * 10 */
    GM_FIELD_PLANE,       /* G code * 10: 170, 180, 190, ... */
    GM_FIELD_M_MODES_4,
    GM_FIELD_ORIGIN,
    GM_FIELD_TOOLCHANGE,
    GM_FIELD_MACHINE_AXES, /* bit n: the move ends at a machine coordinate of axis n (G53, G28, G30) */
    GM_FIELD_CALL_LEVEL,   /* of the line, 0: the main program */
    GM_FIELD_MAIN_LINE,    /* line of the main program that is under way: this one, or the one that calls */
    GM_FIELD_MAX_FIELDS
} StateField;

typedef enum {
    GM_FIELD_FLOAT_LINE_NUMBER = 0,
    GM_FIELD_FLOAT_FEED,  /* program units per minute */
    GM_FIELD_FLOAT_SPEED,
    GM_FIELD_FLOAT_PATH_TOLERANCE,
    GM_FIELD_FLOAT_NAIVE_CAM_TOLERANCE,
    GM_FIELD_FLOAT_ARC_RADIUS,
    GM_FIELD_FLOAT_ARC_CENTER_X,
    GM_FIELD_FLOAT_ARC_CENTER_Y,
    GM_FIELD_FLOAT_ARC_CENTER_Z,
    GM_FIELD_FLOAT_STRAIGHT_HEADING, /* degrees */
    GM_FIELD_FLOAT_NORMAL_HEADING,   /* degrees */
    GM_FIELD_FLOAT_MAX_FIELDS
} StateFieldFloat;

#define STATE_TAG_FILENAME_LEN 256

struct state_tag_t {
    float fields_float[GM_FIELD_FLOAT_MAX_FIELDS];
    int fields[GM_FIELD_MAX_FIELDS];
    unsigned int packed_flags;
    char filename[STATE_TAG_FILENAME_LEN];
};
typedef struct state_tag_t state_tag_t;

/* 1 when flag number bit is set. [any] */
static inline int state_tag_flag(const struct state_tag_t *tag, int bit)
{
    return (int)((tag->packed_flags >> bit) & 1u);
}

#endif
