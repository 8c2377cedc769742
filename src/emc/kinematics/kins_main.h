/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kins_main.h - start and end of a module whose kinematics hold in both directions.
 *
 * A module linked with kins_main.c defines the two below, kinematicsForward,
 * kinematicsInverse and how it switches (KINS_NOT_SWITCHABLE or ownswitch.h);
 * kins_main.c makes the HAL component and exports all of it.
 */
#ifndef KERF_KINS_MAIN_H
#define KERF_KINS_MAIN_H

#include "kins_common.h"

/* The name of the HAL component. */
extern const char kins_name[];

/* Makes pins and parameters of the component. Context: [init]. Returns 0, or < 0. */
int kins_setup(int comp_id);

#endif
