/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * sserial.h - smart-serial ports: each has up to 8 channels with a card at each, which says itself
 * what it has.
 */
#ifndef HM2_SSERIAL_H
#define HM2_SSERIAL_H

#include "fields.h"

#define SSERIAL_CHANNELS 8
#define SSERIAL_WORDS 7                /* of a channel, each way */
#define SSERIAL_FIELDS 64
#define SSERIAL_PARAMS 64

/* Commands of a port. */
#define SSERIAL_STOP 0x800u
#define SSERIAL_START 0x900u           /* | channels */
#define SSERIAL_SETUP 0xF00u
#define SSERIAL_DO_IT 0x1000u
#define SSERIAL_READ_LOCAL 0x2000u     /* | address */
#define SSERIAL_WRITE_LOCAL 0xA000u
#define SSERIAL_RESET_ON 0x4000u
#define SSERIAL_RESET_OFF 0x0001u
#define SSERIAL_NOTHING 0x80000000u    /* is ignored */
/* Commands of a channel. */
#define SSERIAL_MODE(mode) ((rtapi_u32)(mode) << 24)
#define SSERIAL_READ_BYTE 0x4C000000u  /* | address */
#define SSERIAL_WRITE(log2) (0x64000000u + ((rtapi_u32)(log2) << 24)) /* | address, 1 << log2 bytes */
#define SSERIAL_NON_VOLATILE 0xEC000000u

enum sserial_state { SSERIAL_IDLE = 0, SSERIAL_PARAM = 1, SSERIAL_STARTING = 2, SSERIAL_RUNNING = 3,
    SSERIAL_STOPPING = 4,
                     SSERIAL_STOPPED = 5, SSERIAL_ERROR = 10 };

/* A parameter that the card keeps. In HAL memory. */
struct sserial_param {
    struct field field;
    rtapi_u64 written;                 /* as the card has it */
};

/* A card at a channel. In HAL memory. */
struct sserial_remote {
    int channel, mode;
    rtapi_u32 serial, name_word;
    char card[5];                      /* such as 7i76 */
    char prefix[HAL_NAME_LEN + 1];     /* of its names in HAL */
    rtapi_u16 ptoc, gtoc;
    struct field field[SSERIAL_FIELDS];
    int fields, words_in, words_out;
    struct sserial_param param[SSERIAL_PARAMS];
    int params;
    rtapi_u32 told;                    /* errors of the card that were told */
};

/* In HAL memory. */
struct sserial_port {
    struct hm2_md *md;
    int number;
    rtapi_u32 mask;                    /* channels with a card */
    struct sserial_remote *remote[SSERIAL_CHANNELS];
    hal_bool_t run;
    hal_uint_t port_state, port_state2, port_state3, fault_count, fault_inc, fault_dec, fault_lim;
    hal_sint_t debug;
    int state;
    int late;                          /* cycles in a row in which the command was not done */
    bool told_late, stop_due;
    /* A parameter that is being written. */
    struct sserial_remote *param_remote;
    struct sserial_param *param;
    int step;
    rtapi_u32 *command_in, *data_in, *cs_in, *user_in[SSERIAL_WORDS];
    rtapi_u32 *command_out, *user_out[SSERIAL_WORDS];
};

extern int hm2_use_serial_numbers, hm2_sserial_baudrate;

static inline rtapi_u32 sserial_addr(const struct sserial_port *p, int reg, int channel)
{
    return hm2_register_addr(p->md, reg, p->number) + 4 * (rtapi_u32)channel;
}
enum { SSERIAL_REG_COMMAND, SSERIAL_REG_DATA, SSERIAL_REG_CS, SSERIAL_REG_USER };

/* [init] Finds the cards at the channels of mask (modes: of each channel); the others leave the mask. */
int sserial_discover(struct hm2 *hm2, struct sserial_port *p, const char modes[SSERIAL_CHANNELS]);
/* [init] Fields of cards that do not describe themselves; 0: not such a card. */
int sserial_builtin(struct hm2 *hm2, struct sserial_port *p, struct sserial_remote *r);
/* [init] Adds a field of a table. */
int sserial_add_field(struct hm2 *hm2, struct sserial_remote *r, const struct field *f);
int sserial_add_param(struct hm2 *hm2, struct sserial_remote *r, const struct field *f);
/* [init] Reads `bytes` bytes of a card, in setup mode. 0 or -errno. */
int sserial_read_remote(struct hm2 *hm2, struct sserial_port *p, int channel, rtapi_u32 addr, void *buffer, int bytes);

/* [servo] One step of writing a parameter that changed; true while it takes. */
bool sserial_write_params(struct hm2 *hm2, struct sserial_port *p);

#endif
