/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_pi_gpio.c - the pins of a Raspberry Pi's header, by the registers of its BCM283x or BCM2711.
 *
 * In:     /proc/device-tree/model, /proc/cpuinfo: which board this is. Its registers: /dev/gpiomem, or /dev/mem
 * Thread: read and write [any]; one or two accesses to a register and the number of pins
 * Source: BCM2835 ARM Peripherals, chapter 6
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"
#include "drivers/board.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Pins of a Raspberry Pi's header");

#define TAG "hal_pi_gpio: "
#define MAX_PINS 26

/* Registers, in words. Each has a bit for a GPIO; FUNCTION has three for each of ten. */
enum { FUNCTION = 0, SET = 7, CLEAR = 10, LEVEL = 13 };
#define FUNCTIONS_OF_WORD 10
#define FUNCTION_MASK 7u
#define FUNCTION_INPUT 0u
#define FUNCTION_OUTPUT 1u

static char *dir = "-1";
RTAPI_MP_STRING(dir, "mask of the pins that are outputs");
static char *exclude = "0";
RTAPI_MP_STRING(exclude, "mask of the pins that are not used");

/* The pins of a header: bit n of the masks is entry n. */
static const struct layout {
    int pins;
    rtapi_u8 gpio[MAX_PINS], number[MAX_PINS];  /* number: at the connector */
} rev_1 = {17,
           {0, 1, 4, 7, 8, 9, 10, 11, 14, 15, 17, 18, 21, 22, 23, 24, 25},
           {3, 5, 7, 26, 24, 21, 19, 23, 8, 10, 11, 12, 13, 15, 16, 18, 22}},
  rev_2 = {17,
           {2, 3, 4, 7, 8, 9, 10, 11, 14, 15, 17, 18, 22, 23, 24, 25, 27},
           {3, 5, 7, 26, 24, 21, 19, 23, 8, 10, 11, 12, 15, 16, 18, 22, 13}},
  forty = {26,
           {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27},
           {3, 5, 7, 29, 31, 26, 24, 21, 19, 23, 32, 33, 8, 10, 36, 11, 12, 35, 38, 40, 15, 16, 18, 22, 37, 13}};

/* Revision codes of boards: the old ones are numbers, the new ones fields. */
#define NEW_STYLE 0x800000u
#define OLD_NUMBER 0xFFFFu
#define LAST_OF_REV_1 3u
#define LAST_KNOWN_TYPE 20u
static const unsigned long gpio_address[] = {0x20200000, 0x3F200000, 0x3F200000, 0xFE200000};  /* of each processor */
#define PROCESSORS (sizeof gpio_address / sizeof gpio_address[0])

struct pin {
    rtapi_u32 bit;
    hal_bool_t out, in;                 /* one of them */
};

static int comp_id;
static int pins;
static rtapi_u32 outputs;               /* GPIOs */
static struct pin *pin;
static volatile rtapi_u32 *reg;
static rtapi_u32 functions_before[3];   /* words of FUNCTION, given back at the end */
#define FUNCTION_WORDS (sizeof functions_before / sizeof functions_before[0])

/* ---- Cycle -------------------------------------------------------------- */

/* HAL function hal_pi_gpio.read. */
static void read_pins(void *arg, long period)
{
    rtapi_u32 levels = reg[LEVEL];
    int n;
    (void)arg;
    (void)period;
    for(n = 0; n < pins; n++)
        if(!(pin[n].bit & outputs)) hal_set_bool(pin[n].in, (levels & pin[n].bit) != 0);
}

/* HAL function hal_pi_gpio.write. */
static void write_pins(void *arg, long period)
{
    rtapi_u32 levels = 0;
    int n;
    (void)arg;
    (void)period;
    for(n = 0; n < pins; n++)
        if(pin[n].bit & outputs && hal_get_bool(pin[n].out)) levels |= pin[n].bit;
    reg[SET] = levels;
    reg[CLEAR] = outputs & ~levels;
}

/* ---- Start -------------------------------------------------------------- */

static int mask_of(const char *name, const char *text, rtapi_u32 *mask)
{
    char *end;
    long long value = strtoll(text, &end, 0);
    if(end == text || *end || value < -0x80000000ll || value > 0xFFFFFFFFll) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        TAG "%s=%s: must be a mask of 32 bits: decimal, 0x and hexadecimal, or 0 and octal\n",
                        name, text);
        return -EINVAL;
    }
    *mask = (rtapi_u32)value;
    return 0;
}

