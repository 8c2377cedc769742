// SPDX-License-Identifier: GPL-2.0-or-later
//
// shm.hh - a block of memory that processes of a controller share, by its key. [task]
//
// Keys are those of the controller that the process belongs to (KERF_INSTANCE).
#ifndef KERF_SHM_HH
#define KERF_SHM_HH

#include <cstddef>

enum { RCS_SHAREDMEM_NOCREATE = 0, RCS_SHAREDMEM_CREATE = 1 };

class RCS_SHAREDMEM {
public:
    // Attaches; one that is made is zero. On failure addr is null and create_errno says why.
    RCS_SHAREDMEM(unsigned long key, size_t size, int oflag, int mode = 0666);
    // Detaches. The last one, or anyone after delete_totally = true, removes the block.
    ~RCS_SHAREDMEM();
    RCS_SHAREDMEM(const RCS_SHAREDMEM &) = delete;
    RCS_SHAREDMEM &operator=(const RCS_SHAREDMEM &) = delete;

    int nattch() const;         // how often it is attached; -1 when it is not there
    void *addr = nullptr;
    int create_errno = 0;
    bool created = false;       // it was not there before
    bool delete_totally = false;

private:
    int id_ = -1;
};

#endif
