/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_stream.c - records of values from one writer to one reader.
 *
 * In:     shared memory of its own under the stream's key
 * Thread: create, attach, detach [init]; the rest [rt]; the waits [user]
 * Method: ring of depth records; one stays free. Each index is written by one side.
 */
#include "hal_priv.h"

#include <ctype.h>
#include <errno.h>
#include <string.h>
#include "kerf_clock.h"

#define STREAM_MAGIC 0x4b53544du

struct hal_stream_shm {
    _Atomic uint32_t magic;  /* STREAM_MAGIC once usable */
    uint32_t depth;          /* places; one stays free */
    uint32_t count;          /* values in a record */
    int8_t types[HAL_STREAM_MAX_PINS]; /* hal_type_t */
    _Atomic uint32_t in __attribute__((aligned(64))); /* written by the writer */
    uint32_t sampleno;       /* of the last record */
    _Atomic uint32_t overruns;
    _Atomic uint32_t out __attribute__((aligned(64))); /* written by the reader */
    _Atomic uint32_t underruns;
    hal_stream_data_u data[] __attribute__((aligned(64))); /* records: count values, the number */
};

static const char *type_name(int type)
{
    static const char *const names[] = {[HAL_BIT] = "bit",   [HAL_FLOAT] = "float", [HAL_S32] = "s32",
                                        [HAL_U32] = "u32",   [HAL_PORT] = "port",   [HAL_S64] = "s64",
                                        [HAL_U64] = "u64"};
    return type >= HAL_BIT && type <= HAL_U64 ? names[type] : "UNK#0";
}

/* Number of values, or -EINVAL after a message. */
static int parse_types(int8_t *types, const char *text)
{
    int n = 0;
    if (!text || !*text) {
        halp_err("stream: ERROR: invalid null or empty type-string\n");
        return -EINVAL;
    }
    for (const char *p = text; *p; p++, n++) {
        int type;
        switch (tolower((unsigned char)*p)) {
        case 'f':
        case 'r': type = HAL_FLOAT; break;
        case 'b': type = HAL_BIT; break;
        case 's': type = HAL_S32; break;
        case 'u': type = HAL_U32; break;
        case 'l': type = HAL_S64; break;
        case 'k': type = HAL_U64; break;
        default:
            halp_err("stream: ERROR: unknown type '%c', must be R (F), B, U, S, L or K\n", *p);
            return -EINVAL;
        }
        if (n == HAL_STREAM_MAX_PINS) {
            halp_err("stream: ERROR: more than %d items\n", HAL_STREAM_MAX_PINS);
            return -EINVAL;
        }
        types[n] = (int8_t)type;
    }
    return n;
}

static unsigned long stream_size(unsigned count, unsigned depth)
{
    return sizeof(struct hal_stream_shm) + (unsigned long)depth * (count + 1) * sizeof(hal_stream_data_u);
}

int hal_stream_create(hal_stream_t *stream, int comp_id, int key, unsigned depth, const char *types)
{
    int8_t parsed[HAL_STREAM_MAX_PINS] = {0};
    if (!stream) {
        halp_err("hal_stream_create: Invalid stream\n");
        return -EINVAL;
    }
    int n = parse_types(parsed, types);
    if (n < 0) {
        return n;
    }
    if (depth < 1 || depth > 0x7fffffffu / ((unsigned)(n + 1) * 8)) {
        halp_err("stream: ERROR: invalid depth %u\n", depth);
        return -EINVAL;
    }
    int id = rtapi_shmem_new(key, comp_id, stream_size((unsigned)n, depth));
    if (id < 0) {
        return id;
    }
    void *mem;
    int result = rtapi_shmem_getptr(id, &mem);
    if (result < 0) {
        rtapi_shmem_delete(id, comp_id);
        return result;
    }
    struct hal_stream_shm *f = mem;
    atomic_store(&f->magic, 0);
    memset(f, 0, sizeof *f);
    f->depth = depth;
    f->count = (uint32_t)n;
    memcpy(f->types, parsed, sizeof parsed);
    atomic_store(&f->magic, STREAM_MAGIC);
    *stream = (hal_stream_t){.comp_id = comp_id, .shmem_id = id, .fifo = f};
    return 0;
}

int hal_stream_attach(hal_stream_t *stream, int comp_id, int key, const char *types)
{
    int8_t parsed[HAL_STREAM_MAX_PINS] = {0};
    int n = 0;
    if (!stream) {
        halp_err("hal_stream_attach: Invalid stream\n");
        return -EINVAL;
    }
    if (types && (n = parse_types(parsed, types)) < 0) {
        return n;
    }
    int id = rtapi_shmem_new(key, comp_id, sizeof(struct hal_stream_shm));
    if (id < 0) {
        return id;
    }
    void *mem;
    if (rtapi_shmem_getptr(id, &mem) < 0) {
        rtapi_shmem_delete(id, comp_id);
        return -EINVAL;
    }
    struct hal_stream_shm *f = mem;
    if (atomic_load(&f->magic) != STREAM_MAGIC) {
        rtapi_shmem_delete(id, comp_id);
        return -EINVAL;
    }
    for (int i = 0; i < n; i++) {
        int have = (uint32_t)i < f->count ? f->types[i] : 0;
        if (parsed[i] != have) {
            halp_err("hal_stream_attach: Type mismatch: types[%d]: '%s' != '%s'\n", i, type_name(parsed[i]),
                     type_name(have));
            rtapi_shmem_delete(id, comp_id);
            return -EINVAL;
        }
    }
    *stream = (hal_stream_t){.comp_id = comp_id, .shmem_id = id, .fifo = f};
    return 0;
}

