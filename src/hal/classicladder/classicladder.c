/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * classicladder.c - loads a ladder project into the realtime module and lets it run;
 * serves Modbus.
 *
 * With --nogui it ends after loading. Without, it stays until SIGTERM or SIGINT, and so do
 * the Modbus client and server if they are wanted.
 */
#include <getopt.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <hal.h>
#include "classicladder/clp.h"
#include "classicladder/modbus.h"
#include "kerf_clock.h"

#define DEFAULT_PORT 9502
#define LOOK_NS 100000000
#define SCAN_LOOK_NS 1000000

static const char help[] =
    "Usage: classicladder [options] [project.clp | folder]\n"
    "  --nogui            load the project, run it and end\n"
    "  --modmaster        poll the Modbus requests of the project\n"
    "  --modslave         serve bits and words by Modbus over TCP\n"
    "  --modbus_port=N    port of --modslave (9502)\n"
    "  --newpath=PATH     the project, as the last argument\n"
    "  --debug            say what is done\n";

static volatile int stop;

static struct {
    int nogui, master, slave, port, debug;
    const char *project;
} options = { .port = DEFAULT_PORT };

static void end(int signal_number)
{
    (void)signal_number;
    stop = 1;
}

/* 0; -1 when only the help text was wanted. */
static int parse_options(int argc, char **argv)
{
    static const struct option names[] = {
        { "nogui", no_argument, NULL, 'n' }, { "modmaster", no_argument, NULL, 'm' },
        { "modslave", no_argument, NULL, 's' }, { "modbus_port", required_argument, NULL, 'p' },
        { "debug", no_argument, NULL, 'd' }, { "newpath", required_argument, NULL, 'f' }, { NULL, 0, NULL, 0 }
    };
    int c;
    opterr = 0;
    while((c = getopt_long(argc, argv, "", names, NULL)) != -1) {
        switch(c) {
        case 'n': options.nogui = 1; break;
        case 'm': options.master = 1; break;
        case 's': options.slave = 1; break;
        case 'p': options.port = atoi(optarg); break;
        case 'd': options.debug = 1; break;
        case 'f': options.project = optarg; break;
        default: return -1;
        }
    }
    if(optind < argc) options.project = argv[optind];
    return 0;
}

/* The memory of the realtime module, or NULL. */
static struct ladder *attach(int comp_id, int *shmem_id)
{
    void *memory;
    struct ladder *l;
    *shmem_id = rtapi_shmem_new(LADDER_SHM_KEY, comp_id, sizeof(struct ladder));
    if(*shmem_id < 0 || rtapi_shmem_getptr(*shmem_id, &memory) < 0) return NULL;
    l = memory;
    return l->version == LADDER_VERSION && l->size >= sizeof(struct ladder) ? l : NULL;
}

static void set_state(struct ladder *l, enum ladder_state state)
{
    __atomic_store_n(&l->state, state, __ATOMIC_SEQ_CST);
}

/* Stops the ladder; on return the realtime side does not touch the program. */
static void ladder_stop(struct ladder *l)
{
    set_state(l, LADDER_LOADING);
    while(__atomic_load_n(&l->scanning, __ATOMIC_SEQ_CST)) kerf_clock_sleep_ns(SCAN_LOOK_NS);
}

/* Loads the project; 0 or -1 with a message. */
static int load(struct ladder *l)
{
    char message[CLP_MESSAGE];
    int result;
    ladder_stop(l);
    result = clp_read(l, options.project, message);
    if(result < 0) fprintf(stderr, "classicladder: %s\n", message);
    else if(options.debug) printf("classicladder: %s loaded\n", options.project);
    set_state(l, result < 0 ? LADDER_STOP : LADDER_RUN);
    return result;
}

static void *run_master(void *ladder)
{
    modbus_poll(ladder, &stop);
    return NULL;
}

/* Stays until a signal. */
static int serve(struct ladder *l)
{
    pthread_t master;
    int result = 0, has_master = options.master && pthread_create(&master, NULL, run_master, l) == 0;
    if(options.slave) {
        result = modbus_serve(l, options.port, &stop);
        if(result < 0) fprintf(stderr, "classicladder: Modbus port %d: %s\n", options.port, strerror(-result));
        stop = 1;
    }
    while(!stop) kerf_clock_sleep_ns(LOOK_NS);
    if(has_master) pthread_join(master, NULL);
    return result < 0 ? 1 : 0;
}

int main(int argc, char **argv)
{
    struct ladder *l;
    int comp_id, shmem_id, status = 0;
    if(parse_options(argc, argv) < 0) {
        fputs(help, stdout);
        return 0;
    }
    signal(SIGTERM, end);
    signal(SIGINT, end);
    signal(SIGPIPE, SIG_IGN);
    kerf_clock_join("classicladder", KERF_CLOCK_PRIO_USER);
    comp_id = hal_init("classicladder");
    if(comp_id < 0) {
        fprintf(stderr, "classicladder: no HAL: %s\n", hal_strerror(comp_id));
        return 1;
    }
    l = attach(comp_id, &shmem_id);
    if(!l) {
        fprintf(stderr, "classicladder: the module classicladder_rt is not loaded\n");
        status = 1;
    } else {
        if(options.project) status = load(l) < 0;
        else set_state(l, LADDER_RUN);
        if(status == 0) hal_ready(comp_id);
        if(status == 0 && !options.nogui) status = serve(l);
    }
    if(shmem_id >= 0) rtapi_shmem_delete(shmem_id, comp_id);
    hal_exit(comp_id);
    kerf_clock_leave();
    return status;
}
