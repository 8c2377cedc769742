/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hostmot2.c - boards with HostMot2 firmware: registration, and the functions of a cycle.
 *
 * A board driver (hm2_llio.h) gives a board; its firmware says which modules it has; each module's
 * function (struct hm2_function_ops) makes pins of its registers.
 *
 * Thread: read, read-request, write [servo]; read_gpio, write_gpio [servo] or [base]. All bounded by
 * the number of registers of the firmware.
 */
#include <ctype.h>
#include <string.h>
#include <rtapi_app.h>
#include <rtapi_slab.h>
#include "hm2.h"

#define DRIVER_VERSION "0.15"
#define ADDR_COOKIE 0x0100
#define ADDR_CONFIG_NAME 0x0104
#define COOKIE 0x55AACAFE
#define CONFIG_NAME "HOSTMOT2"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Boards with HostMot2 firmware");

static int debug_idrom;
RTAPI_MP_INT(debug_idrom, "nonzero prints the IDROM of each board");
static int debug_module_descriptors;
RTAPI_MP_INT(debug_module_descriptors, "nonzero prints the module descriptors of each board");
static int debug_pin_descriptors;
RTAPI_MP_INT(debug_pin_descriptors, "nonzero prints the pin descriptors of each board");
static int debug_modules;
RTAPI_MP_INT(debug_modules, "nonzero prints the state of the modules in use");

int hm2_use_serial_numbers;
static int use_serial_numbers;
RTAPI_MP_INT(use_serial_numbers, "nonzero names smart-serial cards by their serial numbers");
int hm2_sserial_baudrate = -1;
static int sserial_baudrate = -1;
RTAPI_MP_INT(sserial_baudrate, "bits per second of smart-serial channels; -1 leaves them");

/* In the order in which settings are written; raw, which is no module of the firmware, is the last. */
static const struct hm2_function_ops *const functions[] = {
    &hm2_ioport, &hm2_watchdog, &hm2_pwmgen, &hm2_oneshot, &hm2_periodm, &hm2_rcpwmgen, &hm2_pktuart, &hm2_inmux,
        &hm2_inm,
    &hm2_xy2mod, &hm2_tppwm, &hm2_stepgen, &hm2_sserial, &hm2_bspi, &hm2_uart, &hm2_encoder, &hm2_absenc, &hm2_resolver,
    &hm2_dpll, &hm2_led, &hm2_ssr, &hm2_outm, &hm2_raw,
};
HAL_STATIC_ASSERT(sizeof functions / sizeof functions[0] <= HM2_FUNCTIONS, "room for the states of all functions");

struct hm2 *hm2_boards;
static int comp_id;

