/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * emcmotcfg.h - sizes and defaults of the motion controller.
 */
#ifndef KERF_EMCMOTCFG_H
#define KERF_EMCMOTCFG_H

#define EMCMOT_MAX_JOINTS 16
#define EMCMOT_MAX_EXTRAJOINTS EMCMOT_MAX_JOINTS
#define EMCMOT_MAX_AXIS 9
#define EMCMOT_MAX_SPINDLES 8
#define EMCMOT_MAX_DIO 64
#define EMCMOT_MAX_AIO 64
#define EMCMOT_MAX_MISC_ERROR 64

#define EMCMOT_ERROR_NUM 32    /* slots of the error ring */
#define EMCMOT_ERROR_LEN 1024  /* bytes of a message */
#define EMCMOT_COMP_SIZE 256   /* compensation points of a joint */
#define DEFAULT_TC_QUEUE_SIZE 2000 /* segments of the planner's queue */

#define DEFAULT_SHMEM_KEY 100
#define DEFAULT_EMCMOT_COMM_TIMEOUT 1.0 /* s */

#define DEFAULT_MAX_FEEDOVERRIDE 1.0
#define DEFAULT_MIN_SPINDLE_SPEED 0.0
#define DEFAULT_MAX_SPINDLE_SPEED 1e99

#endif
