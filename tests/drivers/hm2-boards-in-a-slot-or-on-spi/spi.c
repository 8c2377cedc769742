/* hm2_spi or hm2_spix (DRIVER) with a bus of its own: a 7C81, whose answers are damaged when register 0xF000 says so.
 * Devices with 9 in their names are not there, 3 is another board, 4 does not answer. */
#include "tests/lib/hm2_registers.h"
#include <rtapi.h>
#include <sys/ioctl.h>
#include <linux/spi/spidev.h>
static int sim_open(const char *path, int flags);
static int sim_ioctl(int fd, unsigned long request, void *arg);
static int sim_close(int fd);
#define rtapi_open_as_root sim_open
#define ioctl sim_ioctl
#define close sim_close
#include <unistd.h>
#include <hal.h>
#define hal_init(name) hal_init("kerf_bus")
#include "src/hal/drivers/mesa-hostmot2/hm2_spi_link.c"
#include DRIVER
#undef ioctl
#undef close

static const char *opened;

static int sim_open(const char *path, int flags)
{
    (void)flags;
    opened = path;
    if(strstr(path, "9")) return -ENOENT;
    fill_registers(strstr(path, "3") ? "MESAXXXX" : "MESA7C81", 3, 19);
    if(strstr(path, "4")) put_register(0x100, 0xFFFFFFFF);
    return 5;
}

static int sim_close(int fd)
{
    return fd == 5 ? 0 : -1;
}

static rtapi_u32 damaged(rtapi_u32 word)
{
    rtapi_u32 left;
    memcpy(&left, registers + 0xF000, sizeof left);
    if(!left) return word;
    put_register(0xF000, left - 1);
    return word ^ 0x100;
}

static int sim_ioctl(int fd, unsigned long request, void *arg)
{
    struct spi_ioc_transfer *t = arg;
    (void)fd;
    if(request != SPI_IOC_MESSAGE(1)) {
        if(request == SPI_IOC_WR_MAX_SPEED_HZ) rtapi_print("%s: %u Hz\n", opened, *(rtapi_u32 *)arg);
        return 0;
    }
    rtapi_u32 *words = (rtapi_u32 *)(unsigned long)t->rx_buf, n = t->len / 4, at = 0;
    while(at < n) {
        rtapi_u32 command = __builtin_bswap32(words[at]), addr = command >> 16, count = command >> 4 & 0x7F, i;
        bool last = at + count + 1 == n;
        for(i = 1; i <= count && at + i < n; i++, addr += 4) {
            rtapi_u32 word;
            memcpy(&word, registers + (addr & 0xFFFC), sizeof word);
            if((command & 0xF000) == 0xA000)
                words[at + i] = __builtin_bswap32(last && at && addr == 0x100 ? damaged(word) : word);
            else put_register(addr & 0xFFFC, __builtin_bswap32(words[at + i]));
        }
        at += count + 1;
    }
    return 0;
}
