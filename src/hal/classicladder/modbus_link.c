/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * modbus_link.c - Modbus over TCP and over a serial line.
 */
#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>
#include "classicladder/modbus.h"
#include "kerf_clock.h"

#define HEADER 7                /* of Modbus over TCP */
#define MAX_CLIENTS 8
#define LOOK_NS 100000000       /* how often *stop is looked at */
#define MS 1000000LL
#define DEFAULT_PORT "502"
#define TRIES 3

/* ---- Server ---------------------------------------------------------------- */

struct client {
    int fd, filled;
    uint8_t buffer[HEADER + MODBUS_MAX_PDU];
};

static void drop(struct client *c)
{
    close(c->fd);
    c->fd = -1;
    c->filled = 0;
}

/* Answers the whole requests in the buffer; 0, or -1 to drop the client. */
static int answer_all(struct ladder *l, struct client *c)
{
    while(c->filled >= HEADER) {
        uint8_t reply[HEADER + MODBUS_MAX_PDU];
        int length = c->buffer[4] << 8 | c->buffer[5], n;
        if(c->buffer[2] || c->buffer[3] || length < 2 || length > MODBUS_MAX_PDU + 1) return -1;
        if(c->filled < 6 + length) return 0;
        n = modbus_answer(l, c->buffer + HEADER, length - 1, reply + HEADER);
        memcpy(reply, c->buffer, HEADER);
        reply[4] = (uint8_t)((n + 1) >> 8);
        reply[5] = (uint8_t)(n + 1);
        if(write(c->fd, reply, (size_t)(HEADER + n)) != HEADER + n) return -1;
        c->filled -= 6 + length;
        memmove(c->buffer, c->buffer + 6 + length, (size_t)c->filled);
    }
    return 0;
}

static void receive(struct ladder *l, struct client *c)
{
    ssize_t n = read(c->fd, c->buffer + c->filled, sizeof c->buffer - (size_t)c->filled);
    if(n <= 0) {
        drop(c);
        return;
    }
    c->filled += (int)n;
    if(answer_all(l, c) < 0) drop(c);
}

static void welcome(struct client *clients, int listener)
{
    int fd = accept(listener, NULL, NULL), i;
    for(i = 0; fd >= 0 && i < MAX_CLIENTS; i++) {
        if(clients[i].fd >= 0) continue;
        clients[i].fd = fd;
        return;
    }
    if(fd >= 0) close(fd);
}

static int listen_on(int port)
{
    struct sockaddr_in address = { .sin_family = AF_INET, .sin_port = htons((uint16_t)port),
                                   .sin_addr.s_addr = htonl(INADDR_ANY) };
    int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), yes = 1;
    if(fd < 0) return -errno;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if(bind(fd, (struct sockaddr *)&address, sizeof address) < 0 || listen(fd, MAX_CLIENTS) < 0) {
        int error = errno;
        close(fd);
        return -error;
    }
    return fd;
}

int modbus_serve(struct ladder *l, int port, const volatile int *stop)
{
    struct client clients[MAX_CLIENTS];
    struct pollfd fds[MAX_CLIENTS + 1];
    int listener = listen_on(port), i;
    if(listener < 0) return listener;
    for(i = 0; i < MAX_CLIENTS; i++) clients[i] = (struct client){ .fd = -1 };
    while(!*stop) {
        fds[0] = (struct pollfd){ .fd = listener, .events = POLLIN };
        for(i = 0; i < MAX_CLIENTS; i++) fds[i + 1] = (struct pollfd){ .fd = clients[i].fd, .events = POLLIN };
        if(kerf_clock_poll(fds, MAX_CLIENTS + 1, LOOK_NS) <= 0) continue;
        for(i = 0; i < MAX_CLIENTS; i++) if(fds[i + 1].revents) receive(l, &clients[i]);
        if(fds[0].revents) welcome(clients, listener);
    }
    for(i = 0; i < MAX_CLIENTS; i++) if(clients[i].fd >= 0) drop(&clients[i]);
    close(listener);
    return 0;
}

/* ---- Client ---------------------------------------------------------------- */

