/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * gpio.c - GPIO chips for tests (LD_PRELOAD): what the kernel does for linux/gpio.h. In the folder KERF_GPIO_CHIPS a
 * file gpiochipN has the name of a line on each of its lines, behind it, if it is in use, by whom. Beside it
 * gpiochipN.levels has the lines' levels as characters 0 and 1, and `log` what was asked for and set. While a file
 * `gone` is there no line answers.
 */
#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#define MAX_FDS 1024
static struct request {
    char chip[32];
    int lines;
    __u32 offset[GPIO_V2_LINES_MAX];
} request[MAX_FDS];

static const char *path(const char *chip, const char *suffix)
{
    static char text[4096];
    snprintf(text, sizeof text, "%s/%s%s", getenv("KERF_GPIO_CHIPS"), chip, suffix);
    return text;
}

/* Of line n of a chip; 0 when there is none. */
static int line(const char *chip, unsigned n, char *name, char *user)
{
    char text[128] = "";
    unsigned at = 0;
    FILE *f = fopen(path(chip, ""), "r");
    name[0] = user[0] = 0;
    while (fgets(text, sizeof text, f) && at++ < n) {
    }
    int there = !feof(f);
    fclose(f);
    if (there) {
        sscanf(text, "%31s %31[^\n]", name, user);
    }
    return there;
}

static void flags(FILE *log, __u64 value)
{
    static const struct {
        __u64 bit;
        const char *name;
    } names[] = {{GPIO_V2_LINE_FLAG_INPUT, "in"}, {GPIO_V2_LINE_FLAG_OUTPUT, "out"},
                 {GPIO_V2_LINE_FLAG_OPEN_DRAIN, "drain"}, {GPIO_V2_LINE_FLAG_OPEN_SOURCE, "source"},
                 {GPIO_V2_LINE_FLAG_BIAS_PULL_UP, "up"}, {GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN, "down"},
                 {GPIO_V2_LINE_FLAG_BIAS_DISABLED, "no-bias"}};
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++) {
        if (value & names[i].bit) {
            fprintf(log, " %s", names[i].name);
        }
    }
}

static void level(const char *chip, unsigned n, int value)
{
    int fd = open(path(chip, ".levels"), O_WRONLY | O_CREAT, 0644);
    pwrite(fd, value ? "1" : "0", 1, n);
    close(fd);
}

static int get_line(const char *chip, struct gpio_v2_line_request *r)
{
    char name[32], user[32];
    FILE *log = fopen(path("log", ""), "a");
    fprintf(log, "%s for %s:", chip, r->consumer);
    for (unsigned n = 0; n < r->num_lines; n++) {
        __u64 set = r->config.flags, values = 0;
        for (unsigned i = 0; i < r->config.num_attrs; i++) {
            const struct gpio_v2_line_config_attribute *a = &r->config.attrs[i];
            if (a->mask >> n & 1) {
                if (a->attr.id == GPIO_V2_LINE_ATTR_ID_FLAGS) {
                    set = a->attr.flags;
                } else {
                    values = a->attr.values;
                }
            }
        }
        line(chip, r->offsets[n], name, user);
        fprintf(log, " %s", name);
        flags(log, set);
        if (set & GPIO_V2_LINE_FLAG_OUTPUT) {
            fprintf(log, " %d", (int)(values >> n & 1));
            level(chip, r->offsets[n], values >> n & 1);
        }
        fprintf(log, n + 1 < r->num_lines ? "," : "\n");
    }
    fclose(log);
    r->fd = open(path(chip, ""), O_RDONLY);
    struct request *own = &request[r->fd];
    snprintf(own->chip, sizeof own->chip, "%s", chip);
    own->lines = (int)r->num_lines;
    memcpy(own->offset, r->offsets, sizeof own->offset);
    return 0;
}

static int get_values(const struct request *r, struct gpio_v2_line_values *v)
{
    char text[256] = "";
    int fd = open(path(r->chip, ".levels"), O_RDONLY);
    if (fd >= 0) {
        read(fd, text, sizeof text);
        close(fd);
    }
    v->bits = 0;
    for (int n = 0; n < r->lines; n++) {
        if (v->mask >> n & 1 && text[r->offset[n]] == '1') {
            v->bits |= 1ull << n;
        }
    }
    return 0;
}

static int set_values(const struct request *r, const struct gpio_v2_line_values *v)
{
    char name[32], user[32];
    FILE *log = fopen(path("log", ""), "a");
    fprintf(log, "set");
    for (int n = 0; n < r->lines; n++) {
        if (v->mask >> n & 1) {
            line(r->chip, r->offset[n], name, user);
            fprintf(log, " %s=%d", name, (int)(v->bits >> n & 1));
            level(r->chip, r->offset[n], v->bits >> n & 1);
        }
    }
    fprintf(log, "\n");
    fclose(log);
    return 0;
}

int ioctl(int fd, unsigned long what, ...)
{
    va_list rest;
    va_start(rest, what);
    void *data = va_arg(rest, void *);
    va_end(rest);
    char link[64], target[4096] = "", name[32], user[32];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    readlink(link, target, sizeof target - 1);
    const char *chip = strrchr(target, '/');
    if (!getenv("KERF_GPIO_CHIPS") || !chip || strcmp(target, path(++chip, "")) != 0) {
        return (int)syscall(SYS_ioctl, fd, what, data);
    }
    errno = ENODEV;
    switch (what) {
    case GPIO_GET_CHIPINFO_IOCTL: {
        struct gpiochip_info *info = data;
        memset(info, 0, sizeof *info);
        snprintf(info->name, sizeof info->name, "%s", chip);
        while (line(chip, info->lines, name, user)) {
            info->lines++;
        }
        return 0;
    }
    case GPIO_V2_GET_LINEINFO_IOCTL: {
        struct gpio_v2_line_info *info = data;
        line(chip, info->offset, info->name, info->consumer);
        info->flags = info->consumer[0] ? GPIO_V2_LINE_FLAG_USED : 0;
        return 0;
    }
    case GPIO_V2_GET_LINE_IOCTL: return get_line(chip, data);
    case GPIO_V2_LINE_GET_VALUES_IOCTL: return access(path("gone", ""), F_OK) ? get_values(&request[fd], data) : -1;
    case GPIO_V2_LINE_SET_VALUES_IOCTL: return access(path("gone", ""), F_OK) ? set_values(&request[fd], data) : -1;
    default: errno = ENOTTY; return -1;
    }
}
