/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pins.c - whose each pin is: pin descriptors, owners, names. [init]
 */
#include <stdarg.h>
#include <string.h>
#include "hm2.h"

/* Names of the modules. In HAL: NULL where a function's pins have no aliases. */
static const struct {
    rtapi_u8 gtag;
    const char *name, *hal_name;
} functions[] = {
    {HM2_GTAG_WATCHDOG, "Watchdog", NULL},
    {HM2_GTAG_IOPORT, "IOPort", NULL},
    {HM2_GTAG_ENCODER, "Encoder", "encoder"},
    {HM2_GTAG_STEPGEN, "StepGen", "stepgen"},
    {HM2_GTAG_PWMGEN, "PWMGen", "pwmgen"},
    {7, "SPI", NULL},
    {HM2_GTAG_SSI, "SSI Encoder", "ssi"},
    {HM2_GTAG_UART_TX, "UART Transmit Channel", "uart"},
    {HM2_GTAG_UART_RX, "UART Receive Channel", "uart"},
    {11, "TranslationRAM", NULL},
    {HM2_GTAG_MUXED_ENCODER, "Muxed Encoder", "encoder"},
    {HM2_GTAG_MUXED_ENCODER_SEL, "Muxed Encoder Select", "encoder"},
    {HM2_GTAG_BSPI, "Buffered SPI Interface", "bspi"},
    {15, "DBSPI", NULL},
    {16, "DPLL", NULL},
    {17, "MuxEncM", NULL},
    {18, "MuxEncM Select", NULL},
    {HM2_GTAG_TPPWM, "ThreePhasePWM", "3pwmgen"},
    {20, "WaveGen", NULL},
    {21, "DAQFIFO", NULL},
    {22, "BinOsc", NULL},
    {23, "DDMA", NULL},
    {HM2_GTAG_BISS, "BiSS Encoder", "biss"},
    {HM2_GTAG_FABS, "Fanuc Abs Encoder", "fanuc"},
    {HM2_GTAG_DPLL, "Hostmot2 DPLL", NULL},
    {HM2_GTAG_PKTUART_TX, "PktUART Transmit Channel", "uart"},
    {HM2_GTAG_PKTUART_RX, "PktUART Receive Channel", "uart"},
    {HM2_GTAG_INMUX, "InMux Input Mux", "inmux"},
    {HM2_GTAG_INM, "InM Input Module", "inm"},
    {42, "Data Painter", NULL},
    {HM2_GTAG_XY2MOD, "xy2mod Galvo interface", "xy2mod"},
    {HM2_GTAG_RCPWMGEN, "RCPWMGen", NULL},
    {HM2_GTAG_OUTM, "OutM Output Module", "outm"},
    {64, "LIOPort", NULL},
    {HM2_GTAG_LED, "LED", NULL},
    {HM2_GTAG_RESOLVER, "Resolver", "resolver"},
    {HM2_GTAG_SMARTSERIAL, "Smart Serial Interface", "sserial"},
    {194, "Twiddler", NULL},
    {HM2_GTAG_SSR, "SSR", "ssr"},
    {HM2_GTAG_SMARTSERIALB, "Smart Serial Interface", "sserialb"},
    {HM2_GTAG_ONESHOT, "OneShot", "oneshot"},
    {HM2_GTAG_PERIODM, "PeriodM", "periodm"},
};

const char *hm2_gtag_name(int gtag)
{
    int i;
    for(i = 0; i < HM2_COUNT(functions); i++)
        if(functions[i].gtag == gtag) return functions[i].name;
    return "(unknown-gtag)";
}

const char *hm2_gtag_hal_name(int gtag)
{
    int i;
    for(i = 0; i < HM2_COUNT(functions); i++)
        if(functions[i].gtag == gtag) return functions[i].hal_name;
    return NULL;
}

/* Pins of the modules: code `first` to `last` of module gtag. With one conversion (%d), the name has
 * the number code - first + from. */
