/* Boards whose descriptors, pins and registers are random, many of them: registering one either works or is refused,
 * and the functions of a cycle run with whatever the registers and pins say. Odd seeds keep the layouts that the driver
 * knows, so that their modules come to work. */
#include <string.h>
#include <rtapi_app.h>
#include BOARD_HEADER

MODULE_LICENSE("GPL");
static int seeds = 1;
RTAPI_MP_INT(seeds, "number of boards");
static int first = 1;
RTAPI_MP_INT(first, "seed of the first");

static rtapi_u8 memory[0x10000];
static struct hm2_llio *board;
static int comp_id;
static rtapi_u64 state;

static rtapi_u32 draw(rtapi_u32 below)
{
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (rtapi_u32)(state >> 33) % below;
}

static void put(rtapi_u32 addr, rtapi_u32 value)
{
    memcpy(memory + (addr & 0xFFFC), &value, sizeof value);
}

static int read_registers(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    (void)io;
    int i;
    if(addr >= 0x1000 && !draw(4)) put(addr, draw(2) ? 0 : (draw(65536) << 16 | draw(65536)));
    for(i = 0; i < bytes; i++) ((rtapi_u8 *)buffer)[i] = memory[(addr + (rtapi_u32)i) & 0xFFFF];
    return draw(2000) != 0;
}

static int write_registers(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    (void)io;
    if((addr & 0xFFFF) >= 0x1000 && (addr & 0xFFFF) + (rtapi_u32)bytes <= sizeof memory)
        memcpy(memory + (addr & 0xFFFF), buffer, (size_t)bytes);
    return draw(2000) != 0;
}

static const struct hm2_llio_ops ops = {.read = read_registers, .write = write_registers};

/* Layouts that are right: tag, version, registers, instance stride selector, multiple. */
static const rtapi_u32 known[][5] = {
    {2, 0, 3, 0, 0},       {4, 3, 5, 0, 3},       {5, 2, 10, 0, 0x1FF}, {5, 0xC2, 10, 0, 0x1FF}, {6, 1, 5, 0, 3},
    {8, 0, 4, 0, 3},       {12, 4, 5, 0, 3},      {14, 0, 3, 1, 7},     {19, 0, 4, 0, 3},        {24, 0, 4, 0, 7},
    {25, 0, 3, 0, 0x1F},   {26, 0, 7, 0, 0},      {27, 3, 4, 0, 0xF},   {28, 2, 4, 0, 0xF},      {30, 0, 5, 0, 0x1F},
    {35, 0, 5, 0, 0x1F},   {43, 0, 11, 0, 0x1FF}, {44, 0, 2, 0, 1},     {45, 0, 1, 0, 1},        {128, 0, 1, 0, 0},
    {192, 0, 5, 0, 0x1F},  {195, 0, 2, 0, 3},     {199, 0, 6, 0, 0x3F}, {200, 0, 4, 0, 0xF},     {193, 0, 6, 1, 0x3C},
};

static void make(int seed)
{
    static const rtapi_u32 idrom[] = {3, 0x40, 0x400, 0, 0, 0, 0, 3, 72, 24, 50000000, 200000000, 4, 0x40, 0x100, 4};
    bool sane = seed % 2;
    rtapi_u32 i, n = 1 + draw(10);
    state = (rtapi_u64)seed * 88172645463325252ULL;
    memset(memory, 0, sizeof memory);
    put(0x100, 0x55AACAFE);
    memcpy(memory + 0x104, "HOSTMOT2", 8);
    put(0x10C, 0x400);
    memcpy(memory + 0x400, idrom, sizeof idrom);
    put(0x440, 3 | 1 << 16 | 3u << 24);
    put(0x444, 0x1000 | 5 << 16);
    put(0x448, 0x1F);
    for(i = 1; i <= n; i++) {
        const rtapi_u32 *k = known[draw(sizeof known / sizeof known[0])];
        rtapi_u32 at = 0x440 + 12 * i, instances = 1 + draw(sane ? 4 : 256);
        bool wrong = !sane && !draw(3);
        put(at, k[0] | (wrong ? draw(256) : k[1]) << 8 | (wrong ? draw(4) : 1 + draw(2)) << 16 | instances << 24);
        put(at + 4, (0x1000 + i * 0x1000) | k[2] << 16 | (wrong ? draw(16) : k[3]) << 28);
        put(at + 8, k[4]);
    }
    for(i = 0; i < 72; i++) {
        const rtapi_u32 *k = known[draw(sizeof known / sizeof known[0])];
        rtapi_u32 unit = draw(8) ? draw(4) : draw(256);
        put(0x800 + 4 * i, 3u << 24 | unit << 16 | k[0] << 8 | draw(2) << 7 | (1 + draw(12)));
    }
}

static int try_board(int seed)
{
    struct hm2_llio *b = &board[seed - first];
    int i;
    make(seed);
    b->ops = &ops;
    b->comp_id = comp_id;
    b->num_connectors = 3;
    b->pins_per_connector = 24;
    b->num_leds = 4;
    b->threadsafe = true;
    for(i = 0; i < 3; i++) b->connector_name[i] = "P";
    snprintf(b->name, sizeof b->name, "b%d", seed);
    return hm2_register(b, seed % 3 ? "ssi_chan_0=a%20e biss_chan_1=b%30sc%40u sserial_port_0=xxxxxxxx "
                                      "fanuc_chan_0=AA64"
                                    : "sserial_port_0=xxxxxxxx enable_raw num_encoders=1");
}

int rtapi_app_main(void)
{
    int i, good = 0;
    comp_id = hal_init("kerf_wild_board");
    if(comp_id < 0) return comp_id;
    board = hal_malloc((long)sizeof *board * seeds);
    for(i = 0; i < seeds; i++)
        if(try_board(first + i) == 0) good++;
    rtapi_print("%d boards of %d work\n", good, seeds);
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    int i;
    for(i = 0; i < seeds; i++) hm2_unregister(&board[i]);
    hal_exit(comp_id);
}
