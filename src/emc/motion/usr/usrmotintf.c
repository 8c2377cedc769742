/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * usrmotintf.c - user-space side of the motion controller's shared memory.
 *
 * In, out: usrmotintf.h   Thread: task
 * Method:  status and configuration are copied between equal head and tail
 *          counters (a sequence lock read at most READS times).
 */
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "emcmotutil.h"
#include "kerf_clock.h"
#include "rtapi.h"
#include "usrmotintf.h"

#define READS 3
#define READ_PAUSE_NS 1000
#define ECHO_POLL_NS 25000

static struct {
    int module_id, shmem_id;
    emcmot_struct_t *shared;
    double timeout_s;
    int number; /* of the last command sent */
    int quiet;  /* 1: failures are only returned */
} usr = {-1, -1, NULL, DEFAULT_EMCMOT_COMM_TIMEOUT, 0, 0};

static void complain(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
static void complain(const char *fmt, ...)
{
    va_list ap;
    if (usr.quiet)
        return;
    va_start(ap, fmt);
    vprintf(fmt, ap);
    va_end(ap);
}

void usrmotSetQuiet(int quiet) { usr.quiet = quiet; }

int usrmotInit(const char *name, int key, double timeout_s)
{
    void *memory = NULL;
    if (usr.shared)
        return 0;
    usr.module_id = rtapi_init(name);
    if (usr.module_id < 0) {
        fprintf(stderr, "usrmotintf: ERROR: rtapi init failed\n");
        return -1;
    }
    usr.shmem_id = rtapi_shmem_new(key, usr.module_id, sizeof(emcmot_struct_t));
    if (usr.shmem_id < 0 || rtapi_shmem_getptr(usr.shmem_id, &memory) < 0) {
        fprintf(stderr, "usrmotintf: ERROR: could not open shared memory\n");
        if (usr.shmem_id >= 0)
            rtapi_shmem_delete(usr.shmem_id, usr.module_id);
        rtapi_exit(usr.module_id);
        usr.module_id = usr.shmem_id = -1;
        return -1;
    }
    usr.shared = memory;
    usr.timeout_s = timeout_s;
    usr.number = usr.shared->status.commandNumEcho;
    return 0;
}

int usrmotExit(void)
{
    if (usr.shared) {
        rtapi_shmem_delete(usr.shmem_id, usr.module_id);
        rtapi_exit(usr.module_id);
    }
    usr.shared = NULL;
    usr.module_id = usr.shmem_id = -1;
    return 0;
}

emcmot_struct_t *usrmotSegment(void) { return usr.shared; }

/* One copy of a block: 0, or -1 when it was being written. */
static int copy_block(void *to, const void *from, size_t size, const unsigned int *head, const unsigned int *tail)
{
    unsigned int before = __atomic_load_n(tail, __ATOMIC_ACQUIRE);
    memcpy(to, from, size);
    __atomic_thread_fence(__ATOMIC_ACQUIRE);
    return __atomic_load_n(head, __ATOMIC_RELAXED) == before ? 0 : -1;
}

static int read_block(void *to, const void *from, size_t size, const unsigned int *head, const unsigned int *tail)
{
    for (int i = 0; i < READS; i++) {
        if (copy_block(to, from, size, head, tail) == 0)
            return EMCMOT_COMM_OK;
        kerf_clock_sleep_ns(READ_PAUSE_NS);
    }
    return EMCMOT_COMM_SPLIT_READ_TIMEOUT;
}

int usrmotReadEmcmotStatus(emcmot_status_t *s)
{
    if (!usr.shared)
        return EMCMOT_COMM_ERROR_CONNECT;
    const emcmot_status_t *from = &usr.shared->status;
    return read_block(s, from, sizeof(*s), &from->head, &from->tail);
}

int usrmotReadEmcmotConfig(emcmot_config_t *c)
{
    if (!usr.shared)
        return EMCMOT_COMM_ERROR_CONNECT;
    const emcmot_config_t *from = &usr.shared->config;
    int r = read_block(c, from, sizeof(*c), &from->head, &from->tail);
    if (r == EMCMOT_COMM_SPLIT_READ_TIMEOUT)
        printf("usrmotReadEmcmotConfig: Split read timeout\n");
    return r;
}

int usrmotReadEmcmotInternal(emcmot_internal_t *i)
{
    if (!usr.shared)
        return EMCMOT_COMM_ERROR_CONNECT;
    const emcmot_internal_t *from = &usr.shared->internal;
    int r = read_block(i, from, sizeof(*i), &from->head, &from->tail);
    if (r == EMCMOT_COMM_SPLIT_READ_TIMEOUT)
        printf("usrmotReadEmcmotInternal: Split read timeout\n");
    return r;
}

int usrmotReadEmcmotError(char *e)
{
    if (!usr.shared)
        return EMCMOT_COMM_ERROR_CONNECT;
    return emcmotErrorGet(&usr.shared->error, e, EMCMOT_ERROR_LEN);
}

static int echoed(void *arg)
{
    const int *number = arg;
    return __atomic_load_n(&usr.shared->status.commandNumEcho, __ATOMIC_ACQUIRE) == *number;
}

/* Virtual time stands between the polls, so that fewer of them cost nothing. */
static int64_t poll_ns(void) { return kerf_clock_is_virtual() ? 10 * ECHO_POLL_NS : ECHO_POLL_NS; }

static int locked(void *arg)
{
    (void)arg;
    return emcmotCommandTryLockUser(usr.shared, getpid());
}

int usrmotWriteEmcmotCommand(emcmot_command_t *c)
{
    int64_t timeout_ns = (int64_t)(usr.timeout_s * 1e9);
    if (c->id == INT_MIN) {
        complain("USRMOT: ERROR: invalid motion id: %d\n", c->id);
        return EMCMOT_COMM_INVALID_MOTION_ID;
    }
    if (!usr.shared) {
        complain("USRMOT: ERROR: can't connect to shared memory\n");
        return EMCMOT_COMM_ERROR_CONNECT;
    }
    if (!locked(NULL) && kerf_clock_wait(locked, NULL, poll_ns(), timeout_ns) != 0) {
        complain("USRMOT: ERROR: command %u timeout (seq: %d)\n", (unsigned)c->command, usr.number);
        return EMCMOT_COMM_ERROR_TIMEOUT;
    }
    c->commandNum = ++usr.number;
    usr.shared->command = *c;
    emcmotCommandUnlock(usr.shared);
    int64_t deadline_ns = kerf_clock_now_ns() + timeout_ns;
    while (!echoed(&usr.number)) {
        int64_t left_ns = deadline_ns - kerf_clock_now_ns();
        if (left_ns <= 0) {
            complain("USRMOT: ERROR: command %u timeout (seq: %d)\n", (unsigned)c->command, usr.number);
            return EMCMOT_COMM_ERROR_TIMEOUT;
        }
        kerf_clock_wait(echoed, &usr.number, poll_ns(), left_ns);
    }
    if (__atomic_load_n(&usr.shared->status.commandStatus, __ATOMIC_ACQUIRE) != EMCMOT_COMMAND_OK) {
        complain("USRMOT: ERROR: invalid command\n");
        return EMCMOT_COMM_ERROR_COMMAND;
    }
    return EMCMOT_COMM_OK;
}

#define COMP_STEEP 0.5 /* correction per travel: positions and trims mixed up */

/* What is wrong with a line of a compensation file; NULL when nothing is. */
static const char *comp_line(const char *line, double v[3])
{
    int end = 0;
    if (sscanf(line, "%lf %lf %lf%n", &v[0], &v[1], &v[2], &end) != 3)
        return "three numbers expected";
    if (!isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2]))
        return "a value is no number";
    if (line[end] != '\0' && !isspace((unsigned char)line[end]))
        return "three numbers expected";
    return NULL;
}