static const struct {
    rtapi_u8 gtag, first, last;
    int from;
    const char *name, *hal_name;
} pin_names[] = {
    {HM2_GTAG_ENCODER, 1, 1, 0, "A", "phase-A"},
    {HM2_GTAG_ENCODER, 2, 2, 0, "B", "phase-B"},
    {HM2_GTAG_ENCODER, 3, 3, 0, "Index", "phase-Z"},
    {HM2_GTAG_ENCODER, 4, 4, 0, "IndexMask", "phase-Z-mask"},
    {HM2_GTAG_ENCODER, 5, 5, 0, "Probe", "probe-latch"},
    {HM2_GTAG_ENCODER, 6, 6, 0, "Shared Index", "shared-Z"},
    {HM2_GTAG_MUXED_ENCODER, 1, 1, 0, "Muxed A", "phase-A"},
    {HM2_GTAG_MUXED_ENCODER, 2, 2, 0, "Muxed B", "phase-B"},
    {HM2_GTAG_MUXED_ENCODER, 3, 3, 0, "Muxed Index", "phase-Z"},
    {HM2_GTAG_MUXED_ENCODER, 4, 4, 0, "Muxed IndexMask", "phase-Z-mask"},
    {HM2_GTAG_MUXED_ENCODER, 5, 5, 0, "Muxed Probe", "probe"},
    {HM2_GTAG_MUXED_ENCODER, 6, 6, 0, "Muxed Shared Index", "shared-Z"},
    {HM2_GTAG_MUXED_ENCODER_SEL, 1, 2, 0, "Mux Select %d", "sel%d"},
    {HM2_GTAG_SSI, 1, 1, 0, "Clock", "clock"},
    {HM2_GTAG_SSI, 2, 2, 0, "ClockEnable", "clock-enable"},
    {HM2_GTAG_SSI, 3, 3, 0, "Data", "data"},
    {HM2_GTAG_BISS, 1, 1, 0, "clock", "clock"},
    {HM2_GTAG_BISS, 2, 2, 0, "clock-enable", "clock-enable"},
    {HM2_GTAG_BISS, 3, 3, 0, "data", "data"},
    {HM2_GTAG_FABS, 1, 1, 0, "Rq", NULL},
    {HM2_GTAG_FABS, 2, 2, 0, "RqEn", NULL},
    {HM2_GTAG_FABS, 3, 3, 0, "Data", NULL},
    {HM2_GTAG_FABS, 4, 4, 0, "TestClk", NULL},
    {HM2_GTAG_RESOLVER, 1, 1, 0, "NC", "nc"},
    {HM2_GTAG_RESOLVER, 2, 2, 0, "REFPDM+", "refpdm-plus"},
    {HM2_GTAG_RESOLVER, 3, 3, 0, "REFPDM-", "refpdm-minus"},
    {HM2_GTAG_RESOLVER, 4, 6, 0, "AMUX%d", "amux%d"},
    {HM2_GTAG_RESOLVER, 7, 7, 0, "SPICS", "spics"},
    {HM2_GTAG_RESOLVER, 8, 8, 0, "SPICLK", "spiclk"},
    {HM2_GTAG_RESOLVER, 9, 10, 0, "SPIDO%d", "spido%d"},
    {HM2_GTAG_PWMGEN, 1, 1, 0, "Out0 (PWM or Up)", "out0"},
    {HM2_GTAG_PWMGEN, 2, 2, 0, "Out1 (Dir or Down)", "out1"},
    {HM2_GTAG_PWMGEN, 3, 3, 0, "Not-Enable", "enable"},
    {HM2_GTAG_RCPWMGEN, 1, 1, 0, "PWM", "pwm"},
    {HM2_GTAG_TPPWM, 1, 1, 0, "PWM A", "phase-A"},
    {HM2_GTAG_TPPWM, 2, 2, 0, "PWM B", "phase-B"},
    {HM2_GTAG_TPPWM, 3, 3, 0, "PWM C", "phase-C"},
    {HM2_GTAG_TPPWM, 4, 4, 0, "PWM /A", "phase-A-inverted"},
    {HM2_GTAG_TPPWM, 5, 5, 0, "PWM /B", "phase-B-inverted"},
    {HM2_GTAG_TPPWM, 6, 6, 0, "PWM /C", "phase-C-inverted"},
    {HM2_GTAG_TPPWM, 7, 7, 0, "Enable", "enable"},
    {HM2_GTAG_TPPWM, 8, 8, 0, "Fault", "fault"},
    {HM2_GTAG_STEPGEN, 1, 1, 0, "Step", "step"},
    {HM2_GTAG_STEPGEN, 2, 2, 0, "Direction", "direction"},
    {HM2_GTAG_STEPGEN, 3, 8, 2, "Table%dPin", "table%d"},
    {HM2_GTAG_STEPGEN, 9, 9, 0, "Index", "index"},
    {HM2_GTAG_STEPGEN, 10, 10, 0, "Probe", "probe"},
    {HM2_GTAG_XY2MOD, 1, 1, 0, "datax", "datax"},
    {HM2_GTAG_XY2MOD, 2, 2, 0, "datay", "datay"},
    {HM2_GTAG_XY2MOD, 3, 3, 0, "clk", "clk"},
    {HM2_GTAG_XY2MOD, 4, 4, 0, "sync", "sync"},
    {HM2_GTAG_XY2MOD, 5, 5, 0, "status", "status"},
    {HM2_GTAG_ONESHOT, 1, 2, 1, "trigger%d", "trigger%d"},
    {HM2_GTAG_ONESHOT, 3, 4, 1, "out%d", "out%d"},
    {HM2_GTAG_PERIODM, 1, 1, 0, "input", "input"},
    {HM2_GTAG_BSPI, 1, 1, 0, "/Frame", "nframe"},
    {HM2_GTAG_BSPI, 2, 2, 0, "Serial Out", "out"},
    {HM2_GTAG_BSPI, 3, 3, 0, "Clock", "clk"},
    {HM2_GTAG_BSPI, 4, 4, 0, "Serial In", "in"},
    {HM2_GTAG_BSPI, 5, 12, 0, "CS%d", "cs%d"},
    {HM2_GTAG_UART_RX, 1, 1, 0, "RX Data", "rx"},
    {HM2_GTAG_UART_TX, 1, 1, 0, "TX Data", "tx"},
    {HM2_GTAG_UART_TX, 2, 2, 0, "Drv Enable", "tx-drv-en"},
    {HM2_GTAG_PKTUART_RX, 1, 1, 0, "RX Data", "rx"},
    {HM2_GTAG_PKTUART_TX, 1, 1, 0, "TX Data", "tx"},
    {HM2_GTAG_PKTUART_TX, 2, 2, 0, "Drv Enable low", "tx-drv-en"},
    {HM2_GTAG_PKTUART_TX, 3, 3, 0, "Drv Enable high", NULL},
    {HM2_GTAG_DPLL, 1, 1, 0, "Sync In Pin", NULL},
    {HM2_GTAG_DPLL, 2, 2, 0, "Ref Out Pin", NULL},
    {HM2_GTAG_DPLL, 3, 6, 1, "Timer %d Pin", NULL},
    {HM2_GTAG_SSR, 1, 31, 0, "Out-%02d", "out-%02d"},
    {HM2_GTAG_SSR, 32, 32, 0, "AC Ref (internal)", NULL},
    {HM2_GTAG_OUTM, 1, 31, 0, "Out-%02d", "out-%02d"},
};