static bool invalid(const hal_stream_t *stream, const char *who)
{
    if (stream && stream->fifo) {
        return false;
    }
    halp_err("%s: Invalid stream\n", who);
    return true;
}

int hal_stream_detach(hal_stream_t *stream)
{
    if (invalid(stream, __func__)) {
        return -EINVAL;
    }
    stream->fifo = NULL;
    return rtapi_shmem_delete(stream->shmem_id, stream->comp_id);
}

void hal_stream_destroy(hal_stream_t *stream)
{
    if (!invalid(stream, __func__)) {
        atomic_store(&stream->fifo->magic, 0);
        stream->fifo = NULL;
        rtapi_shmem_delete(stream->shmem_id, stream->comp_id);
    }
}

int hal_stream_element_count(hal_stream_t *stream)
{
    return invalid(stream, __func__) ? 0 : (int)stream->fifo->count;
}

hal_type_t hal_stream_element_type(hal_stream_t *stream, int idx)
{
    if (invalid(stream, __func__)) {
        return HAL_TYPE_UNSPECIFIED;
    }
    if (idx < 0 || (uint32_t)idx >= stream->fifo->count) {
        halp_err("hal_stream_element_type: Invalid type index %d (valid [0,%d])\n", idx, (int)stream->fifo->count - 1);
        return HAL_TYPE_UNSPECIFIED;
    }
    return (hal_type_t)stream->fifo->types[idx];
}

static uint32_t after(const struct hal_stream_shm *f, uint32_t at)
{
    return at + 1 < f->depth ? at + 1 : 0;
}

static bool is_readable(struct hal_stream_shm *f)
{
    return atomic_load_explicit(&f->in, memory_order_acquire) != atomic_load_explicit(&f->out, memory_order_relaxed);
}

static bool is_writable(struct hal_stream_shm *f)
{
    return after(f, atomic_load_explicit(&f->in, memory_order_relaxed)) !=
           atomic_load_explicit(&f->out, memory_order_acquire);
}

bool hal_stream_readable(hal_stream_t *stream)
{
    return !invalid(stream, __func__) && is_readable(stream->fifo);
}

bool hal_stream_writable(hal_stream_t *stream)
{
    return !invalid(stream, __func__) && is_writable(stream->fifo);
}

int hal_stream_depth(hal_stream_t *stream)
{
    if (invalid(stream, __func__)) {
        return 0;
    }
    struct hal_stream_shm *f = stream->fifo;
    uint32_t in = atomic_load_explicit(&f->in, memory_order_acquire);
    uint32_t out = atomic_load_explicit(&f->out, memory_order_acquire);
    return (int)(in >= out ? in - out : in + f->depth - out);
}

unsigned hal_stream_maxdepth(hal_stream_t *stream)
{
    return invalid(stream, __func__) ? 0 : stream->fifo->depth;
}

int hal_stream_num_underruns(hal_stream_t *stream)
{
    return invalid(stream, __func__)
               ? -EINVAL
               : (int)atomic_load_explicit(&stream->fifo->underruns, memory_order_relaxed);
}

int hal_stream_num_overruns(hal_stream_t *stream)
{
    return invalid(stream, __func__) ? -1 : (int)atomic_load_explicit(&stream->fifo->overruns, memory_order_relaxed);
}

int hal_stream_read(hal_stream_t *stream, hal_stream_data_u *buf, unsigned *sampleno)
{
    if (invalid(stream, __func__)) {
        return -EINVAL;
    }
    struct hal_stream_shm *f = stream->fifo;
    if (!is_readable(f)) {
        atomic_fetch_add_explicit(&f->underruns, 1, memory_order_relaxed);
        return -ENOSPC;
    }
    uint32_t out = atomic_load_explicit(&f->out, memory_order_relaxed);
    const hal_stream_data_u *record = f->data + (size_t)out * (f->count + 1);
    memcpy(buf, record, f->count * sizeof *record);
    if (sampleno) {
        *sampleno = record[f->count].u;
    }
    atomic_store_explicit(&f->out, after(f, out), memory_order_release);
    return 0;
}

int hal_stream_write(hal_stream_t *stream, hal_stream_data_u *buf)
{
    if (invalid(stream, __func__)) {
        return -EINVAL;
    }
    struct hal_stream_shm *f = stream->fifo;
    if (!is_writable(f)) {
        atomic_fetch_add_explicit(&f->overruns, 1, memory_order_relaxed);
        return -ENOSPC;
    }
    uint32_t in = atomic_load_explicit(&f->in, memory_order_relaxed);
    hal_stream_data_u *record = f->data + (size_t)in * (f->count + 1);
    memcpy(record, buf, f->count * sizeof *record);
    record[f->count].k = ++f->sampleno;
    atomic_store_explicit(&f->in, after(f, in), memory_order_release);
    return 0;
}

#ifdef ULAPI
#define WAIT_NS 10000000

void hal_stream_wait_readable(hal_stream_t *stream, sig_atomic_t *stop)
{
    if (invalid(stream, __func__)) {
        return;
    }
    while (!(stop && *(volatile sig_atomic_t *)stop) && !is_readable(stream->fifo)) {
        kerf_clock_sleep_ns(WAIT_NS);
    }
}

void hal_stream_wait_writable(hal_stream_t *stream, sig_atomic_t *stop)
{
    if (invalid(stream, __func__)) {
        return;
    }
    while (!(stop && *(volatile sig_atomic_t *)stop) && !is_writable(stream->fifo)) {
        kerf_clock_sleep_ns(WAIT_NS);
    }
}
#endif