/* Sends the points of an open file; OR of the results of the commands. */
static int load_points(FILE *fp, const char *file, int joint, int type)
{
    static emcmot_command_t c; /* too large for some stacks */
    char line[256];
    const char *wrong;
    double v[3], before[3] = {0, 0, 0};
    int number = 0, points = 0, warned = 0, result = 0;
    while (fgets(line, sizeof(line), fp)) {
        number++;
        if ((wrong = comp_line(line, v))) {
            if (line[strspn(line, " \t\r\n")] != '\0')
                fprintf(stderr, "%s:%d: %s: the %d points before this line are used\n", file, number, wrong, points);
            break;
        }
        memset(&c, 0, sizeof(c));
        c.command = EMCMOT_SET_JOINT_COMP;
        c.joint = joint;
        c.comp_nominal = v[0];
        c.comp_forward = type ? v[1] : v[0] - v[1];
        c.comp_reverse = type ? v[2] : v[0] - v[2];
        result |= usrmotWriteEmcmotCommand(&c);
        if (points >= EMCMOT_COMP_SIZE) {
            fprintf(stderr, "%s:%d: more than %d points\n", file, number, EMCMOT_COMP_SIZE);
            break;
        }
        if (points > 0 && !(v[0] > before[0])) {
            fprintf(stderr,
                    "%s:%d: position %g is not above %g of the point before: point not used\n",
                    file, number, v[0], before[0]);
            continue;
        }
        double most = COMP_STEEP * (v[0] - before[0]);
        if (points > 0 && !warned &&
            (fabs(c.comp_forward - before[1]) > most || fabs(c.comp_reverse - before[2]) > most)) {
            fprintf(stderr,
                    "%s:%d: the correction changes by more than half of the travel since the point "
                    "before: is COMP_FILE_TYPE %d right?\n",
                    file, number, type);
            warned = 1;
        }
        before[0] = v[0];
        before[1] = c.comp_forward;
        before[2] = c.comp_reverse;
        points++;
    }
    if (points == 0)
        fprintf(stderr, "%s: no compensation points\n", file);
    return result;
}

int usrmotLoadComp(int joint, const char *file, int type)
{
    FILE *fp = fopen(file, "r");
    if (!fp) {
        fprintf(stderr, "can't open compensation file %s\n", file);
        return -1;
    }
    int result = load_points(fp, file, joint, type);
    fclose(fp);
    return result;
}