/* The same for modules that use a code twice: for an output and for an input. */
static const char *const inm_name[] = {"in0,enca0", "in1,encb0", "in2,enca1", "in3,encb1",
                                       "in4,enca2", "in5,encb2", "in6,enca3", "in7,encb3"};

static void two_way_name(const struct hm2_pin *pin, bool hal, char *name, size_t size)
{
    int code = pin->sec_pin & 0x7F;
    bool out = pin->sec_pin & HM2_PIN_OUTPUT;
    if(hal && pin->sec_tag != HM2_GTAG_SMARTSERIAL && pin->sec_tag != HM2_GTAG_SMARTSERIALB) return;
    if(pin->sec_tag == HM2_GTAG_INMUX) {
        if(out && code >= 1 && code <= 5) snprintf(name, size, "addr%d", code - 1);
        else if(!out && code == 1) snprintf(name, size, "muxdata");
    } else if(pin->sec_tag == HM2_GTAG_INM) {
        if(code >= 1 && code <= 8) snprintf(name, size, "%s", inm_name[code - 1]);
        else if(code >= 1) snprintf(name, size, "in%d", code - 1);
    } else if(pin->sec_tag == HM2_GTAG_SMARTSERIAL || pin->sec_tag == HM2_GTAG_SMARTSERIALB) {
        int channel = (code & 0xF) - 1;
        if(channel < 0 || channel > 7) return;
        if(!out && code < 0x10) snprintf(name, size, "rx%d", channel);
        else if(out && code < 0x10) snprintf(name, size, "tx%d", channel);
        else if(out && code < 0x20) snprintf(name, size, "txen%d", channel);
        else if(out && code < 0x30 && !hal) snprintf(name, size, "ntxen%d", channel);
    }
}

