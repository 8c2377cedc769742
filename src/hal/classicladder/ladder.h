/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ladder.h - a ladder program: its data in shared memory and what works on them.
 *
 * The realtime module owns the segment (LADDER_SHM_KEY) and scans it; the user
 * program loads projects into it. `state` says who may touch the program: the realtime
 * side only in LADDER_RUN, the user side only after ladder_stop() has returned. Single
 * variables may be read and written by both at any time.
 *
 * Everything is integers; bits are 0 or 1. The segment is addressed by offsets from its
 * beginning, so each process may map it where it likes.
 */
#ifndef LADDER_H
#define LADDER_H

#include <stddef.h>
#include <stdint.h>

#define LADDER_SHM_KEY 0x434C522b
#define LADDER_VERSION 1

#define RUNG_WIDTH 10
#define RUNG_HEIGHT 6
#define LABEL_LEN 20
#define COMMENT_LEN 50
#define EXPR_LEN 50             /* with the NUL */
#define SECTION_NAME_LEN 20
#define SYMBOL_LEN 10
#define SYMBOL_COMMENT_LEN 50
#define VAR_NAME_LEN 10
#define SYSTEM_BITS 20
#define ERROR_BITS 10
#define STEPS 128
#define TRANSITIONS 256
#define SWITCHES 10
#define SEQ_PAGES 5
#define SEQ_COMMENTS 50
#define MAX_JUMPS 99999
#define MAX_CALLS 16            /* nested */
#define MAX_OPS 64              /* of a compiled expression */
#define MAX_PASSES 50           /* over the transitions of a page in one scan */
#define MODBUS_REQUESTS 20

/* What stands in a cell of a rung. */
enum element {
    EL_FREE = 0, EL_NO = 1, EL_NC = 2, EL_RISING = 3, EL_FALLING = 4, EL_CONNECTION = 9, EL_TIMER = 10,
    EL_MONOSTABLE = 11, EL_COUNTER = 12, EL_TIMER_IEC = 13, EL_COMPARE = 20, EL_COIL = 50, EL_COIL_NC = 51,
    EL_SET = 52, EL_RESET = 53, EL_JUMP = 54, EL_CALL = 55, EL_OPERATE = 60, EL_OCCUPIED = 99
};

/* Kinds of variables, with the codes of the project files. */
enum var {
    VAR_B = 0, VAR_T_D = 10, VAR_T_R = 11, VAR_TM_Q = 15, VAR_M_R = 20, VAR_C_D = 25, VAR_C_E = 26, VAR_C_F = 27,
    VAR_X = 30, VAR_I = 50, VAR_Q = 60, VAR_S = 70, VAR_E = 75,
    VAR_W = 200, VAR_X_V = 220, VAR_T_P = 230, VAR_T_V = 231, VAR_M_P = 240, VAR_M_V = 241, VAR_C_P = 250,
    VAR_C_V = 251, VAR_TM_P = 260, VAR_TM_V = 261, VAR_IW = 270, VAR_QW = 280, VAR_SW = 290, VAR_IF = 300,
    VAR_QF = 310
};

enum ladder_state { LADDER_LOADING = 0, LADDER_STOP = 1, LADDER_RUN = 2 };
enum language { LANG_LADDER = 0, LANG_SEQUENTIAL = 1 };
enum iec_mode { IEC_TON = 0, IEC_TOF = 1, IEC_TP = 2 };

/* How many of each; fixed when the module is loaded. */
struct ladder_sizes {
    int32_t rungs, bits, words, timers, monostables, counters, timers_iec, inputs, outputs, expressions, sections,
        symbols, s32_in, s32_out, float_in, float_out;
};

/* A variable; index_type < 0: no index, else the value of that variable is added. */
struct var_ref {
    int32_t type, number, index_type, index_number;
};

struct cell {
    int16_t type;
    int16_t with_top;           /* the left side is connected with that of the cell above */
    struct var_ref var;
    int32_t output, before;     /* of the scan: state on the right; variable at the last evaluation */
};

struct rung {
    int32_t used, prev, next;
    char label[LABEL_LEN], comment[COMMENT_LEN];
    struct cell cell[RUNG_HEIGHT][RUNG_WIDTH];
};

struct section {
    int32_t used, language, subroutine, first_rung, last_rung, page;
    char name[SECTION_NAME_LEN];
};

/* Old timers and monostables: times in ms. */
struct timer {
    int32_t base_ms, preset, value;     /* preset and value in ms */
    int32_t running, done, input;
};
struct counter {
    int32_t preset, value, previous;
    int32_t done, empty, full, up, down, at_preset, at_reset;
};
struct timer_iec {
    int32_t base_ms, mode, preset, value;   /* preset and value in units of the base */
    int32_t output, input, running, rest_ms;
};

