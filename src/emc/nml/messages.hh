// SPDX-License-Identifier: GPL-2.0-or-later
//
// messages.hh - the controller's messages as C++ structs, made from messages.def.
//
// Each struct X has X::fields(visitor, x), which shows visitor(nml::Field, member) all
// fields in wire order, and X::local_fields for those that are never sent. [any]
#ifndef KERF_MESSAGES_HH
#define KERF_MESSAGES_HH

#include "emcmotcfg.h"
#include "emcpos.h"
#include "linuxcnc.h"
#include "nml.hh"
#include "nml_code.hh"
#include "state_tag.h"

constexpr int EMC_SYSTEM_CMD_LEN = 256, RESTORE_TEXT_LEN = 2048, CONTROL_NAME_LEN = 40,
              PROGRAM_HASH_LEN = 65;
constexpr int EMC_MESSAGE_LOG_LENGTH = 32, EMC_MDI_QUEUE_SHOWN = 16;
constexpr int EMC_ACTIVE_G_CODES = 17, EMC_ACTIVE_M_CODES = 10, EMC_ACTIVE_SETTINGS = 5;

// Numbers: EMC_JOG_CONT_TYPE and so on.
#define F(...)
#define S(...)
#define L(...)
#define MSG(NAME, NUMBER, BASE, ...) constexpr NMLTYPE NAME##_TYPE = NUMBER;
#include "messages.def"
#undef MSG
#undef F
#undef S
#undef L

#define F(TYPE, NAME, DIM, DOC) TYPE NAME DIM{};
#define S(TYPE, NAME, DIM, KEY, DOC) TYPE NAME DIM{};
#define L(TYPE, NAME, DIM, DOC) TYPE NAME DIM{};
#define MSG(NAME, NUMBER, BASE, ...)                           \
    struct NAME : BASE {                                       \
        NAME() : BASE(NUMBER, sizeof(NAME)) {}                 \
        __VA_ARGS__                                            \
        template <class V, class X> static void fields(V &, X &); \
    };
#include "messages.def"
#undef MSG
#undef F
#undef S
#undef L

#define F(TYPE, NAME, DIM, DOC) visit(nml::Field{#NAME, "", DOC}, x.NAME);
#define S(TYPE, NAME, DIM, KEY, DOC) visit(nml::Field{#NAME, KEY, DOC}, x.NAME);
#define L(TYPE, NAME, DIM, DOC)
#define MSG(NAME, NUMBER, BASE, ...) \
    template <class V, class X> void NAME::fields([[maybe_unused]] V &visit, [[maybe_unused]] X &x) { __VA_ARGS__ }
#include "messages.def"
#undef MSG
#undef F
#undef S
#undef L

// All of them, for NML channels.
const nml::MessageSet &emc_messages();

// Name of a message number, "UNKNOWN" otherwise; as debug texts and errors show it.
const char *emc_symbol_lookup(NMLTYPE type);

enum EmcTaskMode { EMC_TASK_MODE_MANUAL = 1, EMC_TASK_MODE_AUTO = 2, EMC_TASK_MODE_MDI = 3 };
enum EmcTaskState {
    EMC_TASK_STATE_ESTOP = 1,
    EMC_TASK_STATE_ESTOP_RESET = 2,
    EMC_TASK_STATE_OFF = 3,
    EMC_TASK_STATE_ON = 4
};
enum EmcTaskExec {
    EMC_TASK_EXEC_ERROR = 1,
    EMC_TASK_EXEC_DONE = 2,
    EMC_TASK_EXEC_WAITING_FOR_MOTION = 3,
    EMC_TASK_EXEC_WAITING_FOR_MOTION_QUEUE = 4,
    EMC_TASK_EXEC_WAITING_FOR_IO = 5,
    EMC_TASK_EXEC_WAITING_FOR_MOTION_AND_IO = 7,
    EMC_TASK_EXEC_WAITING_FOR_DELAY = 8,
    EMC_TASK_EXEC_WAITING_FOR_SYSTEM_CMD = 9,
    EMC_TASK_EXEC_WAITING_FOR_SPINDLE_ORIENTED = 10
};
enum EmcTaskInterp {
    EMC_TASK_INTERP_IDLE = 1,
    EMC_TASK_INTERP_READING = 2,
    EMC_TASK_INTERP_PAUSED = 3,
    EMC_TASK_INTERP_WAITING = 4
};
enum EmcTrajMode { EMC_TRAJ_MODE_FREE = 1, EMC_TRAJ_MODE_COORD = 2, EMC_TRAJ_MODE_TELEOP = 3 };
enum EmcJointType { EMC_LINEAR = 1, EMC_ANGULAR = 2 };
// Why things were aborted: argument of [RS274NGC]ON_ABORT_COMMAND.
enum EmcAbort {
    EMC_ABORT_TASK_EXEC_ERROR = 1,
    EMC_ABORT_AUX_ESTOP = 2,
    EMC_ABORT_MOTION_OR_IO_RCS_ERROR = 3,
    EMC_ABORT_TASK_STATE_OFF = 4,
    EMC_ABORT_TASK_STATE_ESTOP_RESET = 5,
    EMC_ABORT_TASK_STATE_ESTOP = 6,
    EMC_ABORT_TASK_STATE_NOT_ON = 7,
    EMC_ABORT_TASK_ABORT = 8,
    EMC_ABORT_INTERPRETER_ERROR = 9,
    EMC_ABORT_INTERPRETER_ERROR_MDI = 10,
    EMC_ABORT_USER = 100
};
enum EmcMessageSource { EMC_SOURCE_TASK = 1, EMC_SOURCE_MOTION = 2 };
// stat.debug and [EMC]DEBUG
enum EmcDebug : unsigned {
    EMC_DEBUG_CONFIG = 0x2,
    EMC_DEBUG_VERSIONS = 0x8,
    EMC_DEBUG_TASK_ISSUE = 0x10,
    EMC_DEBUG_NML = 0x40,
    EMC_DEBUG_MOTION_TIME = 0x80,
    EMC_DEBUG_INTERP = 0x100,
    EMC_DEBUG_RCS = 0x200,
    EMC_DEBUG_INTERP_LIST = 0x800,
    EMC_DEBUG_IOCONTROL = 0x1000,
    EMC_DEBUG_OWORD = 0x2000,
    EMC_DEBUG_REMAP = 0x4000,
    EMC_DEBUG_PYTHON = 0x8000,
    EMC_DEBUG_NAMEDPARAM = 0x10000,
    EMC_DEBUG_GDBONSIGNAL = 0x20000,
    EMC_DEBUG_STATE_TAGS = 0x80000,
    EMC_DEBUG_USER1 = 0x10000000,
    EMC_DEBUG_USER2 = 0x20000000,
    EMC_DEBUG_UNCONDITIONAL = 0x40000000
};

#endif