/* Calls a step of each function in use that has it. */
#define EACH(hm2, step, ...) \
    do { \
        int each_; \
        for(each_ = 0; each_ < HM2_COUNT(functions); each_++) \
            if((hm2)->state[each_] && functions[each_]->step) \
                functions[each_]->step(hm2, (hm2)->state[each_], ##__VA_ARGS__); \
    } while(0)

void *hm2_state(const struct hm2 *hm2, const struct hm2_function_ops *ops)
{
    int i;
    for(i = 0; i < HM2_COUNT(functions); i++)
        if(functions[i] == ops) return hm2->state[i];
    return NULL;
}

void hm2_print_state(struct hm2 *hm2)
{
    EACH(hm2, print);
}

/* ---- Cycle ---------------------------------------------------------------- */

static bool in_error(const struct hm2 *hm2)
{
    return hal_get_bool(hm2->io->io_error);
}

/* Queues and sends the reads of a cycle. */
static int request(struct hm2 *hm2)
{
    struct hm2_llio *io = hm2->io;
    int i;
    for(i = 0; i < hm2->num_reads; i++) {
        const struct hm2_region *r = &hm2->reads[i];
        int bytes = r->words * 4;
        if(!(io->ops->queue_read ? io->ops->queue_read(io, r->addr, r->buffer, bytes)
                                 : io->ops->read(io, r->addr, r->buffer, bytes))) return 0;
    }
    EACH(hm2, request);
    if(io->ops->send_queued_reads && !io->ops->send_queued_reads(io)) return 0;
    io->read_requested = true;
    return 1;
}

static int receive(struct hm2 *hm2)
{
    struct hm2_llio *io = hm2->io;
    io->read_requested = false;
    return io->ops->receive_queued_reads ? io->ops->receive_queued_reads(io) : 1;
}

/* HAL function <board>.read-request. */
static void cycle_request(void *arg, long period)
{
    struct hm2 *hm2 = arg;
    if(in_error(hm2)) return;
    hm2->io->period = period;
    request(hm2);
}

/* HAL function <board>.read. */
static void cycle_read(void *arg, long period)
{
    struct hm2 *hm2 = arg;
    if(in_error(hm2)) return;
    hm2->io->period = period;
    if(!hm2->io->read_requested && !request(hm2)) return;
    if(receive(hm2) <= 0) return;
    EACH(hm2, process, period);
}

/* Writes the blocks of every cycle, as they were prepared. */
static void write_regions(struct hm2 *hm2)
{
    struct hm2_llio *io = hm2->io;
    int i;
    for(i = 0; i < hm2->num_writes; i++) {
        const struct hm2_region *r = &hm2->writes[i];
        int bytes = r->words * 4;
        if(!(io->ops->queue_write ? io->ops->queue_write(io, r->addr, r->buffer, bytes)
                                  : io->ops->write(io, r->addr, r->buffer, bytes))) return;
    }
}

static void flush(struct hm2 *hm2)
{
    if(hm2->io->ops->send_queued_writes) hm2->io->ops->send_queued_writes(hm2->io);
}

/* Every register of settings, as after power-up of the board. */
static void force_write(struct hm2 *hm2)
{
    struct hm2_llio *io = hm2->io;
    if(io->ops->set_force_enqueue) io->ops->set_force_enqueue(io, true);
    EACH(hm2, write, true);
    flush(hm2);
    if(io->ops->set_force_enqueue) io->ops->set_force_enqueue(io, false);
}

/* After an error that the user has answered, or a lost packet: the board may have missed anything. */
static void recover(struct hm2 *hm2)
{
    struct hm2_llio *io = hm2->io;
    bool loud = io->needs_reset;
    if(!loud && !io->needs_soft_reset) return;
    if(hm2_watchdog_bitten(hm2)) return;
    io->needs_reset = io->needs_soft_reset = false;
    if(loud) HM2_ERR(hm2, "trying to recover from IO error or Watchdog bite\n");
    if(loud || hm2_state(hm2, &hm2_watchdog)) force_write(hm2);
    if(loud && !in_error(hm2)) HM2_ERR(hm2, "error recover successful!\n");
}

static void start_outputs(struct hm2 *hm2)
{
    int i;
    for(i = 0; i < hm2->pins; i++)
        if(hm2->pin[i].start_output) hm2->pin[i].output = true;
    hm2->written = true;
}

/* HAL function <board>.write. */
static void cycle_write(void *arg, long period)
{
    struct hm2 *hm2 = arg;
    if(in_error(hm2)) return;
    hm2->io->period = period;
    if(!hm2->written) start_outputs(hm2);
    recover(hm2);
    EACH(hm2, prepare, period);
    write_regions(hm2);
    EACH(hm2, write, false);
    flush(hm2);
}

/* HAL functions <board>.read_gpio and <board>.write_gpio. */
static void cycle_read_gpio(void *arg, long period)
{
    (void)period;
    if(!in_error(arg)) hm2_ioport_read_gpio(arg);
}

static void cycle_write_gpio(void *arg, long period)
{
    (void)period;
    if(!in_error(arg)) hm2_ioport_write_gpio(arg);
}

/* HAL function <board>.trigger-encoders. */
static void cycle_trigger(void *arg, long period)
{
    (void)period;
    if(!in_error(arg)) hm2_absenc_trigger(arg);
}

/* ---- Registration --------------------------------------------------------- */

static bool printable(const char *text)
{
    if(!text || !*text) return false;
    for(; *text; text++)
        if(!isprint((unsigned char)*text)) return false;
    return true;
}

/* Faults of a board driver, not of a user. */
static int check_driver(const struct hm2_llio *io)
{
    const char *fault = NULL;
    int i;
    if(!io->ops || !io->ops->read || !io->ops->write) fault = "it has no functions to read and write";
    if(io->num_connectors < 1
       || io->num_connectors > HM2_MAX_CONNECTORS) fault = "it has no number of connectors, 1 to 8";
    for(i = 0; !fault && i < io->num_connectors; i++)
        if(!printable(io->connector_name[i])) fault = "a connector has no name";
    if(!printable(io->name)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2: a board driver gives a board without a name\n");
        return -EINVAL;
    }
    if(!fault) return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "hm2: the driver of board %s is wrong: %s\n", io->name, fault);
    return -EINVAL;
}

