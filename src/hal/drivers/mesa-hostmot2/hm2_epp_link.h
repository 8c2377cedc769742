/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_epp_link.h - HostMot2 boards on parallel ports in EPP mode. [init]
 */
#ifndef HM2_EPP_LINK_H
#define HM2_EPP_LINK_H

#include "hm2_llio.h"
#include "hal_parport.h"
#include "components/comp_util.h"

#define EPP_BOARDS 8

/* A kind of board, and what loadrt says of its boards. */
struct epp_model {
    const char *driver;                /* hm2_7i90 */
    int connectors;
    const char *connector[3];
    int leds;
    bool programmed_elsewhere;         /* no flash memory: firmware has to be there already */
    int *ioaddr, *ioaddr_hi, *wide;    /* of EPP_BOARDS each; ioaddr < 0: no such board */
    char **config;
    const int *debug;
};

/* Component, ports, boards; 0 or -errno, with a message. */
int epp_start(const struct epp_model *model);
void epp_stop(void);

#endif
