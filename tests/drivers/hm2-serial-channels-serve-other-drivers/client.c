/* A driver that uses the serial channels of a board: which says what. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include <hostmot2-serial.h>

MODULE_LICENSE("GPL");
static char *which = "";
RTAPI_MP_STRING(which, "bspi or uart");
static char *board = "";
RTAPI_MP_STRING(board, "name of the board");

static int comp_id;
static struct {
    hal_sint_t reads, writes;
    hal_uint_t echo, out;
} *pins;
static rtapi_u32 *wbuff, *rbuff;
static char name[64];

static int count_read(void *data)
{
    (void)data;
    hal_set_si32(pins->reads, hal_get_si32(pins->reads) + 1);
    hal_set_ui32(pins->echo, *rbuff);
    return 0;
}

static int count_write(void *data)
{
    (void)data;
    hal_set_si32(pins->writes, hal_get_si32(pins->writes) + 1);
    *wbuff = hal_get_ui32(pins->out);
    return 0;
}

static void use_bspi(void)
{
    snprintf(name, sizeof name, "%s.bspi.0", board);
    rtapi_print("setup %d %d %d\n", hm2_bspi_setup_chan(name, 3, 2, 16, 5, 100, 1, 0, 0, 0, 0),
                hm2_bspi_setup_chan(name, 16, 2, 16, 5, 100, 1, 0, 0, 0, 0), 
                hm2_bspi_setup_chan("x", 0, 0, 8, 1, 0, 0, 0, 0, 0, 0));
    rtapi_print("frame %d %d\n", hm2_tram_add_bspi_frame(name, 3, &wbuff, NULL),
                hm2_tram_add_bspi_frame(name, 3, &wbuff, &rbuff));
    rtapi_print("functions %d %d %d\n", hm2_allocate_bspi_tram(name),
                hm2_bspi_set_read_function(name, count_read, NULL),
                hm2_bspi_set_write_function(name, count_write, NULL));
    rtapi_print("write %d clear %d\n", hm2_bspi_write_chan(name, 5, 0x12345678), hm2_bspi_clear_fifo(name));
}

static void use_uart(void)
{
    unsigned char bytes[16] = "Mesa!", got[16];
    rtapi_u16 sizes[2] = {5, 3}, longest = 16;
    rtapi_u8 frames = 2;
    hm2_pktuart_config_t rx = {.baudrate = 19200, .ifdelay = 300,
                               .flags = HM2_PKTUART_CONFIG_RXEN | HM2_PKTUART_CONFIG_PARITYEN};
    hm2_pktuart_config_t tx = {.baudrate = 19200, .ifdelay = 301, .drivedelay = 99,
                               .flags = HM2_PKTUART_CONFIG_DRIVEAUTO | HM2_PKTUART_CONFIG_STOPBITS2};
    snprintf(name, sizeof name, "%s.uart.1", board);
    rtapi_print("send before setup %d\n", hm2_uart_send(name, bytes, 5));
    rtapi_print("setup %d read %d\n", hm2_uart_setup(name, 250000, 0x1FF, -1), hm2_uart_read(name, got));
    rtapi_print("send %d\n", hm2_uart_send(name, bytes, 5));
    snprintf(name, sizeof name, "%s.pktuart.0", board);
    rtapi_print("config %d version %d clock %d\n", hm2_pktuart_config(name, &rx, &tx, 0), hm2_pktuart_get_version(name),
                hm2_pktuart_get_clock(name));
    rtapi_print("send %d", hm2_pktuart_send(name, bytes, &frames, sizes));
    rtapi_print(" frames %d\n", frames);
    frames = 2;
    rtapi_print("read %d", hm2_pktuart_read(name, got, &frames, &longest, sizes));
    rtapi_print(" frames %d reset %d unknown %d\n", frames, hm2_pktuart_reset(name), hm2_pktuart_get_version("x"));
}

int rtapi_app_main(void)
{
    comp_id = hal_init("kerf_client");
    if(comp_id < 0) return comp_id;
    pins = hal_malloc(sizeof *pins);
    hal_pin_new_si32(comp_id, HAL_OUT, &pins->reads, 0, "client.reads");
    hal_pin_new_si32(comp_id, HAL_OUT, &pins->writes, 0, "client.writes");
    hal_pin_new_ui32(comp_id, HAL_OUT, &pins->echo, 0, "client.echo");
    hal_pin_new_ui32(comp_id, HAL_IN, &pins->out, 0, "client.out");
    if(which[0] == 'b') use_bspi();
    else use_uart();
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
