/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2.h - a HostMot2 board as the function modules see it.
 *
 * A function module (encoder.c, stepgen.c, ...) is one struct hm2_function_ops: it claims module
 * descriptors, registers what is transferred in each cycle, and gives the steps of a cycle.
 */
#ifndef HM2_H
#define HM2_H

#include "hm2_llio.h"
#include "components/comp_util.h"

#define HM2_MAX_MODULES 48
#define HM2_MAX_PINS 1000
#define HM2_MAX_REGIONS 256
#define HM2_NAME_LEN 47       /* pins' names on cards */
#define HM2_SSERIAL_PORTS 4
#define HM2_ABSENC_CHANNELS 32
#define HM2_FORMAT_LEN 127

enum hm2_gtag {
    HM2_GTAG_NONE = 0,
    HM2_GTAG_WATCHDOG = 2,
    HM2_GTAG_IOPORT = 3,
    HM2_GTAG_ENCODER = 4,
    HM2_GTAG_STEPGEN = 5,
    HM2_GTAG_PWMGEN = 6,
    HM2_GTAG_SSI = 8,
    HM2_GTAG_UART_TX = 9,
    HM2_GTAG_UART_RX = 10,
    HM2_GTAG_MUXED_ENCODER = 12,
    HM2_GTAG_MUXED_ENCODER_SEL = 13,
    HM2_GTAG_BSPI = 14,
    HM2_GTAG_TPPWM = 19,
    HM2_GTAG_BISS = 24,
    HM2_GTAG_FABS = 25,
    HM2_GTAG_DPLL = 26,
    HM2_GTAG_PKTUART_TX = 27,
    HM2_GTAG_PKTUART_RX = 28,
    HM2_GTAG_INMUX = 30,
    HM2_GTAG_INM = 35,
    HM2_GTAG_XY2MOD = 43,
    HM2_GTAG_RCPWMGEN = 44,
    HM2_GTAG_OUTM = 45,
    HM2_GTAG_LED = 128,
    HM2_GTAG_RESOLVER = 192,
    HM2_GTAG_SMARTSERIAL = 193,
    HM2_GTAG_SSR = 195,
    HM2_GTAG_SMARTSERIALB = 198,
    HM2_GTAG_ONESHOT = 199,
    HM2_GTAG_PERIODM = 200
};

/* What num_...= of a config string counts. */
enum hm2_count {
    HM2_NUM_ENCODERS, HM2_NUM_PWMGENS, HM2_NUM_TPPWMGENS, HM2_NUM_RCPWMGENS, HM2_NUM_STEPGENS, HM2_NUM_RESOLVERS,
    HM2_NUM_BSPIS, HM2_NUM_UARTS, HM2_NUM_PKTUARTS, HM2_NUM_INMUXS, HM2_NUM_INMS, HM2_NUM_XY2MODS, HM2_NUM_SSRS,
    HM2_NUM_OUTMS, HM2_NUM_ONESHOTS, HM2_NUM_PERIODMS, HM2_NUM_LEDS, HM2_NUM_DPLLS, HM2_COUNTS
};

struct hm2_config {
    char firmware[HM2_FORMAT_LEN + 1];         /* empty: none given */
    int num[HM2_COUNTS];                       /* -1: all that the firmware has */
    int stepgen_width;                         /* output pins of each stepgen */
    char sserial_mode[HM2_SSERIAL_PORTS][8];   /* of each channel: '0'..'9', or 'x' */
    char ssi_format[HM2_ABSENC_CHANNELS][HM2_FORMAT_LEN + 1]; /* empty: not used */
    char biss_format[HM2_ABSENC_CHANNELS][HM2_FORMAT_LEN + 1];
    char fanuc_format[HM2_ABSENC_CHANNELS][HM2_FORMAT_LEN + 1];
    bool enable_raw;
};

struct hm2_idrom {
    rtapi_u32 type, modules, pins;             /* offsets from the IDROM */
    char board[9];
    rtapi_u32 fpga_size, fpga_pins, ports, width, port_width, clock_low, clock_high;
    rtapi_u32 instance_stride[2], register_stride[2];
};

struct hm2_md {
    rtapi_u8 gtag, version, clock_tag, instances, registers;
    rtapi_u16 base;
    rtapi_u32 multiple;                        /* bit n: register n exists once per instance */
    rtapi_u32 clock, register_stride, instance_stride; /* Hz, bytes, bytes */
};