struct link {
    const struct modbus_config *config;
    int fd;
    char to[32];                /* the TCP partner of fd */
    unsigned number;            /* of the exchange */
};

/* Reads n bytes within the time-out; how many came. */
static int read_fully(struct link *k, uint8_t *buffer, int n)
{
    int got = 0;
    while(got < n) {
        struct pollfd fd = { .fd = k->fd, .events = POLLIN };
        ssize_t r;
        if(kerf_clock_poll(&fd, 1, k->config->time_out_ms * MS) <= 0) break;
        r = read(k->fd, buffer + got, (size_t)(n - got));
        if(r <= 0) break;
        got += (int)r;
    }
    return got;
}

static void hang_up(struct link *k)
{
    if(k->fd >= 0) close(k->fd);
    k->fd = -1;
    k->to[0] = 0;
}

static int dial(struct link *k, const char *to)
{
    struct addrinfo hints = { .ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM }, *found, *a;
    char host[sizeof k->to], *port;
    if(k->fd >= 0 && !strcmp(k->to, to)) return 0;
    hang_up(k);
    snprintf(host, sizeof host, "%s", to);
    port = strchr(host, ':');
    if(port) *port++ = 0;
    if(getaddrinfo(host, port ? port : DEFAULT_PORT, &hints, &found)) return -1;
    for(a = found; a && k->fd < 0; a = a->ai_next) {
        k->fd = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
        if(k->fd >= 0 && connect(k->fd, a->ai_addr, a->ai_addrlen) < 0) hang_up(k);
    }
    freeaddrinfo(found);
    if(k->fd >= 0) snprintf(k->to, sizeof k->to, "%s", to);
    return k->fd >= 0 ? 0 : -1;
}

/* One exchange over TCP; length of the answer, -1 if there is none. */
static int exchange_tcp(struct link *k, const char *to, const uint8_t *request, int n, uint8_t *reply)
{
    uint8_t frame[HEADER + MODBUS_MAX_PDU];
    int length;
    if(dial(k, to) < 0) return -1;
    k->number++;
    frame[0] = (uint8_t)(k->number >> 8);
    frame[1] = (uint8_t)k->number;
    frame[2] = frame[3] = 0;
    frame[4] = (uint8_t)((n + 1) >> 8);
    frame[5] = (uint8_t)(n + 1);
    frame[6] = 1;
    memcpy(frame + HEADER, request, (size_t)n);
    if(write(k->fd, frame, (size_t)(HEADER + n)) != HEADER + n) return -1;
    if(read_fully(k, frame, HEADER) != HEADER || frame[0] != (uint8_t)(k->number >> 8)
       || frame[1] != (uint8_t)k->number)
        return -1;
    length = (frame[4] << 8 | frame[5]) - 1;
    if(length < 1 || length > MODBUS_MAX_PDU) return -1;
    return read_fully(k, reply, length) == length ? length : -1;
}

static uint16_t crc(const uint8_t *data, int n)
{
    uint16_t sum = 0xFFFF;
    int i, bit;
    for(i = 0; i < n; i++) {
        sum ^= data[i];
        for(bit = 0; bit < 8; bit++) sum = sum & 1 ? (uint16_t)((sum >> 1) ^ 0xA001) : (uint16_t)(sum >> 1);
    }
    return sum;
}

static speed_t speed_of(int baud)
{
    static const struct {
        int baud;
        speed_t speed;
    } speeds[] = { { 1200, B1200 }, { 2400, B2400 }, { 4800, B4800 }, { 9600, B9600 }, { 19200, B19200 },
                   { 38400, B38400 }, { 57600, B57600 }, { 115200, B115200 } };
    size_t i;
    for(i = 0; i < sizeof speeds / sizeof speeds[0]; i++) if(speeds[i].baud == baud) return speeds[i].speed;
    return B9600;
}

