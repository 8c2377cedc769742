/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_llio.h - what a board driver gives to hostmot2: transfers over a 16-bit byte address space of
 * 32-bit registers, and what is known of the board's connectors.
 */
#ifndef HM2_LLIO_H
#define HM2_LLIO_H

#include <rtapi.h>
#include <hal.h>

#define HM2_MAX_CONNECTORS 8

struct hm2_llio;

/* A .bit file: the FPGA it is for and what to send. */
struct hm2_bitfile {
    const char *part;
    const rtapi_u8 *data;
    unsigned size;
};

/* bytes is a multiple of 4. A transfer gives nonzero on success; 0 after hm2_llio_fail(). */
struct hm2_llio_ops {
    /* [any] Required. */
    int (*read)(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes);
    int (*write)(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes);

    /* [init] Optional: boards without flash memory. 0 or -errno. */
    int (*program_fpga)(struct hm2_llio *io, const struct hm2_bitfile *bitfile);
    int (*reset)(struct hm2_llio *io);

    /* [servo] Optional, the first five together: reads fill their buffers in receive_queued_reads,
     * which may give -EAGAIN: nothing came this time, and that is still tolerable. */
    int (*queue_read)(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes);
    int (*send_queued_reads)(struct hm2_llio *io);
    int (*receive_queued_reads)(struct hm2_llio *io);
    int (*queue_write)(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes);
    int (*send_queued_writes)(struct hm2_llio *io);
    void (*set_force_enqueue)(struct hm2_llio *io, bool on); /* batch also outside of realtime */
};

struct hm2_llio {
    /* By the board driver, before hm2_register(). */
    const struct hm2_llio_ops *ops;
    char name[HAL_NAME_LEN + 1]; /* prefix of all names in HAL */
    int comp_id;                 /* owner of what is exported */
    int num_connectors;
    int pins_per_connector;
    const char *connector_name[HM2_MAX_CONNECTORS];
    const char *const *io_name;  /* of each pin, NULL inside: not brought out; NULL: by connector */
    int io_names;
    int num_leds;
    const char *fpga_part;       /* as .bit files name it */
    bool threadsafe;             /* transfers may happen in two threads at once */
    bool split_read;             /* asking and receiving are two HAL functions */

    /* By hostmot2. */
    hal_bool_t io_error;         /* NULL until the board is registered */
    long period;                 /* of the thread that reads, ns; 0: no cycle yet */
    bool read_requested;
    struct hm2 *hm2;

    /* By both: what the next write has to make good. */
    bool needs_reset;            /* with messages */
    bool needs_soft_reset;       /* silently: a packet was lost */
};

/* [any] The board cannot be reached any more: stops all transfers until the user clears io_error. */
static inline void hm2_llio_fail(struct hm2_llio *io)
{
    if(io->io_error) hal_set_bool(io->io_error, 1);
    io->needs_reset = true;
}

/* [init] Identifies the firmware, makes the pins and functions and writes the first values. config
 * may be NULL. io stays the caller's. 0 or -errno, with a message. */
int hm2_register(struct hm2_llio *io, const char *config);
/* [init] Lets the board's watchdog bite and forgets the board. After hal_exit(): no thread may be in a
 * function of the board any more. */
void hm2_unregister(struct hm2_llio *io);

#endif
