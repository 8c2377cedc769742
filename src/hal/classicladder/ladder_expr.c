/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ladder_expr.c - arithmetic of the ladder: text to operations of a stack machine, and
 * their execution.
 *
 * Thread: ladder_compile [init]; ladder_compare, ladder_operate [rt], bounded by MAX_OPS
 *
 * Grammar, from the weakest: or := xor ('|' xor)*; xor := and ('^' and)*;
 * and := sum ('&' sum)*; sum := product (('+' | '-') product)*;
 * product := power (('*' | '/' | '%') power)*; power := term ('^' term)*;
 * term := '!' term | '(' or ')' | number | '-' term | '$' hex | '\'' char '\'' | variable |
 * function '(' or (',' or)* ')'. A '^' is therefore always a power, which squares the left
 * side as many times as the right side says.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include "classicladder/ladder.h"

#define MAX_SQUARINGS 32        /* more change nothing: the value is 0 or 1 by then */

enum opcode {
    OP_CONST, OP_VAR, OP_OR, OP_XOR, OP_AND, OP_ADD, OP_SUB, OP_MUL, OP_DIV, OP_MOD, OP_POW, OP_NOT,
    OP_ABS, OP_MIN, OP_MAX, OP_AVG, OP_LT, OP_GT, OP_EQ, OP_LE, OP_GE, OP_NE
};

/* ---- Compiling ------------------------------------------------------------- */

struct parser {
    const char *at;
    struct expression *e;
    int bad, depth;
};

static void skip(struct parser *p)
{
    while(isspace((unsigned char)*p->at)) p->at++;
}

static int accept(struct parser *p, char c)
{
    skip(p);
    if(*p->at != c) return 0;
    p->at++;
    return 1;
}

static struct op *emit(struct parser *p, enum opcode code, int value)
{
    static struct op nowhere;
    struct op *op;
    if(p->e->length >= MAX_OPS) {
        p->bad = 1;
        return &nowhere;
    }
    op = &p->e->op[p->e->length++];
    op->code = code;
    op->value = value;
    return op;
}

static long number(struct parser *p, int base)
{
    char *end;
    long value = strtol(p->at, &end, base);
    if(end == p->at) p->bad = 1;
    p->at = end;
    return value;
}

/* type/number[type/number], between the @ signs. */
static struct var_ref variable(struct parser *p)
{
    struct var_ref ref = { 0, 0, -1, 0 };
    ref.type = (int32_t)number(p, 10);
    if(!accept(p, '/')) p->bad = 1;
    ref.number = (int32_t)number(p, 10);
    if(accept(p, '[')) {
        ref.index_type = (int32_t)number(p, 10);
        if(!accept(p, '/')) p->bad = 1;
        ref.index_number = (int32_t)number(p, 10);
        if(!accept(p, ']')) p->bad = 1;
    }
    if(!accept(p, '@')) p->bad = 1;
    return ref;
}

static void weakest(struct parser *p);

static void function(struct parser *p)
{
    static const struct {
        const char *name;
        enum opcode code;
    } functions[] = { { "ABS", OP_ABS }, { "MINI", OP_MIN }, { "MAXI", OP_MAX }, { "MOY", OP_AVG }, { "AVG", OP_AVG } };
    size_t i, length = 0;
    int count = 0;
    while(isalpha((unsigned char)p->at[length])) length++;
    for(i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        if(strlen(functions[i].name) != length || strncmp(p->at, functions[i].name, length)) continue;
        p->at += length;
        if(!accept(p, '(')) break;
        do {
            weakest(p);
            count++;
        } while(!p->bad && accept(p, ','));
        if(!accept(p, ')') || (functions[i].code == OP_ABS && count != 1)) break;
        emit(p, functions[i].code, count);
        return;
    }
    p->bad = 1;
}

static void term(struct parser *p)
{
    if(++p->depth > EXPR_LEN) p->bad = 1;
    skip(p);
    if(p->bad) {
    } else if(accept(p, '!')) {
        term(p);
        emit(p, OP_NOT, 0);
    } else if(accept(p, '(')) {
        weakest(p);
        if(!accept(p, ')')) p->bad = 1;
    } else if(accept(p, '$')) {
        emit(p, OP_CONST, (int)number(p, 16));
    } else if(*p->at == '\'' && p->at[1] && p->at[2] == '\'') {
        emit(p, OP_CONST, (unsigned char)p->at[1]);
        p->at += 3;
    } else if(accept(p, '@')) {
        struct var_ref ref = variable(p);
        emit(p, OP_VAR, 0)->var = ref;
    } else if(isdigit((unsigned char)*p->at) || (*p->at == '-' && isdigit((unsigned char)p->at[1]))) {
        emit(p, OP_CONST, (int)number(p, 10));
    } else if(accept(p, '-')) {
        emit(p, OP_CONST, 0);
        term(p);
        emit(p, OP_SUB, 0);
    } else {
        function(p);
    }
    p->depth--;
}

static void power(struct parser *p)
{
    term(p);
    while(!p->bad && accept(p, '^')) {
        term(p);
        emit(p, OP_POW, 0);
    }
}

static void product(struct parser *p)
{
    power(p);
    while(!p->bad) {
        enum opcode code = accept(p, '*') ? OP_MUL : accept(p, '/') ? OP_DIV : accept(p, '%') ? OP_MOD : OP_CONST;
        if(code == OP_CONST) return;
        power(p);
        emit(p, code, 0);
    }
}

