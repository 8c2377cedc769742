/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * modbus.h - Modbus for the ladder: a TCP server for others, a client (TCP or serial
 * RTU) that polls the requests of the project.
 */
#ifndef LADDER_MODBUS_H
#define LADDER_MODBUS_H

#include "classicladder/ladder.h"

#define MODBUS_MAX_PDU 253
#define MODBUS_ERROR_BIT 10     /* %S10: the last exchange of the client failed */

/* [task] Answers a request (function code and data, n bytes) from the ladder's bits and words:
 * address a is %B(a+1) or %W(a+1). Returns the length of the answer in reply. */
int modbus_answer(struct ladder *l, const uint8_t *request, int n, uint8_t reply[MODBUS_MAX_PDU]);

/* [task] Builds request q of the project from the ladder; its length, 0 if it cannot
 * be. Then takes the answer: 0, or -1 if it does not fit the request. */
int modbus_build(const struct ladder *l, const struct modbus_request *q, uint8_t request[MODBUS_MAX_PDU]);
int modbus_take(struct ladder *l, const struct modbus_request *q, const uint8_t *request, const uint8_t *reply, int n);

/* [task] Serves port until *stop; 0, or -errno if it cannot listen. */
int modbus_serve(struct ladder *l, int port, const volatile int *stop);
/* [task] Polls the project's requests until *stop. */
void modbus_poll(struct ladder *l, const volatile int *stop);

#endif
