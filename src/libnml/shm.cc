// SPDX-License-Identifier: GPL-2.0-or-later
//
// shm.cc - see shm.hh.
#include "shm.hh"

#include <sys/ipc.h>
#include <sys/shm.h>

#include <cerrno>

#include "kerf_instance.h"

RCS_SHAREDMEM::RCS_SHAREDMEM(unsigned long key, size_t size, int oflag, int mode) {
    const int k = kerf_instance_key(static_cast<int>(key));
    if (oflag & RCS_SHAREDMEM_CREATE) {
        id_ = shmget(k, size, IPC_CREAT | IPC_EXCL | mode);
        created = id_ >= 0;
    }
    if (!created) id_ = shmget(k, size, 0);
    if (id_ < 0) {
        create_errno = errno;
        return;
    }
    void *at = shmat(id_, nullptr, 0);
    if (at == reinterpret_cast<void *>(-1)) create_errno = errno;
    else addr = at;
}

RCS_SHAREDMEM::~RCS_SHAREDMEM() {
    if (!addr) return;
    shmdt(addr);
    if (delete_totally || nattch() == 0) shmctl(id_, IPC_RMID, nullptr);
}

int RCS_SHAREDMEM::nattch() const {
    shmid_ds info;
    return id_ >= 0 && shmctl(id_, IPC_STAT, &info) == 0 ? static_cast<int>(info.shm_nattch) : -1;
}
