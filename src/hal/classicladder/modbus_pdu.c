/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * modbus_pdu.c - the contents of Modbus messages, without their transport.
 */
#include <string.h>
#include "classicladder/modbus.h"

enum { READ_COILS = 1, READ_INPUTS = 2, READ_HOLDING = 3, READ_INPUT_REGS = 4, WRITE_COIL = 5, WRITE_REG = 6,
       READ_STATUS = 7, DIAGNOSTICS = 8, WRITE_COILS = 15, WRITE_REGS = 16 };
enum { ILLEGAL_FUNCTION = 1, ILLEGAL_ADDRESS = 2, ILLEGAL_VALUE = 3 };
/* Requests of a project. */
enum { ASK_INPUTS = 0, PUT_COILS = 1, ASK_INPUT_REGS = 2, PUT_HOLDING = 3, ASK_COILS = 4, ASK_HOLDING = 5,
       ASK_STATUS = 6, ASK_DIAGNOSTICS = 7 };

#define MAX_SERVED_BITS 2000
#define MAX_SERVED_WORDS 120    /* what fits into a message */
#define MAX_ASKED_BITS 800      /* what fits into the buffers of both sides */
#define MAX_ASKED_WORDS 100

static int get16(const uint8_t *at)
{
    return at[0] << 8 | at[1];
}

static void put16(uint8_t *at, int value)
{
    at[0] = (uint8_t)(value >> 8);
    at[1] = (uint8_t)value;
}

/* ---- Server ---------------------------------------------------------------- */

static int refuse(const uint8_t *request, uint8_t *reply, int why)
{
    reply[0] = request[0] | 0x80;
    reply[1] = (uint8_t)why;
    return 2;
}

/* 0, or why count variables from address on cannot be had. */
static int check_range(int address, int count, int limit, int available)
{
    if(count < 1 || count > limit) return ILLEGAL_VALUE;
    return address + 1 + count > available ? ILLEGAL_ADDRESS : 0;
}

static int answer_bits(struct ladder *l, const uint8_t *request, uint8_t *reply)
{
    int address = get16(request + 1), count = get16(request + 3), i;
    int why = check_range(address, count, MAX_SERVED_BITS, l->sizes.bits);
    if(why) return refuse(request, reply, why);
    reply[0] = request[0];
    reply[1] = (uint8_t)((count + 7) / 8);
    memset(reply + 2, 0, reply[1]);
    for(i = 0; i < count; i++)
        if(ladder_read(l, VAR_B, address + 1 + i)) reply[2 + i / 8] |= (uint8_t)(1 << i % 8);
    return 2 + reply[1];
}

static int answer_words(struct ladder *l, const uint8_t *request, uint8_t *reply)
{
    int address = get16(request + 1), count = get16(request + 3), i;
    int why = check_range(address, count, MAX_SERVED_WORDS, l->sizes.words);
    if(why) return refuse(request, reply, why);
    reply[0] = request[0];
    reply[1] = (uint8_t)(2 * count);
    for(i = 0; i < count; i++) put16(reply + 2 + 2 * i, ladder_read(l, VAR_W, address + 1 + i));
    return 2 + reply[1];
}

static int answer_write_one(struct ladder *l, const uint8_t *request, uint8_t *reply)
{
    int address = get16(request + 1), value = get16(request + 3), bit = request[0] == WRITE_COIL, why;
    if(bit && value != 0 && value != 0xFF00) return refuse(request, reply, ILLEGAL_VALUE);
    why = check_range(address, 1, 1, bit ? l->sizes.bits : l->sizes.words);
    if(why) return refuse(request, reply, why);
    ladder_write(l, bit ? VAR_B : VAR_W, address + 1, bit ? value != 0 : value);
    memcpy(reply, request, 5);
    return 5;
}

static int answer_write_many(struct ladder *l, const uint8_t *request, int n, uint8_t *reply)
{
    int address = get16(request + 1), count = get16(request + 3), bit = request[0] == WRITE_COILS, i;
    int bytes = bit ? (count + 7) / 8 : 2 * count;
    int why = check_range(address, count, bit ? MAX_SERVED_BITS : MAX_SERVED_WORDS,
                          bit ? l->sizes.bits : l->sizes.words);
    if(!why && (request[5] != bytes || n < 6 + bytes)) why = ILLEGAL_VALUE;
    if(why) return refuse(request, reply, why);
    for(i = 0; i < count; i++) {
        if(bit) ladder_write(l, VAR_B, address + 1 + i, request[6 + i / 8] >> i % 8 & 1);
        else ladder_write(l, VAR_W, address + 1 + i, get16(request + 6 + 2 * i));
    }
    memcpy(reply, request, 5);
    return 5;
}

