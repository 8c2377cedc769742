// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_shm.cc - buffers in shared memory, and those of one process with the same layout.
//
// Invariants:
// 1. Bookkeeping lives twice (book[2]); book[seq & 1] is valid. A change fills the other
//    one and then adds 1 to seq: a writer killed at any instruction leaves the old state.
// 2. A value buffer has two data slots that alternate in the same way, so its readers take
//    no lock and never make the writer wait; a copy is good if seq moved by less than 1.
// 3. Queue operations and writers hold `lock`, robust: its holder's death frees it.
// Waiting for the lock is bounded by the P line's timeout, in wall time (the holder, if
// alive, is a few instructions from giving it back).
#include <pthread.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>

#include "kerf_instance.h"
#include "nml_transport.hh"
#include "rcs_print.hh"

namespace nml {
namespace {

constexpr uint32_t MAGIC = 0x4b4e4d32; // layout 2

struct Book {
    int64_t write_id;     // messages written so far; also the last serial number
    int64_t was_read;     // value: the last one was read
    int64_t size;         // value: bytes of the message, 0 = none yet
    int64_t head, tail;   // queue: offsets of the first message and of the free space
    int64_t length;       // queue: messages
    int64_t end;          // queue: where the part above a wrap ends; capacity when not wrapped
};

struct MessageHead { int64_t writer, write_id, size; }; // writer: its process
static_assert(sizeof(MessageHead) == MESSAGE_HEADER_BYTES);

// Of a connection number; behind the data, when the buffer has the option `diag`.
struct Usage {
    char process[16];
    std::atomic<int32_t> pid;
    std::atomic<int64_t> reads, read_bytes, writes, write_bytes, last_ns;
};

struct Segment {
    char name[NAME_BYTES];
    std::atomic<uint32_t> magic;
    uint32_t queue;       // 1: queue
    int32_t users;        // entries of Usage; 0: no diagnostics
    int64_t capacity;     // bytes of one data slot
    pthread_mutex_t lock;
    std::atomic<uint64_t> seq;
    Book book[2];
    // data follows: queue: capacity bytes; value: two slots of capacity bytes; then `users` Usages
};

unsigned char *data_of(Segment *s) { return reinterpret_cast<unsigned char *>(s + 1); }
size_t data_bytes(bool queue, int64_t capacity) { return static_cast<size_t>(capacity) * (queue ? 1 : 2); }
Usage *usage_of(Segment *s) { return reinterpret_cast<Usage *>(data_of(s) + data_bytes(s->queue, s->capacity)); }
size_t segment_bytes(bool queue, int64_t capacity, int users) {
    return sizeof(Segment) + data_bytes(queue, capacity) + static_cast<size_t>(users) * sizeof(Usage);
}

int64_t wall_ns() {
    timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

long capacity_of(const BufferLine &b) {
    long bytes = b.size - NAME_BYTES - b.max_procs - (b.queue ? QUEUE_HEADER_BYTES : VALUE_HEADER_BYTES);
    return bytes < 0 ? 0 : (bytes / b.subdivisions) & ~7L;
}

int users_of(const BufferLine &b) { return b.diag ? b.max_procs : 0; }
size_t segment_bytes(const BufferLine &b) { return segment_bytes(b.queue, capacity_of(b), users_of(b)); }

void prepare(Segment *s, const BufferLine &b, bool shared) {
    s->magic = 0;
    pthread_mutexattr_t attr;
    pthread_mutexattr_init(&attr);
    if (shared) pthread_mutexattr_setpshared(&attr, PTHREAD_PROCESS_SHARED);
    pthread_mutexattr_setrobust(&attr, PTHREAD_MUTEX_ROBUST);
    pthread_mutex_init(&s->lock, &attr);
    pthread_mutexattr_destroy(&attr);
    memset(s->name, 0, sizeof s->name);
    strncpy(s->name, b.name.c_str(), sizeof s->name - 1);
    s->queue = b.queue;
    s->capacity = capacity_of(b);
    s->users = users_of(b);
    s->seq = 0;
    s->book[0] = Book{};
    s->book[0].end = s->capacity;
    memset(data_of(s), 0, segment_bytes(b) - sizeof *s);
    s->magic.store(MAGIC, std::memory_order_release);
}

CMS_STATUS status_of(int error, bool attaching) {
    switch (error) {
    case EACCES: return CMS_PERMISSIONS_ERROR;
    case EEXIST: return CMS_RESOURCE_CONFLICT_ERROR;
    case ENOENT: return attaching ? CMS_NO_MASTER_ERROR : CMS_MISC_ERROR;
    case ENOMEM: case ENOSPC: return CMS_CREATE_ERROR;
    default: return CMS_MISC_ERROR;
    }
}

// A connection to a Segment, wherever it lives.
class Memory : public Transport {
public:
    explicit Memory(const Connection &c) : conn_(c) {}
    CMS_STATUS open_status() const override { return open_status_; }
    long max_message() const override {
        if (!seg_) return 0;
        return static_cast<long>(seg_->capacity) - (seg_->queue ? MESSAGE_HEADER_BYTES : 0);
    }

    CMS_STATUS read(unsigned char *data, long *size) override { return take(data, size, true); }
    CMS_STATUS peek(unsigned char *data, long *size) override { return take(data, size, false); }

    CMS_STATUS write(const unsigned char *data, long size, long serial_offset, bool only_if_read, int *id) override {
        Locked l(*this);
        if (l.status != CMS_STATUS_NOT_SET) return l.status;
        Book b = current();
        if (only_if_read && (seg_->queue ? b.length > 0 : b.size > 0 && !b.was_read)) return CMS_WRITE_WAS_BLOCKED;
        if (size > max_message()) return CMS_INSUFFICIENT_SPACE_ERROR;
        unsigned char *to;
        int64_t next_id = b.write_id + 1;
        if (seg_->queue) {
            if (!place(b, size, &to)) return CMS_QUEUE_FULL;
            MessageHead head{getpid(), next_id, size};
            memcpy(to, &head, sizeof head);
            to += sizeof head;
        } else {
            to = data_of(seg_) + static_cast<size_t>((seg_->seq + 1) & 1) * static_cast<size_t>(seg_->capacity);
            b.size = size;
            b.was_read = 0;
        }
        memcpy(to, data, static_cast<size_t>(size));
        int serial = static_cast<int>(next_id);
        if (serial_offset >= 0) memcpy(to + serial_offset, &serial, sizeof serial);
        b.write_id = next_id;
        commit(b);
        count(&Usage::writes, &Usage::write_bytes, size);
        if (id) *id = serial;
        return CMS_WRITE_OK;
    }

    CMS_STATUS check_if_read(int *was_read) override {
        Book b = snapshot();
        *was_read = seg_->queue ? b.length == 0 : b.size == 0 || b.was_read;
        return CMS_READ_OK;
    }

    CMS_STATUS clear() override {
        Locked l(*this);
        if (l.status != CMS_STATUS_NOT_SET) return l.status;
        Book b{};
        b.end = seg_->capacity;
        commit(b);
        last_id_ = 0;
        return CMS_CLEAR_OK;
    }

    CMS_STATUS queue_length(int *length) override {
        if (!seg_->queue) return CMS_NO_IMPLEMENTATION_ERROR;
        *length = static_cast<int>(snapshot().length);
        return CMS_READ_OK;
    }

    CMS_STATUS space_available(long *bytes) override {
        Book b = snapshot();
        if (!seg_->queue) *bytes = static_cast<long>(seg_->capacity);
        else if (b.length == 0) *bytes = static_cast<long>(seg_->capacity);
        else if (b.tail > b.head) *bytes = static_cast<long>(std::max(seg_->capacity - b.tail, b.head));
        else *bytes = static_cast<long>(b.head - b.tail);
        return CMS_READ_OK;
    }

    CMS_STATUS message_count(int *count) override {
        *count = static_cast<int>(snapshot().write_id);
        return CMS_READ_OK;
    }

    CMS_STATUS diagnose(std::vector<Diagnosis> *all) override {
        if (seg_->users <= 0) return CMS_NO_IMPLEMENTATION_ERROR;
        for (int i = 0; i < seg_->users; i++) {
            const Usage &u = usage_of(seg_)[i];
            if (u.pid == 0) continue;
            all->push_back({i, std::string(u.process, strnlen(u.process, sizeof u.process)), u.pid, u.reads,
                            u.read_bytes, u.writes, u.write_bytes, static_cast<double>(u.last_ns) * 1e-9});
        }
        return CMS_READ_OK;
    }

    int last_id() const override { return static_cast<int>(last_id_); }
    void set_last_id(int id) override { last_id_ = id; }
    int last_writer() const override { return last_writer_; }

protected:
    Connection conn_;
    Segment *seg_ = nullptr;
    CMS_STATUS open_status_ = CMS_MISC_ERROR;

    // The connection is there: it stands in the diagnostics from now on.
    void opened() {
        open_status_ = CMS_STATUS_NOT_SET;
        if (conn_.process.cnum < 0 || conn_.process.cnum >= seg_->users) return;
        usage_ = &usage_of(seg_)[conn_.process.cnum];
        strncpy(usage_->process, conn_.process.name.c_str(), sizeof usage_->process - 1);
        usage_->pid = getpid();
    }

private:
    void count(std::atomic<int64_t> Usage::*messages, std::atomic<int64_t> Usage::*bytes, long size) {
        if (!usage_) return;
        usage_->pid.store(getpid(),
                          std::memory_order_relaxed); // a server goes into the background with its connections
        (usage_->*messages).fetch_add(1, std::memory_order_relaxed);
        (usage_->*bytes).fetch_add(size, std::memory_order_relaxed);
        usage_->last_ns.store(wall_ns(), std::memory_order_relaxed);
    }

    // Holds the lock while it lives; status says why it could not be had.
    struct Locked {
        Memory &m;
        CMS_STATUS status = CMS_STATUS_NOT_SET;
        bool held = false;
        explicit Locked(Memory &mem) : m(mem) {
            if (m.conn_.buffer.lock == Lock::none) return;
            if (m.conn_.buffer.lock == Lock::refused) {
                rcs_print_error("Interrupts can not be disabled.\n");
                status = CMS_MISC_ERROR;
                return;
            }
            int r;
            double t = m.conn_.process.timeout;
            if (t < 0) r = pthread_mutex_lock(&m.seg_->lock);
            else if (t == 0) r = pthread_mutex_trylock(&m.seg_->lock);
            else {
                timespec until;
                clock_gettime(CLOCK_REALTIME, &until);
                int64_t ns = until.tv_nsec + static_cast<int64_t>(t * 1e9);
                until.tv_sec += ns / 1000000000;
                until.tv_nsec = ns % 1000000000;
                r = pthread_mutex_timedlock(&m.seg_->lock, &until);
            }
            if (r == EOWNERDEAD) r = pthread_mutex_consistent(&m.seg_->lock); // invariant 1: nothing to repair
            if (r == 0) held = true;
            else status = r == ETIMEDOUT || r == EBUSY ? CMS_TIMED_OUT : CMS_INTERNAL_ACCESS_ERROR;
        }
        ~Locked() { if (held) pthread_mutex_unlock(&m.seg_->lock); }
    };

    Book &current() { return seg_->book[seg_->seq.load(std::memory_order_acquire) & 1]; }

    void commit(const Book &b) {
        uint64_t s = seg_->seq.load(std::memory_order_relaxed);
        seg_->book[(s + 1) & 1] = b;
        seg_->seq.store(s + 1, std::memory_order_release);
    }

    // A consistent copy without the lock. Bounded: a value that changes faster than it can
    // be copied a thousand times in a row does not exist; the last copy is then as good as any.
    Book snapshot() {
        Book b{};
        for (int i = 0; i < 1000; i++) {
            uint64_t s = seg_->seq.load(std::memory_order_acquire);
            b = seg_->book[s & 1];
            std::atomic_thread_fence(std::memory_order_acquire);
            if (seg_->seq.load(std::memory_order_relaxed) == s) break;
        }
        return b;
    }

    CMS_STATUS take(unsigned char *data, long *size, bool remove) {
        if (conn_.buffer.lock == Lock::refused) return Locked(*this).status;
        return seg_->queue ? take_queue(data, size, remove) : take_value(data, size, remove);
    }

    CMS_STATUS take_value(unsigned char *data, long *size, bool mark) {
        for (int i = 0; i < 1000; i++) {
            uint64_t s = seg_->seq.load(std::memory_order_acquire);
            Book b = seg_->book[s & 1];
            if (b.write_id == last_id_ || b.size <= 0 || b.size > seg_->capacity) {
                std::atomic_thread_fence(std::memory_order_acquire);
                if (seg_->seq.load(std::memory_order_relaxed) != s) continue;
                return CMS_READ_OLD;
            }
            const unsigned char *from =
                data_of(seg_) + static_cast<size_t>(s & 1) * static_cast<size_t>(seg_->capacity);
            memcpy(data, from, static_cast<size_t>(b.size));
            std::atomic_thread_fence(std::memory_order_acquire);
            if (seg_->seq.load(std::memory_order_relaxed) != s) continue;
            *size = static_cast<long>(b.size);
            last_id_ = b.write_id;
            // The mark alone, in place: a reader needs no lock for it, and a write that comes
            // between replaces the message together with its mark.
            if (mark) __atomic_store_n(&seg_->book[s & 1].was_read, 1, __ATOMIC_RELAXED);
            count(&Usage::reads, &Usage::read_bytes, *size);
            return CMS_READ_OK;
        }
        return CMS_TIMED_OUT;
    }

    CMS_STATUS take_queue(unsigned char *data, long *size, bool remove) {
        if (snapshot().length == 0) return CMS_READ_OLD; // the common case costs no lock
        Locked l(*this);
        if (l.status != CMS_STATUS_NOT_SET) return l.status;
        Book b = current();
        if (b.length == 0) return CMS_READ_OLD;
        MessageHead head;
        memcpy(&head, data_of(seg_) + b.head, sizeof head);
        if (head.size < 0 || b.head + MESSAGE_HEADER_BYTES + head.size > seg_->capacity)
            return CMS_INTERNAL_ACCESS_ERROR;
        memcpy(data, data_of(seg_) + b.head + sizeof head, static_cast<size_t>(head.size));
        *size = static_cast<long>(head.size);
        last_id_ = head.write_id;
        last_writer_ = static_cast<int>(head.writer);
        count(&Usage::reads, &Usage::read_bytes, *size);
        if (!remove) return CMS_READ_OK;
        b.length--;
        b.head += taken(head.size);
        if (b.length == 0) { b.head = b.tail = 0; b.end = seg_->capacity; }
        else if (b.head >= b.end) { b.head = 0; b.end = seg_->capacity; }
        commit(b);
        return CMS_READ_OK;
    }

    static int64_t taken(int64_t size) { return MESSAGE_HEADER_BYTES + ((size + 7) & ~int64_t(7)); }

    // Room for a message of this size at the tail, which moves. Messages are not split.
    bool place(Book &b, long size, unsigned char **to) {
        int64_t need = taken(size), left;
        if (b.length == 0) { b.head = b.tail = 0; b.end = seg_->capacity; }
        if (b.length == 0 || b.tail > b.head) {
            left = seg_->capacity - b.tail;
            if (need > left && b.length > 0 && need < b.head) {
                b.end = b.tail;
                b.tail = 0;
                left = b.head;
            }
        } else {
            left = b.head - b.tail;
        }
        if (need > left) {
            rcs_print_error("CMS: %s message queue is full.\n", conn_.buffer.name.c_str());
            rcs_print_error("(continued) CMS: Message requires %ld bytes but only %ld bytes are left.\n",
                            static_cast<long>(need), static_cast<long>(left));
            return false;
        }
        *to = data_of(seg_) + b.tail;
        b.tail += need;
        b.length++;
        return true;
    }

    int64_t last_id_ = 0;
    int last_writer_ = 0;
    Usage *usage_ = nullptr; // ours in the diagnostics
};

class SharedMemory : public Memory {
public:
    SharedMemory(const Connection &c, bool master) : Memory(c) {
        const BufferLine &b = c.buffer;
        int key = kerf_instance_key(b.key);
        if (capacity_of(b) <= MESSAGE_HEADER_BYTES) { open_status_ = CMS_CONFIG_ERROR; return; }
        size_t bytes = segment_bytes(b);
        int lock = kerf_instance_lock("nml"); // two masters at once, or a reader in between
        int id = -1, error = 0;
        if (master) {
            id = shmget(key, bytes, IPC_CREAT | 0666);
            if (id < 0 && errno == EINVAL) { // one of another size: ours, from before
                int old = shmget(key, 0, 0);
                shmid_ds info;
                if (old >= 0 && shmctl(old, IPC_STAT, &info) == 0 && info.shm_nattch == 0 &&
                    shmctl(old, IPC_RMID, nullptr) == 0)
                    id = shmget(key, bytes, IPC_CREAT | 0666);
                else errno = EEXIST;
            }
        } else {
            id = shmget(key, 0, 0);
        }
        if (id < 0) error = errno;
        else {
            void *at = shmat(id, nullptr, 0);
            if (at == reinterpret_cast<void *>(-1)) error = errno;
            else seg_ = static_cast<Segment *>(at);
        }
        if (seg_ && master) {
            if (seg_->name[0] && strncmp(seg_->name, b.name.c_str(), sizeof seg_->name - 1) != 0)
                rcs_print_error("Shared memory buffers %s and %s may conflict. (key=%d(0x%X))\n", b.name.c_str(),
                                seg_->name, b.key, static_cast<unsigned>(b.key));
            prepare(seg_, b, true);
        }
        if (lock >= 0) kerf_instance_unlock(lock);
        if (error) { open_status_ = status_of(error, !master); return; }
        shmid_ds info;
        if (shmctl(id, IPC_STAT, &info) == 0 && info.shm_segsz < sizeof(Segment)) {
            drop();
            open_status_ = CMS_RESOURCE_CONFLICT_ERROR;
            return;
        }
        if (seg_->magic.load(std::memory_order_acquire) != MAGIC ||
            info.shm_segsz < segment_bytes(seg_->queue, seg_->capacity, seg_->users)) {
            drop();
            open_status_ = CMS_NO_MASTER_ERROR;
            return;
        }
        if (strncmp(seg_->name, b.name.c_str(), sizeof seg_->name - 1) != 0)
            rcs_print_error("Shared memory buffers %s and %s may conflict. (key=%d(0x%X))\n", b.name.c_str(),
                            seg_->name, b.key, static_cast<unsigned>(b.key));
        opened();
    }
    ~SharedMemory() override { drop(); }

private:
    void drop() {
        if (seg_) shmdt(seg_);
        seg_ = nullptr;
    }
};

// LOCMEM: shared by the threads and NML objects of one process, by buffer name.
class LocalMemory : public Memory {
public:
    explicit LocalMemory(const Connection &c) : Memory(c) {
        static std::mutex guard;
        static std::map<std::string, std::shared_ptr<void>> all;
        std::lock_guard<std::mutex> hold(guard);
        if (capacity_of(c.buffer) <= MESSAGE_HEADER_BYTES) { open_status_ = CMS_CONFIG_ERROR; return; }
        std::shared_ptr<void> &memory = all[c.buffer.name];
        bool fresh = !memory;
        if (fresh) {
            memory = std::shared_ptr<void>(::operator new(segment_bytes(c.buffer), std::align_val_t(64)),
                                           [](void *p) { ::operator delete(p, std::align_val_t(64)); });
            memset(memory.get(), 0, sizeof(Segment));
        }
        mine_ = memory;
        seg_ = static_cast<Segment *>(mine_.get());
        if (fresh) prepare(seg_, c.buffer, false);
        opened();
    }
private:
    std::shared_ptr<void> mine_;
};

// Takes everything, gives nothing.
class Phantom : public Transport {
public:
    explicit Phantom(const Connection &c) : bytes_(c.buffer.size) {}
    CMS_STATUS open_status() const override { return CMS_STATUS_NOT_SET; }
    long max_message() const override { return bytes_; }
    CMS_STATUS read(unsigned char *, long *) override { return CMS_READ_OLD; }
    CMS_STATUS peek(unsigned char *, long *) override { return CMS_READ_OLD; }
    CMS_STATUS write(const unsigned char *, long, long, bool, int *id) override {
        if (id) *id = 0;
        return CMS_WRITE_OK;
    }
    CMS_STATUS check_if_read(int *was_read) override { *was_read = 1; return CMS_READ_OK; }
    CMS_STATUS clear() override { return CMS_CLEAR_OK; }
    CMS_STATUS queue_length(int *n) override { *n = 0; return CMS_READ_OK; }
    CMS_STATUS space_available(long *n) override { *n = bytes_; return CMS_READ_OK; }
    CMS_STATUS message_count(int *n) override { *n = 0; return CMS_READ_OK; }
private:
    long bytes_;
};

} // namespace

std::unique_ptr<Transport> open_shared_memory(const Connection &c, bool master) {
    return std::make_unique<SharedMemory>(c, master);
}
std::unique_ptr<Transport> open_local_memory(const Connection &c) { return std::make_unique<LocalMemory>(c); }
std::unique_ptr<Transport> open_phantom(const Connection &c) { return std::make_unique<Phantom>(c); }

int instance_port(int p) {
    if (!*kerf_instance() || p <= 0) return p;
    return 20000 + kerf_instance_key(p) % 12000; // below the ports that the kernel gives out (32768 and more)
}

} // namespace nml