static int check_identity(struct hm2 *hm2)
{
    rtapi_u32 cookie;
    char name[9] = "";
    int i;
    if(!hm2_read_now(hm2, ADDR_COOKIE, &cookie, sizeof cookie)) return -EIO;
    if(cookie != COOKIE) {
        HM2_ERR(hm2, "invalid cookie, got 0x%08X, expected 0x%08X\n", cookie, COOKIE);
        HM2_ERR(hm2, "FPGA failed to initialize, or unexpected firmware?\n");
        return -EINVAL;
    }
    if(!hm2_read_now(hm2, ADDR_CONFIG_NAME, name, 8)) return -EIO;
    if(!strcmp(name, CONFIG_NAME)) return 0;
    for(i = 0; i < 8; i++)
        if(!isprint((unsigned char)name[i])) name[i] = '?';
    HM2_ERR(hm2, "invalid config name, got '%s', expected '%s'\n", name, CONFIG_NAME);
    return -EINVAL;
}

static int function_of(int gtag)
{
    int i, k;
    for(i = 0; i < HM2_COUNT(functions); i++)
        for(k = 0; k < 3 && functions[i]->gtag[k]; k++)
            if(functions[i]->gtag[k] == gtag) return i;
    return -1;
}

static int claim_module(struct hm2 *hm2, const struct hm2_md *md)
{
    int f = function_of(md->gtag);
    if(f < 0) {
        if(md->gtag != HM2_GTAG_MUXED_ENCODER_SEL)
            HM2_WARN(hm2, "firmware has a module %s (GTag %d) that this driver does not know: ignored\n",
                     hm2_gtag_name(md->gtag), md->gtag);
        return 0;
    }
    int r = functions[f]->claim(hm2, md, &hm2->state[f]);
    if(r < 0) HM2_ERR(hm2, "failed to set up module %s\n", hm2_gtag_name(md->gtag));
    return r;
}

/* The ports first, wherever they stand: all pins are theirs before a function takes some. */
static int claim_modules(struct hm2 *hm2)
{
    int i;
    for(i = 0; i < hm2->mds; i++)
        if(hm2->md[i].gtag == HM2_GTAG_IOPORT) COMP_TRY(claim_module(hm2, &hm2->md[i]));
    for(i = 0; i < hm2->mds; i++)
        if(hm2->md[i].gtag != HM2_GTAG_IOPORT) COMP_TRY(claim_module(hm2, &hm2->md[i]));
    return hm2->config.enable_raw ? hm2_raw.claim(hm2, NULL, &hm2->state[HM2_COUNT(functions) - 1]) : 0;
}

static int export_functions(struct hm2 *hm2)
{
    static const struct {
        const char *name;
        void (*funct)(void *, long);
        int split, threadsafe;
    } list[] = {
        {"read", cycle_read, 0, 0},
        {"write", cycle_write, 0, 0},
        {"read-request", cycle_request, 1, 0},
        {"read_gpio", cycle_read_gpio, 0, 1},
        {"write_gpio", cycle_write_gpio, 0, 1},
    };
    int i;
    for(i = 0; i < HM2_COUNT(list); i++) {
        if(list[i].split && !hm2->io->split_read) continue;
        if(list[i].threadsafe && !hm2->io->threadsafe) continue;
        COMP_TRY(hal_export_functf(list[i].funct, hm2, 1, 0, hm2->io->comp_id, "%s.%s", hm2->io->name, list[i].name));
    }
    if(!hm2_absenc_used(hm2) || hm2->config.num[HM2_NUM_DPLLS] != 0) return 0;
    return hal_export_functf(cycle_trigger, hm2, 1, 0, hm2->io->comp_id, "%s.trigger-encoders", hm2->io->name);
}