/* In HAL memory. */
struct hm2_pin {
    rtapi_u8 sec_pin, sec_tag, sec_unit;
    rtapi_u8 owner;                            /* gtag: IOPORT or sec_tag */
    bool start_output;                         /* becomes an output with the first write */
    bool output;                               /* wanted direction of a function's pin */
    hal_bool_t in, in_not;
    hal_bool_t out, is_output;                 /* full GPIO */
    hal_bool_t invert, opendrain;              /* full GPIO and outputs of functions */
};
#define HM2_PIN_OUTPUT 0x80                    /* of sec_pin */
#define HM2_UNIT_GLOBAL 0x80                   /* of sec_unit */

/* A block that is moved in each cycle. */
struct hm2_region {
    rtapi_u16 addr;
    int words;
    rtapi_u32 *buffer;
};

struct hm2;

/* state: what claim() made. Steps may be NULL. */
struct hm2_function_ops {
    rtapi_u8 gtag[3];
    /* [init] Takes a module of one of the gtags; may be called again with *state set, for another
     * one. Sets hm2->instances. Number of instances in use (0: *state stays), or -errno. */
    int (*claim)(struct hm2 *hm2, const struct hm2_md *md, void **state);
    /* [init] After the pins were given away; and after the first transfer. 0 or -errno. */
    int (*export)(struct hm2 *hm2, void *state);
    void (*start)(struct hm2 *hm2, void *state);
    /* [servo] Queues reads that are not the same in each cycle. */
    void (*request)(struct hm2 *hm2, void *state);
    /* [servo] From what was read to the pins. */
    void (*process)(struct hm2 *hm2, void *state, long period);
    /* [servo] From the pins to what is written. */
    void (*prepare)(struct hm2 *hm2, void *state, long period);
    /* [servo] Writes registers of settings when they changed; force: all of them. */
    void (*write)(struct hm2 *hm2, void *state, bool force);
    /* [servo] Prints the state, for raw.dump_state. */
    void (*print)(struct hm2 *hm2, void *state);
};

extern const struct hm2_function_ops hm2_ioport, hm2_watchdog, hm2_pwmgen, hm2_oneshot, hm2_periodm, hm2_rcpwmgen,
    hm2_inmux, hm2_inm, hm2_xy2mod, hm2_tppwm, hm2_stepgen, hm2_encoder, hm2_resolver, hm2_dpll, hm2_led, hm2_ssr,
    hm2_outm, hm2_absenc, hm2_sserial, hm2_bspi, hm2_uart, hm2_pktuart, hm2_raw;

#define HM2_FUNCTIONS 32

struct hm2 {
    struct hm2_llio *io;
    struct hm2 *next;                          /* list of boards */
    struct hm2_config config;
    struct hm2_idrom idrom;
    rtapi_u16 idrom_addr;
    struct hm2_md md[HM2_MAX_MODULES];
    int mds;
    struct hm2_pin *pin;
    int pins;
    rtapi_u8 instances[256];                   /* in use, by gtag */
    struct hm2_region reads[HM2_MAX_REGIONS], writes[HM2_MAX_REGIONS];
    int num_reads, num_writes;
    void *state[HM2_FUNCTIONS];
    bool written;                              /* the first write has been */
    bool forcing;                              /* every register of settings is being written */
};

#define HM2_ERR(hm2, fmt, ...) rtapi_print_msg(RTAPI_MSG_ERR, "hm2/%s: " fmt, (hm2)->io->name, ##__VA_ARGS__)
#define HM2_WARN(hm2, fmt, ...) rtapi_print_msg(RTAPI_MSG_ERR, "hm2/%s: " fmt, (hm2)->io->name, ##__VA_ARGS__)
#define HM2_PRINT(hm2, fmt, ...) rtapi_print("hm2/%s: " fmt, (hm2)->io->name, ##__VA_ARGS__)

/* ---- Names in HAL [init] -------------------------------------------------- */

