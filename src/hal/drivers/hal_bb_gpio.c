/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_bb_gpio.c - the GPIO pins of a BeagleBone's headers and its LEDs, by the registers of its AM335x.
 *
 * In:     /proc/device-tree/compatible: is this a BeagleBone? Its registers: /dev/mem
 * Thread: read and write [any]; one or two accesses to a register of each port in use, and the number of pins
 * Source: AM335x Technical Reference Manual, chapters 8, 9 and 25; BeagleBone Black System Reference Manual, chapter 7
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"
#include "drivers/board.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("GPIO pins of a BeagleBone");

#define TAG "hal_bb_gpio: "
#define LEDS 4
#define MAX_PINS 92
#define PORTS 4
#define NONE (-1)

static int user_leds[LEDS] = {NONE, NONE, NONE, NONE};
RTAPI_MP_ARRAY_INT(user_leds, LEDS, "LEDs, 0 to 3");
static int input_pins[MAX_PINS];
RTAPI_MP_ARRAY_INT(input_pins, MAX_PINS, "header and pin, as in 807");
static int output_pins[MAX_PINS];
RTAPI_MP_ARRAY_INT(output_pins, MAX_PINS, "header and pin, as in 912");

/* Registers of a port, in words. */
enum { OUTPUT_ENABLE = 0x134 / 4, DATA_IN = 0x138 / 4, CLEAR = 0x190 / 4, SET = 0x194 / 4 };
static const unsigned long port_address[PORTS] = {0x44E07000, 0x4804C000, 0x481AC000, 0x481AE000};

/* Clocks of the ports. */
#define CLOCKS 0x44E00000
static const int clock_word[PORTS] = {0x408 / 4, 0xAC / 4, 0xB0 / 4, 0xB4 / 4};
#define CLOCK_MODE 3u                   /* mask, and the mode that is on */
#define CLOCK_ON 2u
#define CLOCK_STATE (3u << 16)          /* mask, and the state that is off */

/* What a pad of the chip does. */
#define PADS 0x44E10000
#define PAD_MODE 7u                     /* mask; and the mode that is GPIO */
#define PAD_NO_PULL 0x08u
#define PAD_PULL_UP 0x10u
#define PAD_RECEIVER 0x20u

/* A line of a port, and the offset of its pad. */
struct line {
    rtapi_u8 port, bit;
    rtapi_u16 pad;                      /* 0: there is none */
};
#define HEADER_PINS 47
static const struct line p8[HEADER_PINS] = {
    [3] = {1, 6, 0x818},   [4] = {1, 7, 0x81C},   [5] = {1, 2, 0x808},   [6] = {1, 3, 0x80C},   [7] = {2, 2, 0x890},
    [8] = {2, 3, 0x894},   [9] = {2, 5, 0x89C},   [10] = {2, 4, 0x898},  [11] = {1, 13, 0x834}, [12] = {1, 12, 0x830},
    [13] = {0, 23, 0x824}, [14] = {0, 26, 0x828}, [15] = {1, 15, 0x83C}, [16] = {1, 14, 0x838}, [17] = {0, 27, 0x82C},
    [18] = {2, 1, 0x88C},  [19] = {0, 22, 0x820}, [20] = {1, 31, 0x884}, [21] = {1, 30, 0x880}, [22] = {1, 5, 0x814},
    [23] = {1, 4, 0x810},  [24] = {1, 1, 0x804},  [25] = {1, 0, 0x800},  [26] = {1, 29, 0x87C}, [27] = {2, 22, 0x8E0},
    [28] = {2, 24, 0x8E8}, [29] = {2, 23, 0x8E4}, [30] = {2, 25, 0x8EC}, [31] = {0, 10, 0x8D8}, [32] = {0, 11, 0x8DC},
    [33] = {0, 9, 0x8D4},  [34] = {2, 17, 0x8CC}, [35] = {0, 8, 0x8D0},  [36] = {2, 16, 0x8C8}, [37] = {2, 14, 0x8C0},
    [38] = {2, 15, 0x8C4}, [39] = {2, 12, 0x8B8}, [40] = {2, 13, 0x8BC}, [41] = {2, 10, 0x8B0}, [42] = {2, 11, 0x8B4},
    [43] = {2, 8, 0x8A8},  [44] = {2, 9, 0x8AC},  [45] = {2, 6, 0x8A0},  [46] = {2, 7, 0x8A4},
};
static const struct line p9[HEADER_PINS] = {
    [11] = {0, 30, 0x870}, [12] = {1, 28, 0x878}, [13] = {0, 31, 0x874}, [14] = {1, 18, 0x848}, [15] = {1, 16, 0x840},
    [16] = {1, 19, 0x84C}, [17] = {0, 5, 0x95C},  [18] = {0, 4, 0x958},  [19] = {0, 13, 0x97C}, [20] = {0, 12, 0x978},
    [21] = {0, 3, 0x954},  [22] = {0, 2, 0x950},  [23] = {1, 17, 0x844}, [24] = {0, 15, 0x984}, [25] = {3, 21, 0x9AC},
    [26] = {0, 14, 0x980}, [27] = {3, 19, 0x9A4}, [28] = {3, 17, 0x99C}, [29] = {3, 15, 0x994}, [30] = {3, 16, 0x998},
    [31] = {3, 14, 0x990}, [41] = {0, 20, 0x9B4}, [42] = {0, 7, 0x964},
};
static const struct line led[LEDS] = {{1, 21, 0x854}, {1, 22, 0x858}, {1, 23, 0x85C}, {1, 24, 0x860}};

