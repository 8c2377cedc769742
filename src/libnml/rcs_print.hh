// SPDX-License-Identifier: GPL-2.0-or-later
//
// rcs_print.hh - diagnostics of the message layer and of task, by class and destination. [any]
#ifndef KERF_RCS_PRINT_HH
#define KERF_RCS_PRINT_HH

#include <cstdint>

enum : uint32_t {
    PRINT_RCS_ERRORS = 0x1,
    PRINT_NODE_CONSTRUCTORS = 0x2,
    PRINT_NODE_DESTRUCTORS = 0x4,
    PRINT_CMS_CONSTRUCTORS = 0x8,
    PRINT_CMS_DESTRUCTORS = 0x10,
    PRINT_NML_CONSTRUCTORS = 0x20,
    PRINT_NML_DESTRUCTORS = 0x40,
    PRINT_COMMANDS_RECIEVED = 0x100,
    PRINT_COMMANDS_SENT = 0x200,
    PRINT_STATUS_RECIEVED = 0x400,
    PRINT_STATUS_SENT = 0x800,
    PRINT_NODE_CYCLES = 0x1000,
    PRINT_NODE_MISSED_CYCLES = 0x2000,
    PRINT_NODE_CYCLE_TIMES = 0x4000,
    PRINT_NODE_PROCESS_TIMES = 0x8000,
    PRINT_NEW_WM = 0x10000,
    PRINT_NODE_ABORT = 0x20000,
    PRINT_CMS_CONFIG_INFO = 0x40000,
    PRINT_SOCKET_READ_SIZE = 0x80000,
    PRINT_SOCKET_WRITE_SIZE = 0x100000,
    PRINT_INTERFACE_LOADING = 0x200000,
    PRINT_RPC_SERVER_CALL = 0x400000,
    PRINT_SEMAPHORE_ACTIVITY = 0x800000,
    PRINT_SOCKET_CONNECT = 0x1000000,
    PRINT_SERVER_THREAD_ACTIVITY = 0x2000000,
    PRINT_SERVER_SUBSCRIPTION_ACTIVITY = 0x4000000,
    PRINT_SHARED_MEMORY_ACTIVITY = 0x8000000,
    PRINT_ALL_SOCKET_REQUESTS = 0x10000000,
    PRINT_EVERYTHING = 0xFFFFFFFF
};

enum RCS_PRINT_DESTINATION_TYPE {
    RCS_PRINT_TO_STDOUT,
    RCS_PRINT_TO_STDERR,
    RCS_PRINT_TO_NULL,
    RCS_PRINT_TO_LOGGER,
    RCS_PRINT_TO_FILE,
    RCS_PRINT_TO_MESSAGE_BOX
};

void set_rcs_print_flag(uint32_t flags);
void set_rcs_print_destination(RCS_PRINT_DESTINATION_TYPE d);
RCS_PRINT_DESTINATION_TYPE get_rcs_print_destination();
extern int max_rcs_errors_to_print; // -1: no limit

__attribute__((format(printf, 1, 2))) int rcs_print(const char *format, ...);
__attribute__((format(printf, 2, 3))) int rcs_print_debug(uint32_t flag, const char *format, ...);
__attribute__((format(printf, 1, 2))) int rcs_print_error(const char *format, ...);

#endif
