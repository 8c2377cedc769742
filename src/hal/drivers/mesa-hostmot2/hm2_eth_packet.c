/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_eth_packet.c - packets to and from a board.
 *
 * In a cycle all reads are one packet with one answer, all writes another. Each packet carries a
 * counter that the board keeps: the answer shows whether it belongs to this cycle, and whether the
 * writes of the cycle before arrived. What goes wrong is counted (packet-error-level); above the
 * limit the board is given up (io_error).
 *
 * Thread: the queue functions [servo]; the wait for an answer ends at packet-read-timeout.
 */
#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include "hm2_eth.h"

#define ADDR_READ_COUNTER 0x10         /* of SPACE_TIMERS, 32 bits in two words */
#define ADDR_WRITE_COUNTER 0x14
#define ADDR_RX_PACKETS 0x08           /* of SPACE_STATUS */
#define TRAILER_ANSWER 10              /* bytes: received packets, read and write counter */
#define TRAILER_READ 16
#define TRAILER_WRITE 8
#define SLOW_TIMEOUT_NS 200000000LL    /* outside of realtime */
#define LEAST_TIMEOUT_NS 100000L
#define DEFAULT_PERCENT 80
#define TRIES 3
#define WRITES_BEFORE_READ 32          /* the board's buffer is small */

int eth_debug;

long long eth_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

static bool in_realtime(void)
{
    return rtapi_task_self() >= 0;
}

/* ---- Building --------------------------------------------------------------- */

static void put16(struct eth_packet *p, rtapi_u32 value)
{
    p->data[p->used++] = value & 0xFF;
    p->data[p->used++] = value >> 8 & 0xFF;
}

static void put_command(struct eth_packet *p, rtapi_u32 command, rtapi_u32 addr)
{
    put16(p, command | LBP_ADDRESS);
    put16(p, addr);
}

static void put_data(struct eth_packet *p, const void *data, int bytes)
{
    memcpy(p->data + p->used, data, (size_t)bytes);
    p->used += bytes;
}

static void put_counter(struct eth_packet *p, rtapi_u32 addr, rtapi_u32 value)
{
    put_command(p, LBP_WRITE | LBP_SPACE(SPACE_TIMERS) | LBP_16BIT | LBP_INCREMENT | 2, addr);
    put16(p, value);
    put16(p, value >> 16);
}

static rtapi_u32 get32(const rtapi_u8 *p)
{
    return p[0] | (rtapi_u32)p[1] << 8 | (rtapi_u32)p[2] << 16 | (rtapi_u32)p[3] << 24;
}

/* ---- Sending and receiving -------------------------------------------------- */

static void show_packet(const struct eth_board *b, const char *what, const rtapi_u8 *data, int bytes)
{
    char text[3 * 32 + 1] = "";
    int i;
    if(!eth_debug) return;
    for(i = 0; i < bytes && i < 32; i++) snprintf(text + 3 * i, 4, " %02X", data[i]);
    rtapi_print("%s: %s %d bytes:%s%s\n", b->io.name, what, bytes, text, bytes > 32 ? " ..." : "");
}

/* Sends a packet and empties it, sent or not. Nonzero on success. */
static int send_packet(struct eth_board *b, struct eth_packet *p)
{
    ssize_t n = send(b->fd, p->data, (size_t)p->used, MSG_DONTWAIT | MSG_NOSIGNAL);
    int sent = n == p->used;
    show_packet(b, sent ? "sent" : "not sent", p->data, p->used);
    p->used = 0;
    return sent;
}

/* Waits until deadline for a packet, into b->answer. Number of bytes, or -errno. */
static int receive_packet(struct eth_board *b, long long deadline)
{
    for(;;) {
        ssize_t n = recv(b->fd, b->answer, ETH_PACKET, MSG_DONTWAIT | MSG_TRUNC);
        if(n >= 0) {
            show_packet(b, "received", b->answer, n < ETH_PACKET ? (int)n : ETH_PACKET);
            return (int)n;
        }
        if(errno != EAGAIN && errno != EINTR && errno != ECONNREFUSED) return -errno;
        long long left = deadline - eth_now();
        if(left <= 0) return -ETIMEDOUT;
        struct pollfd wait = {b->fd, POLLIN, 0};
        struct timespec t = {(time_t)(left / 1000000000LL), (long)(left % 1000000000LL)};
        if(ppoll(&wait, 1, &t, NULL) < 0 && errno != EINTR) return -errno;
    }
}

/* Answers that nobody waits for any more. */
static void drain(struct eth_board *b)
{
    int i;
    for(i = 0; i < ETH_READS; i++)
        if(recv(b->fd, b->answer, sizeof b->answer, MSG_DONTWAIT) < 0 && errno == EAGAIN) return;
}

static long long answer_timeout(const struct eth_board *b)
{
    if(!in_realtime()) return SLOW_TIMEOUT_NS; /* the parameter may not be there yet */
    long t = hal_get_si32(b->read_timeout), period = b->io.period;
    if(t <= 0) t = DEFAULT_PERCENT;
    if(t < 100) t = period / 100 * t;
    return t < LEAST_TIMEOUT_NS ? LEAST_TIMEOUT_NS : t;
}