struct pin {
    const struct line *line;
    hal_bool_t value, invert;
};

static struct port {
    volatile rtapi_u32 *reg;            /* NULL: not in use */
    rtapi_u32 outputs;
    rtapi_u32 taken;                    /* inputs and outputs */
    rtapi_u32 enable_before;            /* the register OUTPUT_ENABLE, given back at the end */
} port[PORTS];

static int comp_id;
static int inputs, outputs;
static struct pin *input, *output;
static volatile rtapi_u32 *clocks, *pads;

/* ---- Cycle -------------------------------------------------------------- */

/* HAL function bb_gpio.read. */
static void read_pins(void *arg, long period)
{
    rtapi_u32 levels[PORTS] = {0};
    int n;
    (void)arg;
    (void)period;
    for(n = 0; n < PORTS; n++)
        if(port[n].reg) levels[n] = port[n].reg[DATA_IN];
    for(n = 0; n < inputs; n++) {
        rtapi_bool on = levels[input[n].line->port] >> input[n].line->bit & 1;
        hal_set_bool(input[n].value, on != hal_get_bool(input[n].invert));
    }
}

/* HAL function bb_gpio.write. */
static void write_pins(void *arg, long period)
{
    rtapi_u32 levels[PORTS] = {0};
    int n;
    (void)arg;
    (void)period;
    for(n = 0; n < outputs; n++)
        if(hal_get_bool(output[n].value) != hal_get_bool(output[n].invert))
            levels[output[n].line->port] |= 1u << output[n].line->bit;
    for(n = 0; n < PORTS; n++) {
        if(!port[n].outputs) continue;
        port[n].reg[SET] = levels[n];
        port[n].reg[CLEAR] = port[n].outputs & ~levels[n];
    }
}

/* ---- Start -------------------------------------------------------------- */

static int check_board(void)
{
    char compatible[256], model[128];
    board_text("/proc/device-tree/compatible", compatible, sizeof compatible);
    if(board_is_simulated() || strstr(compatible, "ti,am33xx")) return 0;
    board_text(BOARD_MODEL, model, sizeof model);
    rtapi_print_msg(RTAPI_MSG_ERR, TAG "needs a BeagleBone with an AM335x: this computer is '%s' (" BOARD_MODEL
                    "); hal_gpio drives the GPIO of other boards\n", model[0] ? model : "unknown");
    return -ENODEV;
}

static int map(unsigned long address, volatile rtapi_u32 **registers)
{
    int r = board_map("/dev/mem", address, registers);
    if(r < 0)
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "cannot reach the registers at %lx by /dev/mem: %s; rtapi_app must be root "
                        "or setuid, and the kernel must allow it\n", address, strerror(-r));
    return r;
}

static int use_port(int n)
{
    rtapi_u32 clock = clocks[clock_word[n]];
    if(port[n].reg) return 0;
    /* Its registers must not be touched without it. */
    if(board_is_simulated()) clock = CLOCK_ON;
    if((clock & CLOCK_MODE) != CLOCK_ON || (clock & CLOCK_STATE) == CLOCK_STATE) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "GPIO Port %d is not enabled in device tree\n", n);
        return -ENODEV;
    }
    COMP_TRY(map(port_address[n], &port[n].reg));
    port[n].enable_before = port[n].reg[OUTPUT_ENABLE];
    return 0;
}

