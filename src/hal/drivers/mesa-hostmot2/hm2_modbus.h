/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_modbus.h - Modbus devices on a frame channel (pktuart) of a HostMot2 board: what a .mbccb file
 * says, and values in frames.
 */
#ifndef HM2_MODBUS_H
#define HM2_MODBUS_H

#include <rtapi.h>
#include <hal.h>
#include "components/comp_util.h"

#define MB_FRAME 256                   /* bytes */
#define MB_NAME_LEN 32                 /* of a pin */
#define MB_MAX_COMMANDS 100
#define MB_ONCE 0xFFFFFFFFu

/* Flags of a command. */
enum { MB_TIMES_OUT = 1, MB_BC_ANSWER = 2, MB_NO_ANSWER = 4, MB_RESEND = 8, MB_WRITE_FLUSH = 0x10, MB_DISABLED = 0x20,
       MB_PARITY = 0x100, MB_ODD = 0x200, MB_TWO_STOP = 0x400 };
/* Flags of the file's format. */
enum { MB_FORMAT_PARITY = 1, MB_FORMAT_ODD = 2, MB_FORMAT_TWO_STOP = 4, MB_FORMAT_FULL_DUPLEX = 8,
    MB_FORMAT_SUSPENDED = 16 };
/* Flags of a pin. */
enum { MB_PIN_SCALE = 1, MB_PIN_CLAMP = 2 };
enum { MB_R_COILS = 1, MB_R_INPUTS = 2, MB_R_REGISTERS = 3, MB_R_INPUTREGS = 4, MB_W_COIL = 5, MB_W_REGISTER = 6,
       MB_W_COILS = 15, MB_W_REGISTERS = 16 };

/* In HAL memory. */
struct mb_pin {
    char name[MB_NAME_LEN + 1];
    rtapi_u8 mtype, htype, flags;
    rtapi_u16 at;                      /* register, or bit, in the command */
    hal_refs_u value, scale, offset;
    hal_real_t scaled;
};

/* In HAL memory. func 0: a pause of timeout_us, or in the init list (addr 1) other settings. */
struct mb_command {
    rtapi_u8 mbid, func;
    rtapi_u16 flags, addr, count;      /* count: registers or bits */
    rtapi_u16 delays[2];               /* receive, transmit, of other settings */
    rtapi_u16 drive_delay;
    rtapi_u32 interval_us, timeout_us;
    int pins;
    struct mb_pin *pin;
    rtapi_u8 fixed[MB_FRAME];          /* frame of an init command, without its check sum */
    int fixed_len;

    hal_bool_t disable, disabled, reset;
    hal_uint_t errors, error_code;
    bool was_reset, off, done;
    int in_a_row;                      /* errors */
    long long due;                     /* ns */
    rtapi_u8 sent[MB_FRAME];           /* last frame of a write that was answered */
    int sent_len;
};

struct mb_file {
    rtapi_u32 baud;
    rtapi_u16 format, tx_delay, rx_delay, drive_delay, ic_delay;
    struct mb_command *init, *command;
    int inits, commands;
};

/* [init] Reads a file; commands and pins are in HAL memory. 0 or -errno, with a message. */
int mb_file_read(const char *path, struct mb_file *file);

static inline bool mb_is_read(int func)
{
    return func >= MB_R_COILS && func <= MB_R_INPUTREGS;
}
static inline bool mb_is_bits(int func)
{
    return func == MB_R_COILS || func == MB_R_INPUTS || func == MB_W_COIL || func == MB_W_COILS;
}

/* [init] Registers that a type takes; 0: no such type. */
int mb_type_registers(int mtype);
/* [servo] From the wire (big-endian registers, at pin->at) to the pin, and back. false: out of range. */
void mb_show(struct mb_pin *pin, const rtapi_u8 *registers);
void mb_show_bit(struct mb_pin *pin, bool on);
bool mb_put(const struct mb_pin *pin, rtapi_u8 *registers);
bool mb_get_bit(const struct mb_pin *pin);

#endif
