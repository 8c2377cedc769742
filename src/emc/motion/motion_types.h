/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * motion_types.h - kinds of moves, as motion.motion-type shows them.
 */
#ifndef KERF_MOTION_TYPES_H
#define KERF_MOTION_TYPES_H

#define EMC_MOTION_TYPE_NONE 0
#define EMC_MOTION_TYPE_TRAVERSE 1
#define EMC_MOTION_TYPE_FEED 2
#define EMC_MOTION_TYPE_ARC 3
#define EMC_MOTION_TYPE_TOOLCHANGE 4
#define EMC_MOTION_TYPE_PROBING 5
#define EMC_MOTION_TYPE_INDEXROTARY 6

#endif
