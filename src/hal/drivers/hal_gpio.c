/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_gpio.c - lines of GPIO chips, by their names, as pins.
 *
 * The kernel's GPIO character devices are used directly (linux/gpio.h, version 2, Linux 5.10 and later): the lines of
 * one direction of one chip are one request, a bank, whatever the flags of each are.
 *
 * In:     /dev/gpiochip*; for tests, the folder KERF_GPIO_CHIPS in place of /dev. In simulated time without that folder
 *         every line is there, and no line moves: inputs are low.
 * Thread: read, write and reset [any]; each makes one system call (ioctl) for a bank, which is the only way to a line,
 *         and reset waits for at most a quarter of its thread's period
 */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include <kerf_clock.h>
#include "components/comp_util.h"
#include "drivers/pulse.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Lines of GPIO chips");

#define MAX_LINES 128                   /* of each direction */
#define MAX_BANKS 32
#define CONSUMER "linuxcnc"
#define TAG "hal_gpio: "

#define NAMES(parameter, text) \
    static char *parameter[MAX_LINES]; \
    RTAPI_MP_ARRAY_STRING(parameter, MAX_LINES, text)
NAMES(inputs, "names of lines");
NAMES(outputs, "names of lines");
NAMES(invert, "outputs that show the inverse");
NAMES(reset, "outputs that go to rest by hal_gpio.reset");
NAMES(opendrain, "outputs that only pull down");
NAMES(opensource, "outputs that only pull up");
NAMES(biasdisable, "lines without a pull-up or pull-down");
NAMES(pulldown, "lines with a pull-down");
NAMES(pullup, "lines with a pull-up");

struct line {
    const char *name;
    int output;
    int inverted, resets;               /* of an output */
    rtapi_u64 flags;                    /* GPIO_V2_LINE_FLAG_... */
    int found;
    rtapi_u32 offset;                   /* at its chip */
    hal_bool_t in, in_not;              /* of an input */
    hal_bool_t out;                     /* of an output */
};

/* Lines of one direction of one chip; bit n of the masks is line n. */
struct bank {
    int fd;
    char chip[GPIO_MAX_NAME_SIZE];
    int output, lines;
    struct line *line[GPIO_V2_LINES_MAX];
    rtapi_u64 mask;                     /* all lines */
    rtapi_u64 shown;                    /* levels of outputs */
    int known;                          /* the levels are at the lines */
    rtapi_u64 rest;                     /* levels while the pins are FALSE */
    rtapi_u64 resets;                   /* lines of reset */
    int lost;                           /* the chip answers no more; told */
};

static int comp_id;
static int simulated;
static int lines, banks;
static struct bank bank[MAX_BANKS];
static struct shared {                  /* in HAL's memory, as its references must be */
    struct line line[2 * MAX_LINES];
    hal_uint_t reset_ns;
} *shared;
static long long written;               /* time of the last change, ns */

/* ---- Cycle -------------------------------------------------------------- */

/* The chip of a bank is gone: told once. Its inputs are neither on nor "not on". */
static void lose(struct bank *b)
{
    int n;
    if(!b->lost)
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s does not answer any more (%s): its %s are without effect\n", b->chip,
                        strerror(errno), b->output ? "outputs" : "inputs");
    b->lost = 1;
    for(n = 0; n < b->lines && !b->output; n++) {
        hal_set_bool(b->line[n]->in, 0);
        hal_set_bool(b->line[n]->in_not, 0);
    }
}

/* HAL function hal_gpio.read. */
static void read_lines(void *arg, long period)
{
    int i, n;
    (void)arg;
    (void)period;
    for(i = 0; i < banks; i++) {
        struct bank *b = &bank[i];
        struct gpio_v2_line_values values = {.mask = b->mask};
        if(b->output) continue;
        if(!simulated && ioctl(b->fd, GPIO_V2_LINE_GET_VALUES_IOCTL, &values) < 0) {
            lose(b);
            continue;
        }
        b->lost = 0;
        for(n = 0; n < b->lines; n++) {
            rtapi_bool on = values.bits >> n & 1;
            hal_set_bool(b->line[n]->in, on);
            hal_set_bool(b->line[n]->in_not, !on);
        }
    }
}

