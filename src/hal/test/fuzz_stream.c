/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fuzz_stream.c - halstreamer's reader of lines, made reachable for fuzz_parsers.cc. The file
 * is taken in as it is.
 */
#define main halstreamer_program
#include "../stream/halstreamer.c"
#undef main

void fuzz_stream_line(const char *line)
{
    static const hal_type_t types[] = {HAL_BIT, HAL_FLOAT, HAL_S32, HAL_U32, HAL_S64, HAL_U64};
    hal_stream_data_u data[6];
    parse_line(line, 0, types, 6, data);
}