static int ask(struct eth_board *b, rtapi_u32 command, rtapi_u32 addr, void *buffer, int bytes)
{
    int n;
    drain(b);
    put_command(&b->single, command, addr);
    if(!send_packet(b, &b->single)) return -EIO;
    n = receive_packet(b, eth_now() + answer_timeout(b));
    if(n < 0) return n;
    if(n != bytes) return -EBADMSG;
    memcpy(buffer, b->answer, (size_t)bytes);
    return 0;
}

int eth_read_space(struct eth_board *b, int space, rtapi_u32 addr, void *buffer, int count, int size)
{
    rtapi_u32 command = LBP_SPACE(space) | (size == 4 ? LBP_32BIT : LBP_16BIT) | LBP_INCREMENT | (rtapi_u32)count;
    int tries, most = in_realtime() ? 1 : TRIES, r = -EIO;
    for(tries = 0; tries < most; tries++) {
        r = ask(b, command, addr, buffer, count * size);
        if(r == 0) break;
    }
    if(r == 0) b->unanswered_writes = 0;
    return r;
}

/* ---- Single transfers ------------------------------------------------------- */

static int read_now(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    struct eth_board *b = (struct eth_board *)io;
    if(in_realtime() && !b->told_direct) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: ERROR: used llio->read in realtime task (addr=0x%04x)\n", io->name, addr);
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: This causes additional network packets which hurts performance\n",
                        io->name);
        b->told_direct = true;
    }
    while(bytes > 0) {
        int count = bytes / 4 < LBP_MAX_COUNT ? bytes / 4 : LBP_MAX_COUNT;
        if(eth_read_space(b, SPACE_HM2, addr, buffer, count, 4) < 0) {
            if(in_realtime()) b->lost = true; /* counted like other lost packets */
            else hm2_llio_fail(io);
            return 0;
        }
        bytes -= count * 4;
        addr += (rtapi_u32)count * 4;
        buffer = (char *)buffer + count * 4;
    }
    return 1;
}

static int send_writes(struct hm2_llio *io);

/* A packet that has no room for more goes off, and the next begins. */
static int queue_write(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    struct eth_board *b = (struct eth_board *)io;
    if(bytes / 4 < 1 || bytes / 4 > LBP_MAX_COUNT) return 0;
    if(b->writes.used + 4 + bytes + TRAILER_WRITE > ETH_PACKET && !send_writes(io)) return 0;
    put_command(&b->writes, LBP_WRITE | LBP_SPACE(SPACE_HM2) | LBP_32BIT | LBP_INCREMENT | (rtapi_u32)(bytes / 4),
                addr);
    put_data(&b->writes, buffer, bytes);
    return 1;
}

static int write_single(struct eth_board *b, rtapi_u32 addr, const void *buffer, int bytes)
{
    struct eth_packet *p = &b->single;
    rtapi_u32 cookie;
    put_command(p, LBP_WRITE | LBP_SPACE(SPACE_HM2) | LBP_32BIT | LBP_INCREMENT | (rtapi_u32)(bytes / 4), addr);
    put_data(p, buffer, bytes);
    if(!send_packet(b, p)) return 0;
    if(++b->unanswered_writes < WRITES_BEFORE_READ) return 1;
    return eth_read_space(b, SPACE_HM2, 0x100, &cookie, 1, 4) == 0;
}

static int write_now(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    struct eth_board *b = (struct eth_board *)io;
    if(in_realtime() || b->enqueue) return queue_write(io, addr, buffer, bytes);
    if(bytes / 4 < 1 || bytes / 4 > LBP_MAX_COUNT) return 0;
    return write_single(b, addr, buffer, bytes);
}

/* Outside of realtime writes go one by one. */
static int queue_or_write(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    return write_now(io, addr, buffer, bytes);
}

static int send_writes(struct hm2_llio *io)
{
    struct eth_board *b = (struct eth_board *)io;
    if(!b->writes.used) return 1;
    put_counter(&b->writes, ADDR_WRITE_COUNTER, ++b->write_counter);
    b->write_sent = true;
    if(send_packet(b, &b->writes)) return 1;
    b->lost = true;
    return 0;
}

static void set_force_enqueue(struct hm2_llio *io, bool on)
{
    struct eth_board *b = (struct eth_board *)io;
    b->enqueue = on && b->packs_all;
}

/* ---- The reads of a cycle --------------------------------------------------- */

static int queue_read(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    struct eth_board *b = (struct eth_board *)io;
    if(bytes / 4 < 1 || bytes / 4 > LBP_MAX_COUNT || b->num_queued == ETH_READS ||
       b->reads.used + 4 + TRAILER_READ > ETH_PACKET || b->expected + bytes + TRAILER_ANSWER > ETH_PACKET) {
        if(!b->told_full) rtapi_print_msg(RTAPI_MSG_ERR, "%s: ERROR: enqueue_read: buffer full\n", io->name);
        b->told_full = true;
        return 0;
    }
    put_command(&b->reads, LBP_SPACE(SPACE_HM2) | LBP_32BIT | LBP_INCREMENT | (rtapi_u32)(bytes / 4), addr);
    b->queued[b->num_queued].buffer = buffer;
    b->queued[b->num_queued++].bytes = bytes;
    b->expected += bytes;
    return 1;
}