/* Levels of the lines of a mask, all at once. */
static void put(struct bank *b, rtapi_u64 mask, rtapi_u64 levels)
{
    struct gpio_v2_line_values values = {.mask = mask, .bits = levels};
    b->known = simulated || ioctl(b->fd, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) >= 0;
    b->shown = (b->shown & ~mask) | (levels & mask);
    if(b->known) b->lost = 0;
    else lose(b);
}

/* HAL function hal_gpio.write: lines are written when one of them changes. */
static void write_lines(void *arg, long period)
{
    int i, n;
    (void)arg;
    (void)period;
    for(i = 0; i < banks; i++) {
        struct bank *b = &bank[i];
        rtapi_u64 levels = b->rest;
        if(!b->output) continue;
        for(n = 0; n < b->lines; n++) levels ^= (rtapi_u64)(hal_get_bool(b->line[n]->out) != 0) << n;
        if(b->known && levels == b->shown) continue;
        put(b, b->mask, levels);
        written = rtapi_get_time();
    }
}

/* HAL function hal_gpio.reset: ends the pulses that the last write began. */
static void reset_lines(void *arg, long period)
{
    rtapi_u32 width = pulse_width(shared->reset_ns, period);
    int i, waited = 0;
    (void)arg;
    for(i = 0; i < banks; i++) {
        struct bank *b = &bank[i];
        if(!b->known || !((b->shown ^ b->rest) & b->resets)) continue;
        if(!waited) pulse_wait(written, width);
        waited = 1;
        put(b, b->resets, b->rest);
    }
}

/* ---- Start -------------------------------------------------------------- */

static struct line *line_of(const char *name)
{
    int i;
    for(i = 0; i < lines; i++)
        if(strcmp(shared->line[i].name, name) == 0) return &shared->line[i];
    return NULL;
}

static int add_lines(char *const names[], int output)
{
    int i;
    for(i = 0; i < MAX_LINES && names[i] && names[i][0]; i++) {
        if(line_of(names[i])) {
            rtapi_print_msg(RTAPI_MSG_ERR, TAG "The GPIO line %s is named twice in inputs= and outputs=\n", names[i]);
            return -EINVAL;
        }
        shared->line[lines++] = (struct line){.name = names[i], .output = output};
    }
    return 0;
}

static const struct flag_list {
    const char *name;
    char *const *names;
    rtapi_u64 flag, against;            /* what it sets; what it cannot be with */
    int outputs_only;
} flag_lists[] = {
    {"invert", invert, 0, 0, 1},
    {"reset", reset, 0, 0, 1},
    {"opendrain", opendrain, GPIO_V2_LINE_FLAG_OPEN_DRAIN, GPIO_V2_LINE_FLAG_OPEN_SOURCE, 1},
    {"opensource", opensource, GPIO_V2_LINE_FLAG_OPEN_SOURCE, GPIO_V2_LINE_FLAG_OPEN_DRAIN, 1},
    {"biasdisable", biasdisable, GPIO_V2_LINE_FLAG_BIAS_DISABLED,
     GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN | GPIO_V2_LINE_FLAG_BIAS_PULL_UP, 0},
    {"pulldown", pulldown, GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN,
     GPIO_V2_LINE_FLAG_BIAS_DISABLED | GPIO_V2_LINE_FLAG_BIAS_PULL_UP, 0},
    {"pullup", pullup, GPIO_V2_LINE_FLAG_BIAS_PULL_UP,
     GPIO_V2_LINE_FLAG_BIAS_DISABLED | GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN, 0},
};
#define FLAG_LISTS ((int)(sizeof flag_lists / sizeof flag_lists[0]))

static int set_flag(const struct flag_list *list, const char *name)
{
    struct line *l = line_of(name);
    if(!l || (list->outputs_only && !l->output)) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s=%s is without effect: the line is not in outputs=%s\n", list->name, name,
                        list->outputs_only ? "" : " or inputs=");
        return 0;
    }
    if(l->flags & list->against) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s=%s: another of the line's flags is against it\n", list->name, name);
        return -EINVAL;
    }
    l->flags |= list->flag;
    if(list->names == invert) l->inverted = 1;
    if(list->names == reset) l->resets = 1;
    return 0;
}