/* Name of a function's pin for people, or (hal) in HAL; empty: it has none there. */
static void pin_name(const struct hm2_pin *pin, bool hal, char *name, size_t size)
{
    int i, code = pin->sec_pin & 0x7F;
    name[0] = 0;
    for(i = 0; i < HM2_COUNT(pin_names); i++) {
        const char *format = hal ? pin_names[i].hal_name : pin_names[i].name;
        if(pin_names[i].gtag != pin->sec_tag || code < pin_names[i].first || code > pin_names[i].last) continue;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
        if(format) snprintf(name, size, format, code - pin_names[i].first + pin_names[i].from);
#pragma GCC diagnostic pop
        return;
    }
    two_way_name(pin, hal, name, size);
    if(!name[0] && !hal) snprintf(name, size, "unknown-pin-%d", code);
}

/* ---- Descriptors ---------------------------------------------------------- */

static int decode_pin(struct hm2 *hm2, int number, rtapi_u32 word, bool debug)
{
    struct hm2_pin *pin = &hm2->pin[number];
    unsigned primary = word >> 24;
    pin->sec_pin = word & 0xFF;
    pin->sec_tag = word >> 8 & 0xFF;
    pin->sec_unit = word >> 16 & 0xFF;
    pin->owner = HM2_GTAG_IOPORT;
    if(debug)
        HM2_PRINT(hm2, "    pin %d: primary %s (0x%02X), secondary %s (0x%02X), unit 0x%02X, pin 0x%02X (%s)\n", number,
                  hm2_gtag_name(primary), primary, pin->sec_tag ? hm2_gtag_name(pin->sec_tag) : "none", pin->sec_tag,
                  pin->sec_unit, pin->sec_pin, pin->sec_pin & HM2_PIN_OUTPUT ? "Output" : "Input");
    if(primary == HM2_GTAG_IOPORT) return 0;
    if(!primary)
        HM2_ERR(hm2, "pin %d primary tag is 0 (end-of-list sentinel), expected %d pins!\n", number, hm2->pins);
    else
        HM2_ERR(hm2, "pin %d primary tag is %d (%s), expected %d (IOPort): the firmware is damaged\n", number, primary,
                hm2_gtag_name(primary), HM2_GTAG_IOPORT);
    return -EINVAL;
}

int hm2_pins_read(struct hm2 *hm2, bool debug)
{
    rtapi_u32 addr = hm2->idrom_addr + hm2->idrom.pins;
    int i;
    hm2->pins = (int)hm2->idrom.width;
    hm2->pin = hal_malloc((long)sizeof *hm2->pin * hm2->pins);
    if(!hm2->pin) return -ENOMEM;
    for(i = 0; i < hm2->pins; i++, addr += 4) {
        rtapi_u32 word;
        if(!hm2_read_now(hm2, addr, &word, sizeof word)) return -EIO;
        COMP_TRY(decode_pin(hm2, i, word, debug));
    }
    return 0;
}

/* Outputs of these drive at once; those of the others begin with the first write. */
static bool starts_at_once(int gtag)
{
    switch(gtag) {
    case HM2_GTAG_BISS: case HM2_GTAG_BSPI: case HM2_GTAG_FABS: case HM2_GTAG_INM: case HM2_GTAG_INMUX:
    case HM2_GTAG_PKTUART_TX: case HM2_GTAG_PKTUART_RX: case HM2_GTAG_RESOLVER: case HM2_GTAG_SSI:
    case HM2_GTAG_UART_TX: case HM2_GTAG_UART_RX: case HM2_GTAG_SMARTSERIAL: case HM2_GTAG_SMARTSERIALB:
    case HM2_GTAG_MUXED_ENCODER_SEL:
        return true;
    default:
        return false;
    }
}

static bool belongs_to_function(const struct hm2 *hm2, const struct hm2_pin *pin)
{
    int limit = hm2->instances[pin->sec_tag];
    if(!pin->sec_tag || !limit) return false;
    if(pin->sec_tag == HM2_GTAG_STEPGEN && pin->sec_pin & HM2_PIN_OUTPUT &&
       (pin->sec_pin & 0x7F) > hm2->config.stepgen_width) return false;
    return pin->sec_unit & HM2_UNIT_GLOBAL || pin->sec_unit < limit;
}

