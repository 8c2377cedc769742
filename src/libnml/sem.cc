// SPDX-License-Identifier: GPL-2.0-or-later
//
// sem.cc - see sem.hh.
#include "sem.hh"

#include <sys/ipc.h>
#include <sys/sem.h>

#include <cerrno>
#include <ctime>

#include "kerf_clock.h"
#include "kerf_instance.h"

namespace {

constexpr int64_t LOOK_NS = 1'000'000; // in virtual time the kernel's time-out means nothing

union semun { // as semctl(2) wants it
    int val;
    semid_ds *buf;
    unsigned short *array;
};

} // namespace

RCS_SEMAPHORE::RCS_SEMAPHORE(unsigned long key, int oflag, double timeout, int mode, int state)
    : timeout_ns_(timeout < 0 ? -1 : static_cast<int64_t>(timeout * 1e9)) {
    const int k = kerf_instance_key(static_cast<int>(key));
    if (oflag & RCS_SEMAPHORE_CREATE) {
        id_ = semget(k, 1, IPC_CREAT | IPC_EXCL | mode);
        created_ = id_ >= 0;
        if (created_) set(state != 0);
    }
    if (!created_) id_ = semget(k, 1, 0);
}

RCS_SEMAPHORE::~RCS_SEMAPHORE() {
    if (created_) semctl(id_, 0, IPC_RMID);
}

int RCS_SEMAPHORE::set(int value) {
    semun to{};
    to.val = value;
    return semctl(id_, 0, SETVAL, to) < 0 ? -1 : 0;
}

int RCS_SEMAPHORE::take(int flags, int64_t timeout_ns) {
    sembuf less{0, -1, static_cast<short>(flags)};
    timespec t{timeout_ns / 1'000'000'000, timeout_ns % 1'000'000'000};
    return semtimedop(id_, &less, 1, timeout_ns < 0 ? nullptr : &t) < 0 ? -errno : 0;
}

int RCS_SEMAPHORE::trywait() { return take(IPC_NOWAIT, -1) == 0 ? 0 : -1; }

int RCS_SEMAPHORE::wait() {
    int r = take(IPC_NOWAIT, -1);
    if (r == -EAGAIN && timeout_ns_ != 0) {
        if (timeout_ns_ > 0 && kerf_clock_is_virtual()) {
            r = kerf_clock_wait(
                [](void *me) { return static_cast<int>(static_cast<RCS_SEMAPHORE *>(me)->trywait() == 0); }, this,
                LOOK_NS, timeout_ns_);
        } else {
            kerf_clock_suspend(); // who posts may run meanwhile
            r = take(0, timeout_ns_);
            kerf_clock_resume();
        }
    }
    return r == 0 ? 0 : r == -EAGAIN || r == -ETIMEDOUT ? -2 : -1;
}

int RCS_SEMAPHORE::post() { return set(1); }
int RCS_SEMAPHORE::clear() { return set(0); }

int RCS_SEMAPHORE::flush() {
    const int waiting = semctl(id_, 0, GETNCNT);
    return waiting < 0 ? -1 : waiting == 0 ? 0 : set(waiting);
}