static int set_flags(void)
{
    int i, n;
    for(i = 0; i < FLAG_LISTS; i++)
        for(n = 0; n < MAX_LINES && flag_lists[i].names[n] && flag_lists[i].names[n][0]; n++)
            COMP_TRY(set_flag(&flag_lists[i], flag_lists[i].names[n]));
    return 0;
}

/* Has one line of a chip in the bank of its direction that has room. */
static int add_to_bank(struct line *l, int first_of_chip, const char *chip)
{
    struct bank *b;
    int i, n;
    for(i = first_of_chip; i < banks; i++)
        if(bank[i].output == l->output && bank[i].lines < GPIO_V2_LINES_MAX) break;
    if(i == MAX_BANKS) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "the lines are on too many chips: at most %d\n", MAX_BANKS / 2);
        return -EINVAL;
    }
    b = &bank[i];
    if(i == banks) {
        *b = (struct bank){.fd = -1, .output = l->output};
        snprintf(b->chip, sizeof b->chip, "%s", chip);
        banks++;
    }
    n = b->lines++;
    b->line[n] = l;
    b->mask |= 1ull << n;
    b->rest |= (rtapi_u64)l->inverted << n;
    b->resets |= (rtapi_u64)l->resets << n;
    return 0;
}

/* Asks the kernel for the lines of a bank; outputs are at rest from then on. */
static int request(struct bank *b, int chip_fd)
{
    rtapi_u64 direction = b->output ? GPIO_V2_LINE_FLAG_OUTPUT : GPIO_V2_LINE_FLAG_INPUT;
    struct gpio_v2_line_request r = {.consumer = CONSUMER, .num_lines = (rtapi_u32)b->lines, .config.flags = direction};
    struct gpio_v2_line_config *config = &r.config;
    int n, i;
    if(b->output) {
        config->attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
        config->attrs[0].attr.values = b->rest;
        config->attrs[0].mask = b->mask;
        config->num_attrs = 1;
    }
    for(n = 0; n < b->lines; n++) {
        rtapi_u64 flags = direction | b->line[n]->flags;
        r.offsets[n] = b->line[n]->offset;
        if(flags == direction) continue;
        for(i = b->output; i < (int)config->num_attrs && config->attrs[i].attr.flags != flags; i++) {}
        if(i == GPIO_V2_LINE_NUM_ATTRS_MAX) {
            rtapi_print_msg(RTAPI_MSG_ERR, TAG "the lines of %s have too many different sets of flags\n", b->chip);
            return -EINVAL;
        }
        if(i == (int)config->num_attrs) config->num_attrs++;
        config->attrs[i].attr.id = GPIO_V2_LINE_ATTR_ID_FLAGS;
        config->attrs[i].attr.flags = flags;
        config->attrs[i].mask |= 1ull << n;
    }
    if(ioctl(chip_fd, GPIO_V2_GET_LINE_IOCTL, &r) < 0) {
        int err = errno;
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s does not give its %s (the first is %s): %s%s\n", b->chip,
                        b->output ? "outputs" : "inputs", b->line[0]->name, strerror(err),
                        err == EINVAL || err == ENOTSUP ? "; it may lack one of the flags" : "");
        return -err;
    }
    b->fd = r.fd;
    b->shown = b->rest;
    b->known = 1;
    return 0;
}

/* A line of a chip, if it is one of ours. */
static int take(const struct gpio_v2_line_info *info, int first_of_chip, const char *chip)
{
    struct line *l = info->name[0] ? line_of(info->name) : NULL;
    if(!l || l->found) return 0;
    if(info->flags & GPIO_V2_LINE_FLAG_USED) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "The GPIO line %s of %s is in use by '%s'\n", l->name, chip,
                        info->consumer[0] ? info->consumer : "the kernel");
        return -EBUSY;
    }
    l->found = 1;
    l->offset = info->offset;
    return add_to_bank(l, first_of_chip, chip);
}

static int take_lines(int fd, const struct gpiochip_info *chip)
{
    int first = banks;
    rtapi_u32 n;
    for(n = 0; n < chip->lines; n++) {
        struct gpio_v2_line_info info = {.offset = n};
        if(ioctl(fd, GPIO_V2_GET_LINEINFO_IOCTL, &info) < 0) {
            int err = errno;
            rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s tells nothing of its lines: %s%s\n", chip->name, strerror(err),
                            err == EINVAL || err == ENOTTY ? " (needs Linux 5.10 or later)" : "");
            return -err;
        }
        COMP_TRY(take(&info, first, chip->name));
    }
    for(; first < banks; first++) COMP_TRY(request(&bank[first], fd));
    return 0;
}