int modbus_answer(struct ladder *l, const uint8_t *request, int n, uint8_t reply[MODBUS_MAX_PDU])
{
    if(n < 1) return 0;
    if(n < 5) return refuse(request, reply, ILLEGAL_VALUE);
    switch(request[0]) {
    case READ_COILS: case READ_INPUTS: return answer_bits(l, request, reply);
    case READ_HOLDING: case READ_INPUT_REGS: return answer_words(l, request, reply);
    case WRITE_COIL: case WRITE_REG: return answer_write_one(l, request, reply);
    case WRITE_COILS: case WRITE_REGS:
        return n < 6 ? refuse(request, reply, ILLEGAL_VALUE) : answer_write_many(l, request, n, reply);
    default: return refuse(request, reply, ILLEGAL_FUNCTION);
    }
}

/* ---- Client ---------------------------------------------------------------- */

/* What kind of variable a request moves. */
static int mapped_type(const struct modbus_config *m, int kind)
{
    switch(kind) {
    case ASK_INPUTS: return m->map_read_inputs;
    case PUT_COILS: return m->map_write_coils;
    case ASK_INPUT_REGS: return m->map_read_input_regs;
    case PUT_HOLDING: return m->map_write_hold_regs;
    case ASK_COILS: return m->map_read_coils;
    case ASK_HOLDING: return m->map_read_hold_regs;
    default: return VAR_W;
    }
}

static int is_bits(int kind)
{
    return kind == ASK_INPUTS || kind == PUT_COILS || kind == ASK_COILS;
}

static int build_write(const struct ladder *l, const struct modbus_request *q, uint8_t *request)
{
    int type = mapped_type(&l->modbus, q->kind), bits = is_bits(q->kind), i, bytes;
    if(q->count == 1) {
        int value = ladder_read(l, type, q->offset);
        request[0] = bits ? WRITE_COIL : WRITE_REG;
        if(bits) value = (value != 0) != (q->inverted != 0) ? 0xFF00 : 0;
        put16(request + 3, value);
        return 5;
    }
    bytes = bits ? (q->count + 7) / 8 : 2 * q->count;
    request[0] = bits ? WRITE_COILS : WRITE_REGS;
    put16(request + 3, q->count);
    request[5] = (uint8_t)bytes;
    memset(request + 6, 0, (size_t)bytes);
    for(i = 0; i < q->count; i++) {
        int value = ladder_read(l, type, q->offset + i);
        if(!bits) put16(request + 6 + 2 * i, value);
        else if((value != 0) != (q->inverted != 0)) request[6 + i / 8] |= (uint8_t)(1 << i % 8);
    }
    return 6 + bytes;
}

int modbus_build(const struct ladder *l, const struct modbus_request *q, uint8_t request[MODBUS_MAX_PDU])
{
    static const uint8_t functions[] = { READ_INPUTS, 0, READ_INPUT_REGS, 0, READ_COILS, READ_HOLDING, READ_STATUS,
                                         DIAGNOSTICS };
    int address = q->first - l->modbus.element_offset;
    if(q->kind < ASK_INPUTS || q->kind > ASK_DIAGNOSTICS) return 0;
    if(q->kind == ASK_STATUS) {
        request[0] = READ_STATUS;
        return 1;
    }
    if(q->kind == ASK_DIAGNOSTICS) {
        memset(request, 0, 5);
        request[0] = DIAGNOSTICS;
        return 5;
    }
    if(q->count < 1 || q->count > (is_bits(q->kind) ? MAX_ASKED_BITS : MAX_ASKED_WORDS)) return 0;
    if(address < 0 || address > 0xFFFF) return 0;
    put16(request + 1, address);
    if(q->kind == PUT_COILS || q->kind == PUT_HOLDING) return build_write(l, q, request);
    request[0] = functions[q->kind];
    put16(request + 3, q->count);
    return 5;
}

int modbus_take(struct ladder *l, const struct modbus_request *q, const uint8_t *request, const uint8_t *reply, int n)
{
    int type = mapped_type(&l->modbus, q->kind), i;
    if(n < 2 || reply[0] != request[0]) return -1;
    switch(q->kind) {
    case ASK_INPUTS: case ASK_COILS:
        if(n < 2 + (q->count + 7) / 8) return -1;
        for(i = 0; i < q->count; i++) {
            int value = reply[2 + i / 8] >> i % 8 & 1;
            ladder_force(l, type, q->offset + i, value != (q->inverted != 0));
        }
        return 0;
    case ASK_INPUT_REGS: case ASK_HOLDING:
        if(n < 2 + 2 * q->count) return -1;
        for(i = 0; i < q->count; i++) ladder_force(l, type, q->offset + i, (int16_t)get16(reply + 2 + 2 * i));
        return 0;
    case ASK_STATUS:
        ladder_force(l, type, q->offset, reply[1]);
        return 0;
    case ASK_DIAGNOSTICS:
        return n < 5 ? -1 : 0;
    default:
        return n < 5 ? -1 : 0;
    }
}