void hm2_pins_assign(struct hm2 *hm2)
{
    int i;
    for(i = 0; i < hm2->pins; i++) {
        struct hm2_pin *pin = &hm2->pin[i];
        pin->owner = HM2_GTAG_IOPORT;
        pin->output = pin->start_output = false;
        if(!belongs_to_function(hm2, pin)) continue;
        pin->owner = pin->sec_tag;
        if(!(pin->sec_pin & HM2_PIN_OUTPUT)) continue;
        if(starts_at_once(pin->sec_tag)) pin->output = true;
        else pin->start_output = true;
    }
}

void hm2_pins_enable_now(struct hm2 *hm2, int gtag)
{
    int i;
    for(i = 0; i < hm2->pins; i++) {
        struct hm2_pin *pin = &hm2->pin[i];
        if(pin->sec_tag != gtag) continue;
        pin->owner = (rtapi_u8)gtag;
        pin->output = pin->sec_pin & HM2_PIN_OUTPUT;
    }
    void *ports = hm2_state(hm2, &hm2_ioport);
    if(ports) hm2_ioport.write(hm2, ports, true);
}

/* ---- Connectors ----------------------------------------------------------- */

/* Number of pin i at its connector; 0: unknown kind of connector. */
static int connector_pin(int width, int i)
{
    static const int db25[] = {1, 14, 2, 15, 3, 16, 4, 17, 5, 6, 7, 8, 9, 10, 11, 12, 13};
    switch(width) {
    case 24: return i * 2 + 1;
    case 17: return db25[i];
    case 19: case 21: case 27: case 29: case 30: case 32: return i + 1;
    default: return 0;
    }
}

static void print_pin(struct hm2 *hm2, int number, const char *place)
{
    const struct hm2_pin *pin = &hm2->pin[number];
    char name[HM2_NAME_LEN + 1];
    if(pin->owner == HM2_GTAG_IOPORT) {
        HM2_PRINT(hm2, "    IO Pin %03d (%s): IOPort\n", number, place);
        return;
    }
    pin_name(pin, false, name, sizeof name);
    const char *direction = pin->sec_pin & HM2_PIN_OUTPUT ? "Output" : "Input";
    if(pin->sec_unit & HM2_UNIT_GLOBAL)
        HM2_PRINT(hm2, "    IO Pin %03d (%s): %s (all), pin %s (%s)\n", number, place, hm2_gtag_name(pin->owner), name,
                  direction);
    else
        HM2_PRINT(hm2, "    IO Pin %03d (%s): %s #%d, pin %s (%s)\n", number, place, hm2_gtag_name(pin->owner),
                  pin->sec_unit, name, direction);
}

void hm2_pins_print(struct hm2 *hm2)
{
    int width = (int)hm2->idrom.port_width, i;
    HM2_PRINT(hm2, "%d I/O Pins used:\n", hm2->pins);
    if(!hm2->io->io_name && !connector_pin(width, 0))
        HM2_ERR(hm2, "connectors of %d pins are not known: pins are shown without their numbers\n", width);
    for(i = 0; i < hm2->pins; i++) {
        char place[64];
        if(hm2->io->io_name) {
            if(i >= hm2->io->io_names || !hm2->io->io_name[i]) continue;
            snprintf(place, sizeof place, "%s", hm2->io->io_name[i]);
        } else
            snprintf(place, sizeof place, "%s-%02d", hm2->io->connector_name[i / width],
                     connector_pin(width, i % width));
        print_pin(hm2, i, place);
    }
}

/* ---- HAL ------------------------------------------------------------------ */

