/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * bitfile.c - firmware files (.bit) of boards that have to be programmed. [init]
 */
#include <string.h>
#include <rtapi_firmware.h>
#include "hm2.h"

#define MAX_FIRMWARE_NAME 30

static const rtapi_u8 magic[] = {0x00, 0x09, 0x0F, 0xF0, 0x0F, 0xF0, 0x0F, 0xF0, 0x0F, 0xF0, 0x00, 0x00, 0x01};

/* Finds the part's name (chunk b) and the data (chunk e). Lengths are big-endian; text chunks end in
 * a NUL that is counted. */
static int parse(const rtapi_u8 *p, size_t size, struct hm2_bitfile *bitfile, const char **why)
{
    size_t at = sizeof magic;
    *why = "it does not begin as a .bit file";
    if(size < sizeof magic || memcmp(p, magic, sizeof magic)) return -EINVAL;
    *why = "it ends too early";
    while(size - at >= 3) {
        rtapi_u8 tag = p[at++];
        if(tag == 'e') {
            if(size - at < 4) return -EINVAL;
            size_t n = (size_t)p[at] << 24 | (size_t)p[at + 1] << 16 | (size_t)p[at + 2] << 8 | p[at + 3];
            at += 4;
            if(size - at < n) return -EINVAL;
            bitfile->data = p + at;
            bitfile->size = (unsigned)n;
            *why = "it does not name the FPGA it is for";
            return bitfile->part ? 0 : -EINVAL;
        }
        if(tag < 'a' || tag > 'd') {
            *why = "it has an unknown part";
            return -EINVAL;
        }
        size_t n = (size_t)p[at] << 8 | p[at + 1];
        at += 2;
        if(size - at < n || !n || p[at + n - 1]) return -EINVAL;
        if(tag == 'b') bitfile->part = (const char *)p + at;
        at += n;
    }
    return -EINVAL;
}

static int program(struct hm2 *hm2, const struct rtapi_firmware *fw)
{
    struct hm2_bitfile bitfile = {0};
    const char *why;
    int r = parse(fw->data, fw->size, &bitfile, &why);
    if(r < 0) {
        HM2_ERR(hm2, "firmware %s: %s\n", hm2->config.firmware, why);
        return r;
    }
    if(strcmp(bitfile.part, hm2->io->fpga_part)) {
        HM2_ERR(hm2, "board has FPGA '%s', but the firmware in %s is for FPGA '%s': choose the file for this board\n",
                hm2->io->fpga_part, hm2->config.firmware, bitfile.part);
        return -EINVAL;
    }
    if(hm2->io->ops->reset) COMP_TRY(hm2->io->ops->reset(hm2->io));
    return hm2->io->ops->program_fpga(hm2->io, &bitfile);
}

int hm2_firmware_load(struct hm2 *hm2)
{
    const struct rtapi_firmware *fw;
    struct rtapi_device device = {0};
    int r;
    if(!hm2->config.firmware[0]) {
        if(hm2->io->ops->program_fpga)
            HM2_WARN(hm2, "no firmware= in the config string: the board has to be programmed already\n");
        return 0;
    }
    if(!hm2->io->ops->program_fpga) return 0;
    if(strlen(hm2->config.firmware) > MAX_FIRMWARE_NAME) {
        HM2_ERR(hm2, "firmware name '%s' is longer than %d characters\n", hm2->config.firmware, MAX_FIRMWARE_NAME);
        return -ENAMETOOLONG;
    }
    rtapi_dev_set_name(&device, "%.*s", RTAPI_DEVICE_NAME_LEN, hm2->io->name);
    r = rtapi_request_firmware(&fw, hm2->config.firmware, &device);
    if(r < 0) {
        HM2_ERR(hm2, "firmware %s not found below /lib/firmware (%d)\n", hm2->config.firmware, r);
        return -ENOENT;
    }
    r = program(hm2, fw);
    rtapi_release_firmware(fw);
    return r;
}