/* 0 if this is a Raspberry Pi; says what it is otherwise. */
static int check_model(void)
{
    char model[128];
    if(board_is_simulated()) return 0;
    board_text(BOARD_MODEL, model, sizeof model);
    if(strncmp(model, "Raspberry", 9) == 0) return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, TAG "unrecognized Raspberry revision: this computer is '%s' (" BOARD_MODEL
                    "); hal_gpio drives the GPIO of other boards\n", model[0] ? model : "unknown");
    return -EINVAL;
}

static int board_code(rtapi_u32 *code)
{
    char line[256];
    int found = 0;
    FILE *f;
    *code = NEW_STYLE;
    if(board_is_simulated()) return 0;
    f = fopen(board_path("/proc/cpuinfo"), "re");
    while(f && !found && fgets(line, sizeof line, f)) found = sscanf(line, "Revision : %x", code) == 1;
    if(f) fclose(f);
    if(found) return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, TAG "unrecognized Raspberry revision: no line 'Revision' in /proc/cpuinfo\n");
    return -EINVAL;
}

/* Its layout and the address of its registers, by the code of the board. */
static int recognize(rtapi_u32 code, const struct layout **layout, unsigned long *address)
{
    rtapi_u32 type = code >> 4 & 0xFF, processor = code >> 12 & 0xF;
    *address = gpio_address[0];
    if(!(code & NEW_STYLE)) {
        *layout = (code & OLD_NUMBER) <= LAST_OF_REV_1 ? &rev_1 : &rev_2;
        return 0;
    }
    if(processor >= PROCESSORS) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "the board of revision %x (Raspberry Pi 5 or later) has another GPIO "
                        "controller: use hal_gpio\n", code);
        return -ENODEV;
    }
    if(type > LAST_KNOWN_TYPE)
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "unknown board of revision %x: taken for one with a header of 40 pins\n",
                        code);
    *layout = &forty;
    *address = gpio_address[processor];
    return 0;
}

static int map_registers(unsigned long address)
{
    int why = board_map("/dev/gpiomem", 0, &reg), mem = why ? board_map("/dev/mem", address, &reg) : 0;
    if(!mem) return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, TAG "cannot reach the GPIO registers: /dev/gpiomem: %s, /dev/mem: %s; the user must "
                    "be in the group gpio, or rtapi_app setuid\n", strerror(-why), strerror(-mem));
    return why;
}

static void set_function(int gpio, rtapi_u32 function)
{
    int word = FUNCTION + gpio / FUNCTIONS_OF_WORD, shift = gpio % FUNCTIONS_OF_WORD * 3;
    reg[word] = (reg[word] & ~(FUNCTION_MASK << shift)) | function << shift;
}

/* A pin of the header with its direction; outputs are low at first. */
static int add_pin(int gpio, int number, int is_output)
{
    struct pin *p = &pin[pins++];
    p->bit = 1u << gpio;
    if(!is_output) {
        set_function(gpio, FUNCTION_INPUT);
        return hal_pin_new_bool(comp_id, HAL_OUT, &p->in, 0, "hal_pi_gpio.pin-%02d-in", number);
    }
    outputs |= p->bit;
    reg[CLEAR] = p->bit;
    set_function(gpio, FUNCTION_OUTPUT);
    return hal_pin_new_bool(comp_id, HAL_IN, &p->out, 0, "hal_pi_gpio.pin-%02d-out", number);
}

static int start(void)
{
    const struct layout *layout;
    rtapi_u32 code, dir_mask, exclude_mask;
    unsigned long address;
    int n;
    COMP_TRY(mask_of("dir", dir, &dir_mask));
    COMP_TRY(mask_of("exclude", exclude, &exclude_mask));
    COMP_TRY(check_model());
    COMP_TRY(board_code(&code));
    COMP_TRY(recognize(code, &layout, &address));
    pin = hal_malloc(sizeof *pin * MAX_PINS);
    if(!pin) return -ENOMEM;
    COMP_TRY(map_registers(address));
    for(n = 0; n < (int)FUNCTION_WORDS; n++) functions_before[n] = reg[FUNCTION + n];
    for(n = 0; n < layout->pins; n++)
        if(!(exclude_mask >> n & 1)) COMP_TRY(add_pin(layout->gpio[n], layout->number[n], dir_mask >> n & 1));
    COMP_TRY(hal_export_funct("hal_pi_gpio.read", read_pins, NULL, 0, 0, comp_id));
    return hal_export_funct("hal_pi_gpio.write", write_pins, NULL, 0, 0, comp_id);
}

/* Outputs go low, and every pin does again what it did before. */
static void release(void)
{
    int n;
    if(!reg) return;
    reg[CLEAR] = outputs;
    for(n = 0; n < (int)FUNCTION_WORDS; n++) reg[FUNCTION + n] = functions_before[n];
    board_unmap(reg);
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hal_pi_gpio");
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