/* gpiochip and a number; a link to one is no other chip. */
static int is_chip(const struct dirent *entry)
{
    const char *number = entry->d_name + 8;
    return strncmp(entry->d_name, "gpiochip", 8) == 0 && number[0] && !number[strspn(number, "0123456789")] &&
           entry->d_type != DT_LNK;
}

/* Takes our lines from a chip. One that cannot be opened is told and passed over. */
static int look_at(const char *folder, const char *name)
{
    struct gpiochip_info chip;
    char path[256];
    int fd, result = 0;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    fd = rtapi_open_as_root(path, O_RDWR);
    if(fd < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "cannot open %s: %s%s\n", path, strerror(-fd),
                        fd == -EACCES || fd == -EPERM
                            ? "; the user must be in the device's group (often gpio), or rtapi_app setuid"
                            : "");
        return 0;
    }
    if(ioctl(fd, GPIO_GET_CHIPINFO_IOCTL, &chip) < 0)
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "%s is no GPIO chip: %s\n", path, strerror(errno));
    else result = take_lines(fd, &chip);
    close(fd);
    return result;
}

static int find_lines(void)
{
    const char *folder = secure_getenv("KERF_GPIO_CHIPS");
    struct dirent **names = NULL;
    int i, chips, result = 0;
    simulated = !folder && kerf_clock_is_virtual();
    for(i = 0; i < lines && simulated; i++) COMP_TRY(add_to_bank(&shared->line[i], 0, "simulated"));
    if(simulated) return 0;
    if(!folder) folder = "/dev";
    chips = scandir(folder, &names, is_chip, versionsort);
    for(i = 0; i < chips; i++) {
        if(result == 0) result = look_at(folder, names[i]->d_name);
        free(names[i]);
    }
    free(names);
    COMP_TRY(result);
    for(i = 0; i < lines; i++) {
        if(shared->line[i].found) continue;
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "The GPIO line %s can not be found", shared->line[i].name);
        if(chips <= 0) rtapi_print_msg(RTAPI_MSG_ERR, ": there is no GPIO chip %s/gpiochip*\n", folder);
        else rtapi_print_msg(RTAPI_MSG_ERR, " on %d chip%s: gpioinfo lists the names\n", chips, chips > 1 ? "s" : "");
        result = -ENODEV;
    }
    return result;
}

static int export_line(struct line *l)
{
    if(l->output) return hal_pin_new_bool(comp_id, HAL_IN, &l->out, 0, "hal_gpio.%s-out", l->name);
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &l->in, 0, "hal_gpio.%s-in", l->name));
    return hal_pin_new_bool(comp_id, HAL_OUT, &l->in_not, 1, "hal_gpio.%s-in-not", l->name);
}

static int start(void)
{
    int i, resets = 0;
    shared = hal_malloc(sizeof *shared);
    if(!shared) return -ENOMEM;
    COMP_TRY(add_lines(inputs, 0));
    COMP_TRY(add_lines(outputs, 1));
    if(lines == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, TAG "no lines: inputs= or outputs= must name some\n");
        return -EINVAL;
    }
    COMP_TRY(set_flags());
    COMP_TRY(find_lines());
    for(i = 0; i < lines; i++) {
        COMP_TRY(export_line(&shared->line[i]));
        resets |= shared->line[i].resets;
    }
    COMP_TRY(hal_export_funct("hal_gpio.read", read_lines, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("hal_gpio.write", write_lines, NULL, 0, 0, comp_id));
    if(!resets) return 0;
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RW, &shared->reset_ns, 0, "hal_gpio.reset_ns"));
    return hal_export_funct("hal_gpio.reset", reset_lines, NULL, 0, 0, comp_id);
}

/* Outputs rest; the kernel gets its lines back. */
static void release(void)
{
    int i;
    for(i = 0; i < banks; i++) {
        if(bank[i].fd < 0) continue;
        if(bank[i].output) put(&bank[i], bank[i].mask, bank[i].rest);
        close(bank[i].fd);
    }
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hal_gpio");
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
