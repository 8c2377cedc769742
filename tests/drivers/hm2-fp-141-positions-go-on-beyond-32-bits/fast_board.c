/* A board with one encoder that counts 32000, and one step generator that makes 30000 steps, between two reads. */
#include <string.h>
#include <rtapi_app.h>
#include BOARD_HEADER

MODULE_LICENSE("GPL");
static int direction = 1;
RTAPI_MP_INT(direction, "1 or -1");

#define COUNTS 32000
#define SUBSTEPS (30000 << 16)
static rtapi_u8 memory[0x10000];
static struct hm2_llio board;
static int comp_id;
static rtapi_u32 count, accumulator;

static void put(rtapi_u32 addr, rtapi_u32 value)
{
    memcpy(memory + addr, &value, sizeof value);
}

static int read_registers(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    (void)io;
    if(addr == 0x3000) put(addr, (count += (rtapi_u32)(direction * COUNTS)) & 0xFFFF);
    if(addr == 0x2100) put(addr, accumulator += (rtapi_u32)(direction * SUBSTEPS));
    memcpy(buffer, memory + addr, (size_t)bytes);
    return 1;
}

static int write_registers(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    (void)io;
    if(addr != 0x3000 && addr != 0x2100) memcpy(memory + addr, buffer, (size_t)bytes);
    return 1;
}

static const struct hm2_llio_ops ops = {.read = read_registers, .write = write_registers};

int rtapi_app_main(void)
{
    static const rtapi_u32 idrom[] = {3, 0x40, 0x200, 0, 0, 0, 0, 1, 24, 24, 100000000, 100000000, 4, 0x40, 0x100, 4};
    static const rtapi_u32 modules[] = {0x01010003, 0x00051000, 0x1F, 0x01010304, 0x00053000, 3, 0x01010205, 0x000A2000,
                                        0x1FF, 0};
    int i;
    put(0x100, 0x55AACAFE);
    memcpy(memory + 0x104, "HOSTMOT2", 8);
    put(0x10C, 0x400);
    memcpy(memory + 0x400, idrom, sizeof idrom);
    memcpy(memory + 0x440, modules, sizeof modules);
    for(i = 0; i < 24; i++) put(0x600 + 4 * (rtapi_u32)i, 0x03000000);
    comp_id = hal_init("kerf_fast_board");
    if(comp_id < 0) return comp_id;
    board.ops = &ops;
    board.comp_id = comp_id;
    board.num_connectors = 1;
    board.pins_per_connector = 24;
    board.connector_name[0] = "P1";
    strcpy(board.name, "board");
    if(hm2_register(&board, NULL) < 0) return -EIO;
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hm2_unregister(&board);
    hal_exit(comp_id);
}
