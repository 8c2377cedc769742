// SPDX-License-Identifier: GPL-2.0-or-later
//
// sem.hh - a SysV semaphore between the processes of a controller: available or not. [task]
//
// post makes it available, a wait that succeeds takes it; posts while it is available are one. Keys
// are those of the controller that the process belongs to (KERF_INSTANCE).
#ifndef KERF_SEM_HH
#define KERF_SEM_HH

#include <cstdint>

enum { RCS_SEMAPHORE_NOCREATE = 0, RCS_SEMAPHORE_CREATE = 1 };

class RCS_SEMAPHORE {
public:
    // timeout: s, of wait(); 0 try only, negative for ever. state: 1 available at first. An existing
    // one of this key is taken as it is. The creator removes it at the end.
    RCS_SEMAPHORE(unsigned long key, int oflag, double timeout, int mode = 0666, int state = 0);
    ~RCS_SEMAPHORE();
    RCS_SEMAPHORE(const RCS_SEMAPHORE &) = delete;
    RCS_SEMAPHORE &operator=(const RCS_SEMAPHORE &) = delete;

    bool valid() const { return id_ >= 0; }
    int wait();    // takes it: 0; -1 error, -2 timed out
    int trywait(); // takes it: 0; -1 when it is not available
    int post();    // available; 0 or -1
    int setflag() { return post(); }
    int clear();   // not available; 0 or -1
    int flush();   // all who wait now go on; 0 or -1

private:
    int take(int flags, int64_t timeout_ns); // 0 or -errno
    int set(int value);                      // 0 or -1
    int64_t timeout_ns_;
    int id_;
    bool created_ = false;
};

#endif