static int open_serial(struct link *k)
{
    const struct modbus_config *m = k->config;
    struct termios t;
    if(k->fd >= 0) return 0;
    k->fd = open(m->serial_port, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if(k->fd < 0 || tcgetattr(k->fd, &t) < 0) {
        hang_up(k);
        return -1;
    }
    cfmakeraw(&t);
    cfsetspeed(&t, speed_of(m->speed));
    t.c_cflag &= ~(tcflag_t)(CSIZE | CSTOPB | PARENB | PARODD);
    t.c_cflag |= CLOCAL | CREAD | (m->data_bits == 7 ? CS7 : CS8);
    if(m->stop_bits == 2) t.c_cflag |= CSTOPB;
    if(m->parity) t.c_cflag |= PARENB;
    if(m->parity == 1) t.c_cflag |= PARODD;
    tcsetattr(k->fd, TCSANOW, &t);
    return 0;
}

static void set_rts(struct link *k, int on)
{
    int line = TIOCM_RTS;
    if(k->config->use_rts) ioctl(k->fd, on ? TIOCMBIS : TIOCMBIC, &line);
}

/* Bytes that follow the first three of an RTU answer, with the check sum. */
static int rest_of_answer(const uint8_t *frame)
{
    if(frame[1] & 0x80) return 2;
    switch(frame[1]) {
    case 1: case 2: case 3: case 4: return frame[2] + 2;
    case 7: return 2;
    default: return 5;
    }
}

/* One exchange over the serial line; length of the answer, -1 if there is none. */
static int exchange_serial(struct link *k, int slave, const uint8_t *request, int n, uint8_t *reply)
{
    uint8_t frame[MODBUS_MAX_PDU + 3];
    int rest;
    uint16_t sum;
    if(open_serial(k) < 0) return -1;
    frame[0] = (uint8_t)slave;
    memcpy(frame + 1, request, (size_t)n);
    sum = crc(frame, n + 1);
    frame[n + 1] = (uint8_t)sum;
    frame[n + 2] = (uint8_t)(sum >> 8);
    tcflush(k->fd, TCIFLUSH);
    set_rts(k, 1);
    if(write(k->fd, frame, (size_t)n + 3) != n + 3) return -1;
    tcdrain(k->fd);
    if(k->config->after_transmit_ms > 0) kerf_clock_sleep_ns(k->config->after_transmit_ms * MS);
    set_rts(k, 0);
    if(read_fully(k, frame, 3) != 3 || frame[0] != slave) return -1;
    rest = rest_of_answer(frame);
    if(3 + rest > (int)sizeof frame || read_fully(k, frame + 3, rest) != rest) return -1;
    if(crc(frame, 3 + rest)) return -1;
    memcpy(reply, frame + 1, (size_t)rest);
    return rest;
}

static int exchange(struct link *k, struct ladder *l, const struct modbus_request *q)
{
    uint8_t request[MODBUS_MAX_PDU], reply[MODBUS_MAX_PDU];
    int n = modbus_build(l, q, request), got;
    if(n == 0) return -1;
    if(k->config->serial_port[0]) got = exchange_serial(k, atoi(q->slave), request, n, reply);
    else got = exchange_tcp(k, q->slave, request, n, reply);
    if(got < 0) {
        hang_up(k);
        return -1;
    }
    return modbus_take(l, q, request, reply, got);
}

void modbus_poll(struct ladder *l, const volatile int *stop)
{
    struct link k = { .config = &l->modbus, .fd = -1 };
    int i = 0, failures = 0;
    while(!*stop) {
        const struct modbus_request *q = &l->modbus.request[i];
        int wait_ms = l->modbus.inter_frame_ms > 0 ? l->modbus.inter_frame_ms : 1;
        if(q->used) {
            failures = exchange(&k, l, q) < 0 ? failures + 1 : 0;
            ladder_force(l, VAR_S, MODBUS_ERROR_BIT, failures > 0);
            kerf_clock_sleep_ns(wait_ms * MS);
        } else if(i == MODBUS_REQUESTS - 1) {
            kerf_clock_sleep_ns(wait_ms * MS);
        }
        if(failures == 0 || failures >= TRIES) {
            failures = 0;
            i = (i + 1) % MODBUS_REQUESTS;
        }
    }
    hang_up(&k);
}