static int export_io_error(struct hm2_llio *io)
{
    hal_bool_t *ref = hal_malloc(sizeof *ref);
    if(!ref) return -ENOMEM;
    COMP_TRY(hal_param_new_bool(io->comp_id, HAL_RW, ref, 0, "%s.io_error", io->name));
    io->io_error = *ref;
    return 0;
}

static int set_up(struct hm2 *hm2, const char *config)
{
    struct hm2_llio *io = hm2->io;
    int i;
    COMP_TRY(hm2_config_parse(hm2, config));
    COMP_TRY(hm2_firmware_load(hm2));
    COMP_TRY(export_io_error(io));
    COMP_TRY(check_identity(hm2));
    COMP_TRY(hm2_idrom_read(hm2, debug_idrom));
    COMP_TRY(hm2_pins_read(hm2, debug_pin_descriptors));
    COMP_TRY(hm2_modules_read(hm2, debug_module_descriptors));
    COMP_TRY(claim_modules(hm2));
    hm2_pins_assign(hm2);
    COMP_TRY(hm2_pins_export(hm2));
    for(i = 0; i < HM2_COUNT(functions); i++)
        if(hm2->state[i] && functions[i]->export) COMP_TRY(functions[i]->export(hm2, hm2->state[i]));
    force_write(hm2);
    if(!request(hm2) || receive(hm2) <= 0) {
        HM2_ERR(hm2, "the first transfer failed: check cable and power of the board\n");
        return -EIO;
    }
    EACH(hm2, start);
    write_regions(hm2);
    flush(hm2);
    if(debug_modules) hm2_print_state(hm2);
    hm2_pins_print(hm2);
    return export_functions(hm2);
}

static void forget(struct hm2 *hm2)
{
    struct hm2 **p;
    int i;
    for(p = &hm2_boards; *p; p = &(*p)->next)
        if(*p == hm2) {
            *p = hm2->next;
            break;
        }
    for(i = 0; i < hm2->num_reads; i++) rtapi_kfree(hm2->reads[i].buffer);
    for(i = 0; i < hm2->num_writes; i++) rtapi_kfree(hm2->writes[i].buffer);
    hm2->io->hm2 = NULL;
    rtapi_kfree(hm2);
}

int hm2_register(struct hm2_llio *io, const char *config)
{
    COMP_TRY(check_driver(io));
    struct hm2 *hm2 = rtapi_kzalloc(sizeof *hm2, RTAPI_GFP_KERNEL), **end = &hm2_boards;
    if(!hm2) return -ENOMEM;
    hm2->io = io;
    io->hm2 = hm2;
    while(*end) end = &(*end)->next;
    *end = hm2;
    int r = set_up(hm2, config);
    if(r < 0) {
        forget(hm2);
        return r;
    }
    HM2_PRINT(hm2, "registered\n");
    return 0;
}
EXPORT_SYMBOL(hm2_register);

void hm2_unregister(struct hm2_llio *io)
{
    if(!io->hm2) return;
    io->io_error = NULL; /* HAL has it back */
    hm2_watchdog_force_bite(io->hm2);
    flush(io->hm2);
    HM2_PRINT(io->hm2, "unregistered\n");
    forget(io->hm2);
}
EXPORT_SYMBOL(hm2_unregister);

int rtapi_app_main(void)
{
    rtapi_print("hm2: loading Mesa HostMot2 driver version " DRIVER_VERSION "\n");
    hm2_use_serial_numbers = use_serial_numbers;
    hm2_sserial_baudrate = sserial_baudrate;
    comp_id = hal_init("hostmot2");
    if(comp_id < 0) return comp_id;
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    rtapi_print("hm2: unloading\n");
    hal_exit(comp_id);
}