/* A compiled expression: operations of a stack machine. */
struct op {
    int32_t code;               /* enum opcode in ladder_expr.c */
    int32_t value;              /* a constant; how many arguments */
    struct var_ref var;
};
struct expression {
    char text[EXPR_LEN];
    int32_t valid;              /* it could be compiled, or is empty or a comment */
    int32_t is_assignment;      /* else a comparison */
    struct var_ref target;      /* of an assignment */
    int32_t length;
    struct op op[MAX_OPS];
};

struct step {
    int32_t used, initial, number, page, x, y;
    int32_t active, shown;      /* shown: %X and %X.V, as of the last pass over the page */
    int64_t active_ms, shown_ms;
};
struct transition {
    int32_t used, page, x, y;
    struct var_ref condition;
    int32_t activate[SWITCHES], deactivate[SWITCHES], starts[SWITCHES], ends[SWITCHES];     /* -1: none */
};
struct seq_comment {
    int32_t used, page, x, y;
    char text[COMMENT_LEN];
};

struct symbol {
    char variable[VAR_NAME_LEN], name[SYMBOL_LEN], comment[SYMBOL_COMMENT_LEN];
};

struct modbus_request {
    char slave[32];
    int32_t used, kind, first, count, inverted, offset;
};
struct modbus_config {
    char serial_port[64];
    int32_t speed, data_bits, stop_bits, parity, element_offset, use_rts;
    int32_t inter_frame_ms, time_out_ms, after_transmit_ms, debug_level;
    int32_t map_read_inputs, map_read_coils, map_write_coils, map_read_input_regs, map_read_hold_regs,
        map_write_hold_regs;
    struct modbus_request request[MODBUS_REQUESTS];
};

/* The head of the segment; arrays follow, at these offsets. */
struct ladder {
    uint32_t version, size;
    int32_t state;              /* atomic; enum ladder_state; written by the user side, by the scan on a fault */
    int32_t scanning;           /* atomic; written by the realtime side */
    int32_t refresh_ms;         /* of the project; for displays */
    struct ladder_sizes sizes;
    struct modbus_config modbus;
    int32_t system_bits[SYSTEM_BITS], error_bits[ERROR_BITS];
    struct step step[STEPS];
    struct transition transition[TRANSITIONS];
    struct seq_comment seq_comment[SEQ_COMMENTS];
    uint32_t rungs, bits, words, timers, monostables, counters, timers_iec, inputs, outputs, expressions, sections,
        symbols, s32_in, s32_out, float_in, float_out;
};

/* Array of the ladder: LADDER(l, rungs, struct rung)[3]. */
#define LADDER(l, member, type) ((type *)(void *)((char *)(l) + (l)->member))

/* ---- ladder_data.c -------------------------------------------------------- */

/* [any] Bytes that a segment of these sizes needs. */
size_t ladder_size(const struct ladder_sizes *sizes);
/* [init] Lays an empty ladder out in zeroed memory of ladder_size() bytes. */
void ladder_layout(struct ladder *l, const struct ladder_sizes *sizes);
/* [init] Takes the program away: no rungs, one section, default timers. Stopped only. */
void ladder_clear(struct ladder *l);
/* [init] Timers, counters, edges and steps as at the start of the program. */
void ladder_reset(struct ladder *l);

/* [any] Value of a variable; one that does not exist is 0. */
int ladder_read(const struct ladder *l, int type, int number);
/* [any] Sets a variable that programs may write; nothing else. */
void ladder_write(struct ladder *l, int type, int number, int value);
/* [any] The same through a reference with its index. */
int ladder_read_ref(const struct ladder *l, const struct var_ref *ref);
void ladder_write_ref(struct ladder *l, const struct var_ref *ref, int value);
/* [any] Sets a variable whoever may write it (inputs, system bits): for the drivers of the ladder. */
void ladder_force(struct ladder *l, int type, int number, int value);

/* [any] 1 when variables of this type are bits. */
static inline int ladder_is_bit(int type)
{
    return type < VAR_W;
}

/* ---- ladder_expr.c -------------------------------------------------------- */

/* [init] Compiles e->text as an assignment or a comparison. e->valid tells whether
 * that was possible; an empty text or a comment is valid and does nothing. */
void ladder_compile(struct expression *e, int is_assignment);
/* [rt] Whether a comparison holds; invalid and empty ones do not. Bounded by MAX_OPS. */
int ladder_compare(const struct ladder *l, const struct expression *e);
/* [rt] Does an assignment. */
void ladder_operate(struct ladder *l, const struct expression *e);

/* ---- ladder_scan.c, ladder_seq.c ------------------------------------------ */

/* [rt] One pass over the program; ms: time since the last. Returns 0, or -1 when it had
 * to be given up (too many jumps): the caller stops the ladder. */
int ladder_scan(struct ladder *l, int ms);
/* [rt] One pass over a page of the sequential chart. */
void ladder_sequential(struct ladder *l, int page, int ms);

#endif