static void sum(struct parser *p)
{
    product(p);
    while(!p->bad) {
        enum opcode code = accept(p, '+') ? OP_ADD : accept(p, '-') ? OP_SUB : OP_CONST;
        if(code == OP_CONST) return;
        product(p);
        emit(p, code, 0);
    }
}

static void conjunction(struct parser *p)
{
    sum(p);
    while(!p->bad && accept(p, '&')) {
        sum(p);
        emit(p, OP_AND, 0);
    }
}

static void exclusive(struct parser *p)
{
    conjunction(p);
    while(!p->bad && accept(p, '^')) {
        conjunction(p);
        emit(p, OP_XOR, 0);
    }
}

static void weakest(struct parser *p)
{
    if(++p->depth > EXPR_LEN) p->bad = 1;
    exclusive(p);
    while(!p->bad && accept(p, '|')) {
        exclusive(p);
        emit(p, OP_OR, 0);
    }
    p->depth--;
}

static void comparison(struct parser *p)
{
    enum opcode code;
    weakest(p);
    skip(p);
    if(accept(p, '<')) code = accept(p, '=') ? OP_LE : accept(p, '>') ? OP_NE : OP_LT;
    else if(accept(p, '>')) code = accept(p, '=') ? OP_GE : OP_GT;
    else if(accept(p, '=')) code = OP_EQ;
    else {
        p->bad = 1;
        return;
    }
    weakest(p);
    emit(p, code, 0);
}

static void assignment(struct parser *p)
{
    if(!accept(p, '@')) {
        p->bad = 1;
        return;
    }
    p->e->target = variable(p);
    accept(p, ':');
    if(!accept(p, '=')) p->bad = 1;
    else weakest(p);
}

void ladder_compile(struct expression *e, int is_assignment)
{
    struct parser p = { e->text, e, 0, 0 };
    e->is_assignment = is_assignment;
    e->length = 0;
    e->valid = 1;
    skip(&p);
    if(*p.at == 0 || *p.at == '#') return;
    if(is_assignment) assignment(&p);
    else comparison(&p);
    skip(&p);
    if(p.bad || *p.at != 0) {
        e->valid = 0;
        e->length = 0;
    }
}

/* ---- Execution ------------------------------------------------------------- */

static int32_t power_of(int32_t x, int32_t times)
{
    uint32_t value = (uint32_t)x;
    int i;
    for(i = 0; i < times && i < MAX_SQUARINGS; i++) value *= value;
    return (int32_t)value;
}

static int32_t divide(int32_t a, int32_t b, int remainder)
{
    if(b == 0) return 0;
    if(b == -1) return remainder ? 0 : (int32_t)(0u - (uint32_t)a);
    return remainder ? a % b : a / b;
}

static int32_t binary(enum opcode code, int32_t a, int32_t b)
{
    switch(code) {
    case OP_OR: return a | b;
    case OP_XOR: return a ^ b;
    case OP_AND: return a & b;
    case OP_ADD: return (int32_t)((uint32_t)a + (uint32_t)b);
    case OP_SUB: return (int32_t)((uint32_t)a - (uint32_t)b);
    case OP_MUL: return (int32_t)((uint32_t)a * (uint32_t)b);
    case OP_DIV: return divide(a, b, 0);
    case OP_MOD: return divide(a, b, 1);
    case OP_POW: return power_of(a, b);
    case OP_LT: return a < b;
    case OP_GT: return a > b;
    case OP_EQ: return a == b;
    case OP_LE: return a <= b;
    case OP_GE: return a >= b;
    default: return a != b;
    }
}

/* The last n values as one. */
static int32_t combine(enum opcode code, const int32_t *values, int n)
{
    int64_t total = values[0];
    int i;
    for(i = 1; i < n; i++) {
        if(code == OP_AVG) total += values[i];
        else if(code == OP_MIN ? values[i] < total : values[i] > total) total = values[i];
    }
    return (int32_t)(code == OP_AVG ? total / n : total);
}

/* Executes the operations; the value that remains. */
static int32_t execute(const struct ladder *l, const struct expression *e)
{
    int32_t stack[MAX_OPS + 1];
    int top = 0, i;
    for(i = 0; i < e->length; i++) {
        const struct op *op = &e->op[i];
        switch((enum opcode)op->code) {
        case OP_CONST:
            stack[top++] = op->value;
            break;
        case OP_VAR:
            stack[top++] = ladder_read_ref(l, &op->var);
            break;
        case OP_NOT:
            stack[top - 1] = !stack[top - 1];
            break;
        case OP_ABS:
            if(stack[top - 1] < 0) stack[top - 1] = (int32_t)(0u - (uint32_t)stack[top - 1]);
            break;
        case OP_MIN: case OP_MAX: case OP_AVG:
            top -= op->value;
            stack[top] = combine((enum opcode)op->code, &stack[top], op->value);
            top++;
            break;
        default:
            top--;
            stack[top - 1] = binary((enum opcode)op->code, stack[top - 1], stack[top]);
        }
    }
    return top > 0 ? stack[top - 1] : 0;
}

int ladder_compare(const struct ladder *l, const struct expression *e)
{
    return !e->is_assignment && e->length > 0 && execute(l, e) != 0;
}

void ladder_operate(struct ladder *l, const struct expression *e)
{
    if(e->is_assignment && e->length > 0) ladder_write_ref(l, &e->target, execute(l, e));
}