static int send_reads(struct hm2_llio *io)
{
    struct eth_board *b = (struct eth_board *)io;
    if(hal_get_si32(b->error_level) >= hal_get_si32(b->error_limit)) {
        hal_set_si32(b->error_level, 0); /* the user has answered */
        drain(b);
    }
    put_command(&b->reads, LBP_SPACE(SPACE_STATUS) | LBP_16BIT | 1, ADDR_RX_PACKETS);
    put_counter(&b->reads, ADDR_READ_COUNTER, ++b->read_counter);
    put_command(&b->reads, LBP_SPACE(SPACE_TIMERS) | LBP_16BIT | LBP_INCREMENT | 4, ADDR_READ_COUNTER);
    b->deadline = eth_now() + answer_timeout(b);
    if(!send_packet(b, &b->reads)) b->lost = true;
    return 1; /* what was not sent has no answer: counted there */
}

/* Counts a cycle without its answer. Too many: the board is given up. */
static int soft_error(struct eth_board *b, const char *what, int error, long long since)
{
    rtapi_s32 limit = hal_get_si32(b->error_limit), step = hal_get_si32(b->error_increment);
    if(step < 1) step = hal_set_si32(b->error_increment, 1);
    rtapi_s64 level = (rtapi_s64)hal_get_si32(b->error_level) + step;
    /* The first of a row, and not more than one a second: the operator sees it. */
    if(!hal_get_si32(b->error_level) && b->iterations - b->told_iteration >= 1000000000 / (b->io.period + 1)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: receive_queued_reads: %s (%s) after %llins timeout=%llins\n", b->io.name,
                        what,
                        strerror(error), eth_now() - since, b->deadline - since);
        b->told_iteration = b->iterations;
    }
    b->io.needs_soft_reset = true;
    hal_set_bool(b->error, 1);
    hal_set_ui32(b->error_total, hal_get_ui32(b->error_total) + 1);
    hal_set_si32(b->error_level, level < limit ? (rtapi_s32)level : limit);
    if(level < limit) return -EAGAIN;
    rtapi_print_msg(RTAPI_MSG_ERR, "%s: error finishing read! iter=%u\n", b->io.name, b->iterations);
    rtapi_print_msg(RTAPI_MSG_ERR,
                    "%s: connection to %s lost: packet-error-level reached packet-error-limit %d; nothing "
                    "is sent any more, the board's watchdog switches its outputs off; check cable, power and network "
                    "load, then set %s.io_error to 0\n", b->io.name, b->ip, limit, b->io.name);
    hal_set_bool(b->error_exceeded, 1);
    hm2_llio_fail(&b->io);
    return 0;
}

static int good_answer(struct eth_board *b)
{
    const rtapi_u8 *answer = b->answer;
    rtapi_s32 level = hal_get_si32(b->error_level) - hal_get_si32(b->error_decrement);
    int i, n = b->num_queued;
    for(i = 0; i < n; i++) {
        memcpy(b->queued[i].buffer, answer, (size_t)b->queued[i].bytes);
        answer += b->queued[i].bytes;
    }
    hal_set_si32(b->error_level, level > 0 ? level : 0);
    hal_set_bool(b->error, 0);
    hal_set_bool(b->error_exceeded, 0);
    return 1;
}

/* The answer to this cycle's question; older ones are thrown away. */
static int wait_for_answer(struct eth_board *b)
{
    for(;;) {
        int n = receive_packet(b, b->deadline);
        if(n < 0) return n;
        if(n != b->expected + TRAILER_ANSWER) return -EBADMSG;
        if(get32(b->answer + b->expected + 2) == b->read_counter) return 0;
    }
}

static int receive_reads(struct hm2_llio *io)
{
    struct eth_board *b = (struct eth_board *)io;
    long long since = eth_now();
    int r = wait_for_answer(b), result;
    rtapi_u32 written = r < 0 ? 0 : get32(b->answer + b->expected + 6);
    b->iterations++;
    if(r == -EBADMSG) result = soft_error(b, "answer of the wrong length", EBADMSG, since);
    else if(r < 0) result = soft_error(b, "error", -r, since);
    else if(b->lost) result = soft_error(b, "a packet could not be sent", EIO, since);
    else if(b->write_sent && written != b->write_counter) result = soft_error(b, "writes did not arrive", EIO, since);
    else result = good_answer(b);
    b->lost = false;
    b->num_queued = b->expected = 0;
    return result;
}

const struct hm2_llio_ops eth_ops = {
    .read = read_now,
    .write = write_now,
    .queue_read = queue_read,
    .send_queued_reads = send_reads,
    .receive_queued_reads = receive_reads,
    .queue_write = queue_or_write,
    .send_queued_writes = send_writes,
    .set_force_enqueue = set_force_enqueue,
};