/* A line becomes input or output; outputs are low at first. name: for messages. */
static int take_line(const struct line *line, int is_output, const char *name)
{
    volatile rtapi_u32 *pad = &pads[line->pad / 4];
    rtapi_u32 bit = 1u << line->bit;
    struct port *p = &port[line->port];
    COMP_TRY(use_port(line->port));
    if(p->taken & bit) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s is named twice\n", name);
        return -EINVAL;
    }
    *pad = PAD_MODE | (is_output ? PAD_NO_PULL : PAD_PULL_UP | PAD_RECEIVER);
    if((*pad & PAD_MODE) != PAD_MODE) {     /* the chip takes it from the kernel alone */
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s is not a GPIO now (mode %u), and only the kernel can change that: "
                        "config-pin, or an overlay of the device tree\n", name, *pad & PAD_MODE);
        return -EBUSY;
    }
    p->taken |= bit;
    if(!is_output) {
        p->reg[OUTPUT_ENABLE] |= bit;       /* 1 is input */
        return 0;
    }
    p->outputs |= bit;
    p->reg[CLEAR] = bit;
    p->reg[OUTPUT_ENABLE] &= ~bit;
    return 0;
}

static int export_pin(struct pin *p, const struct line *line, hal_pdir_t dir, const char *name)
{
    p->line = line;
    COMP_TRY(hal_pin_new_bool(comp_id, dir, &p->value, 0, "bb_gpio.%s", name));
    return hal_pin_new_bool(comp_id, HAL_IN, &p->invert, 0, "bb_gpio.%s-invert", name);
}

static int add_led(int n)
{
    char name[16];
    if(n < 0 || n >= LEDS) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "user_leds=%d: must be 0 to %d\n", n, LEDS - 1);
        return -EINVAL;
    }
    rtapi_snprintf(name, sizeof name, "userled%d", n);
    COMP_TRY(take_line(&led[n], 1, name));
    return export_pin(&output[outputs++], &led[n], HAL_IN, name);
}

/* code: header times 100 plus the pin; the headers were 1 and 2 once. */
static int add_pin(int code, int is_output)
{
    const struct line *line = NULL;
    char name[16];
    int header, number;
    if(code >= 101 && code < 300) code += 700;
    header = code / 100;
    number = code % 100;
    if(code > 0 && number < HEADER_PINS) line = header == 8 ? &p8[number] : header == 9 ? &p9[number] : NULL;
    if(!line || !line->pad) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "pin p%d.%02d is not available as a GPIO.\n", header, abs(number));
        return -EINVAL;
    }
    rtapi_snprintf(name, sizeof name, "p%d.%s-%02d", header, is_output ? "out" : "in", number);
    COMP_TRY(take_line(line, is_output, name));
    if(is_output) return export_pin(&output[outputs++], line, HAL_IN, name);
    return export_pin(&input[inputs++], line, HAL_OUT, name);
}

static int add_pins(void)
{
    int n;
    for(n = 0; n < LEDS && user_leds[n] != NONE; n++) COMP_TRY(add_led(user_leds[n]));
    for(n = 0; n < MAX_PINS && input_pins[n]; n++) COMP_TRY(add_pin(input_pins[n], 0));
    for(n = 0; n < MAX_PINS && output_pins[n]; n++) COMP_TRY(add_pin(output_pins[n], 1));
    if(inputs + outputs > 0) return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, TAG "no pins: user_leds=, input_pins= or output_pins= must name some\n");
    return -EINVAL;
}

static int start(void)
{
    COMP_TRY(check_board());
    input = hal_malloc(sizeof *input * MAX_PINS);
    output = hal_malloc(sizeof *output * (MAX_PINS + LEDS));
    if(!input || !output) return -ENOMEM;
    COMP_TRY(map(CLOCKS, &clocks));
    COMP_TRY(map(PADS, &pads));
    COMP_TRY(add_pins());
    COMP_TRY(hal_export_funct("bb_gpio.read", read_pins, NULL, 0, 0, comp_id));
    return hal_export_funct("bb_gpio.write", write_pins, NULL, 0, 0, comp_id);
}

/* Outputs go low, and every line has the direction of before. */
static void release(void)
{
    int n;
    for(n = 0; n < PORTS; n++) {
        if(!port[n].reg) continue;
        port[n].reg[CLEAR] = port[n].outputs;
        port[n].reg[OUTPUT_ENABLE] =
            (port[n].reg[OUTPUT_ENABLE] & ~port[n].taken) | (port[n].enable_before & port[n].taken);
        board_unmap(port[n].reg);
    }
    if(clocks) board_unmap(clocks);
    if(pads) board_unmap(pads);
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hal_bb_gpio");
    if(comp_id < 0) return comp_id;
    r = start();
    if(r < 0) {
        hal_exit(comp_id);
        release();
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
    release();
}
