/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * linuxcnc.h - sizes and factors that programs beside the controller use.
 */
#ifndef LINUXCNC_H
#define LINUXCNC_H

#define LINELEN 255   /* characters of a line or a path, with its NUL */
#define BUFFERLEN 80  /* characters of a short text */

#define MM_PER_INCH 25.4
#define INCH_PER_MM (1.0 / 25.4)

#endif