int hm2_export(struct hm2 *hm2, const struct hm2_item *items, int n, void *base, const char *prefix, ...)
{
    char text[HAL_NAME_LEN + 1];
    const char *board = hm2->io->name;
    int id = hm2->io->comp_id, i;
    va_list ap;
    va_start(ap, prefix);
    rtapi_vsnprintf(text, sizeof text, prefix, ap);
    va_end(ap);
    for(i = 0; i < n; i++) {
        const struct hm2_item *it = &items[i];
        hal_refs_u *ref = (void *)((char *)base + it->offset);
        const char *name = it->name;
        bool param = hal_pdir_is_param(it->dir);
        switch((int)it->type) {
        case HAL_BIT:
            COMP_TRY(param ? hal_param_new_bool(id, it->dir, &ref->b, it->value != 0, "%s.%s%s", board, text, name)
                           : hal_pin_new_bool(id, it->dir, &ref->b, it->value != 0, "%s.%s%s", board, text, name));
            break;
        case HAL_S32:
            COMP_TRY(param ? hal_param_new_si32(id, it->dir, &ref->s, (rtapi_s32)it->value, "%s.%s%s", board, text,
                                                name)
                           : hal_pin_new_si32(id, it->dir, &ref->s, (rtapi_s32)it->value, "%s.%s%s", board, text,
                                              name));
            break;
        case HAL_U32:
            COMP_TRY(param ? hal_param_new_ui32(id, it->dir, &ref->u, (rtapi_u32)it->value, "%s.%s%s", board, text,
                                                name)
                           : hal_pin_new_ui32(id, it->dir, &ref->u, (rtapi_u32)it->value, "%s.%s%s", board, text,
                                              name));
            break;
        default:
            COMP_TRY(param ? hal_param_new_real(id, it->dir, &ref->r, it->value, "%s.%s%s", board, text, name)
                           : hal_pin_new_real(id, it->dir, &ref->r, it->value, "%s.%s%s", board, text, name));
        }
    }
    return 0;
}

/* Which of the pins with the same function, unit and name this one is; *many: there are several. */
static int rank_among_equals(const struct hm2 *hm2, int number, bool *many)
{
    const struct hm2_pin *pin = &hm2->pin[number];
    int i, rank = 0;
    *many = false;
    for(i = 0; i < hm2->pins; i++) {
        const struct hm2_pin *other = &hm2->pin[i];
        if(i == number || other->owner != pin->owner || other->sec_unit != pin->sec_unit ||
           other->sec_pin != pin->sec_pin) continue;
        *many = true;
        if(i < number) rank++;
    }
    return rank;
}

/* Parameters of a function's output get the function's name too. */
static int alias_output(struct hm2 *hm2, int number)
{
    static const char *const parameter[] = {"invert_output", "is_opendrain"};
    const struct hm2_pin *pin = &hm2->pin[number];
    const char *function = hm2_gtag_hal_name(pin->owner);
    char name[HM2_NAME_LEN + 1], unit[16];
    bool many;
    int i, rank = rank_among_equals(hm2, number, &many);
    pin_name(pin, true, name, sizeof name);
    if(!function || !name[0]) return 0;
    snprintf(unit, sizeof unit, many ? "%02d.%d" : "%02d", pin->sec_unit, rank);
    for(i = 0; i < HM2_COUNT(parameter); i++) {
        char from[HAL_NAME_LEN * 3], to[HAL_NAME_LEN * 3];
        snprintf(from, sizeof from, "%s.gpio.%03d.%s", hm2->io->name, number, parameter[i]);
        snprintf(to, sizeof to, "%s.%s.%s.%s.%s", hm2->io->name, function, unit, name, parameter[i]);
        COMP_TRY(hal_param_alias(from, to));
    }
    return 0;
}

int hm2_pins_export(struct hm2 *hm2)
{
    static const struct hm2_item every[] = {
        HM2_ITEM(BIT, OUT, hm2_pin, in, "in", 0),
        HM2_ITEM(BIT, OUT, hm2_pin, in_not, "in_not", 0),
    };
    static const struct hm2_item gpio[] = {
        HM2_ITEM(BIT, IN, hm2_pin, out, "out", 0),
        HM2_ITEM(BIT, RW, hm2_pin, is_output, "is_output", 0),
    };
    static const struct hm2_item output[] = {
        HM2_ITEM(BIT, RW, hm2_pin, invert, "invert_output", 0),
        HM2_ITEM(BIT, RW, hm2_pin, opendrain, "is_opendrain", 0),
    };
    int i;
    for(i = 0; i < hm2->pins; i++) {
        struct hm2_pin *pin = &hm2->pin[i];
        bool full = pin->owner == HM2_GTAG_IOPORT;
        COMP_TRY(hm2_export(hm2, every, HM2_COUNT(every), pin, "gpio.%03d.", i));
        if(full) COMP_TRY(hm2_export(hm2, gpio, HM2_COUNT(gpio), pin, "gpio.%03d.", i));
        if(!full && !(pin->sec_pin & HM2_PIN_OUTPUT)) continue;
        COMP_TRY(hm2_export(hm2, output, HM2_COUNT(output), pin, "gpio.%03d.", i));
        if(!full) COMP_TRY(alias_output(hm2, i));
    }
    return 0;
}