struct hm2_item {
    const char *name;
    hal_type_t type;                           /* HAL_BIT, HAL_S32, HAL_U32, HAL_FLOAT */
    hal_pdir_t dir;                            /* of a pin or a parameter */
    size_t offset;                             /* of its reference */
    double value;                              /* at the beginning */
};
#define HM2_ITEM(type, dir, structure, field, name, value) \
    {name, HAL_##type, HAL_##dir, offsetof(struct structure, field), value}
#define HM2_COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

/* Makes pins and parameters `<board>.<prefix><name>`; base, in HAL memory, holds the references. */
int hm2_export(struct hm2 *hm2, const struct hm2_item *items, int n, void *base, const char *prefix, ...)
    __attribute__((format(printf, 5, 6)));

/* ---- Transfers ------------------------------------------------------------ */

/* [init] Registers a block of every cycle; its buffer (zero, never given back while the board is
 * there), or NULL. At most 127 words. */
rtapi_u32 *hm2_read_region(struct hm2 *hm2, rtapi_u32 addr, int words);
rtapi_u32 *hm2_write_region(struct hm2 *hm2, rtapi_u32 addr, int words);
/* [init] At once; nonzero on success. */
int hm2_read_now(struct hm2 *hm2, rtapi_u32 addr, void *buffer, int bytes);
int hm2_write_now(struct hm2 *hm2, rtapi_u32 addr, rtapi_u32 value);
/* [any] Writes a register with the next transfer. */
void hm2_queue_write(struct hm2 *hm2, rtapi_u32 addr, rtapi_u32 value);
/* [any] The same if value differs from *last, or is forced. */
void hm2_write_changed(struct hm2 *hm2, rtapi_u32 addr, rtapi_u32 value, rtapi_u32 *last, bool force);

/* ---- Modules [init] ------------------------------------------------------- */

static inline rtapi_u32 hm2_register_addr(const struct hm2_md *md, int reg, int instance)
{
    return md->base + (rtapi_u32)reg * md->register_stride + (rtapi_u32)instance * md->instance_stride;
}
/* Is md laid out as the driver knows it? Else -EINVAL with a message. version < 0: any. */
int hm2_check_md(struct hm2 *hm2, const struct hm2_md *md, int version, int registers, rtapi_u32 instance_stride,
                 rtapi_u32 multiple);
/* How many instances to use: as the config string says, else all. -EINVAL: more than there are. */
int hm2_count(struct hm2 *hm2, const struct hm2_md *md, enum hm2_count what);
/* The number of such modules that the firmware has, whatever the config string says. */
const struct hm2_md *hm2_find_md(const struct hm2 *hm2, int gtag);
/* State of another function; NULL: the board has none in use. */
void *hm2_state(const struct hm2 *hm2, const struct hm2_function_ops *ops);
/* Name of a function for people, and in HAL (NULL: none). */
const char *hm2_gtag_name(int gtag);
const char *hm2_gtag_hal_name(int gtag);
/* Does the board have the clock that follows the thread, in use? */
bool hm2_has_dpll(const struct hm2 *hm2);
/* [any] value, limited; no number is 0. */
static inline double hm2_clip(double value, double low, double high)
{
    if(isnan(value)) value = 0;
    return value < low ? low : value > high ? high : value;
}
/* Register of a module's DPLL timer: timer -1 (none) to 4. */
rtapi_u32 hm2_timer_register(rtapi_s32 timer);

/* ---- Files of the core [init] --------------------------------------------- */

/* The list of boards, for functions that other drivers call by a channel's name. */
extern struct hm2 *hm2_boards;

const char *hm2_count_token(enum hm2_count what);
int hm2_config_parse(struct hm2 *hm2, const char *text);
int hm2_firmware_load(struct hm2 *hm2);
int hm2_idrom_read(struct hm2 *hm2, bool debug);
int hm2_modules_read(struct hm2 *hm2, bool debug);
int hm2_pins_read(struct hm2 *hm2, bool debug);
/* Gives pins to the functions that are in use. */
void hm2_pins_assign(struct hm2 *hm2);
/* The pins of a module work at once, for finding out what hangs on them. */
void hm2_pins_enable_now(struct hm2 *hm2, int gtag);
void hm2_pins_print(struct hm2 *hm2);
int hm2_pins_export(struct hm2 *hm2);

/* ---- Parts of functions that the core needs ------------------------------- */

/* [servo] Only the pins that are inputs; only the outputs. */
void hm2_ioport_process_inputs(struct hm2 *hm2);
void hm2_ioport_read_gpio(struct hm2 *hm2);
void hm2_ioport_write_gpio(struct hm2 *hm2);
/* [any] Is the watchdog's bit set and the user has not answered yet? false without a watchdog. */
bool hm2_watchdog_bitten(struct hm2 *hm2);
/* [any] Are there absolute encoders? [servo] Starts their transfers that no timer starts. */
bool hm2_absenc_used(struct hm2 *hm2);
void hm2_absenc_trigger(struct hm2 *hm2);
/* [servo] Prints the state of every function. */
void hm2_print_state(struct hm2 *hm2);
/* [init] Bites as soon as possible. */
void hm2_watchdog_force_bite(struct hm2 *hm2);

#endif
