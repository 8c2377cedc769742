// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_test.cc - cases of tests/nml: `nml-test CASE [file.nml]` prints what happened. Uses the
// controller's messages and buffers of its own instance.
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <thread>

#include "kerf_instance.h"
#include "messages.hh"
#include "nml_config.hh"
#include "nml_server.hh"
#include "rcs_print.hh"

static std::string nml_file;

static NML open_as(const char *buffer, const char *process) {
    return NML(emc_messages(), buffer, process, nml_file.c_str());
}

// All buffers, made as linuxcncsvr makes them; removed at the end.
struct Master {
    NML command = open_as("emcCommand", "emcsvr"), status = open_as("emcStatus", "emcsvr"),
        error = open_as("emcError", "emcsvr");
    ~Master() {
        for (auto &b : nml::buffers_of(nml_file)) {
            int id = shmget(kerf_instance_key(b.key), 0, 0);
            if (id >= 0) shmctl(id, IPC_RMID, nullptr);
        }
    }
};

static void queue_keeps_order() {
    Master m;
    NML in = open_as("emcCommand", "xemc"), out = open_as("emcCommand", "emc");
    int last = 0, wrong = 0, got = 0;
    // Different sizes, filled and emptied by turns so that the storage wraps many times.
    std::mt19937 random(1);
    int next = 1, expect = 1;
    for (int round = 0; round < 20000; round++) {
        int n = static_cast<int>(random() % 8);
        for (int i = 0; i < n; i++) {
            if (random() % 2) {
                EMC_JOINT_HOME h;
                h.joint = next;
                int serial = 0;
                if (in.get_space_available() < 2 * h.size) break;
                if (in.write(h, &serial) != 0) break;
                if (serial <= last) wrong++;
                last = serial;
            } else {
                EMC_TASK_PLAN_EXECUTE e;
                snprintf(e.command, sizeof e.command, "%d", next);
                if (in.get_space_available() < 2 * e.size) break;
                if (in.write(e) != 0) break;
                last = e.serial_number;
            }
            next++;
        }
        n = static_cast<int>(random() % 9);
        for (int i = 0; i < n; i++) {
            NMLTYPE t = out.read();
            if (t == 0) break;
            int value = t == EMC_JOINT_HOME_TYPE          ? out.get<EMC_JOINT_HOME>()->joint
                        : t == EMC_TASK_PLAN_EXECUTE_TYPE ? atoi(out.get<EMC_TASK_PLAN_EXECUTE>()->command)
                                                          : -1;
            if (value != expect || out.get<RCS_CMD_MSG>()->serial_number != value) wrong++;
            expect++;
            got++;
        }
    }
    while (out.read() > 0) expect++;
    printf("written %s read, wrong %d, queue %d\n", expect == next ? "all" : "not all", wrong, out.get_queue_length());
    printf("more than %d\n", got > 50000 ? 50000 : got);
}

static void error_queue_holds_25() {
    Master m;
    NML out = open_as("emcError", "emc"), in = open_as("emcError", "xemc");
    int n = 0;
    for (; n < 100; n++) {
        EMC_OPERATOR_ERROR e;
        if (out.get_space_available() < 2 * e.size) break;
        snprintf(e.error, sizeof e.error, "message %d", n);
        if (out.write(e) != 0) break;
    }
    printf("fit: %d\n", n);
    int got = 0;
    while (in.read() > 0) got++;
    printf("read: %d\n", got);
}

static void full_queue_refuses() {
    Master m;
    verbose_nml_error_messages = 0;
    NML out = open_as("emcCommand", "xemc"), in = open_as("emcCommand", "emc");
    EMC_TASK_PLAN_OPEN big;
    int r = 0, n = 0;
    while ((r = out.write(big)) == 0) n++;
    printf("big messages: %d, then %d, error %d, status %d\n", n, r, out.error_type, out.status);
    int got = 0;
    while (in.read() > 0) got++;
    printf("read %d, then a write gives %d\n", got, out.write(big));
    r = out.write_if_read(big);
    printf("write_if_read of an unread message %d error %d\n", r, out.error_type);
    in.read();
    printf("write_if_read of a read one %d\n", out.write_if_read(big));
}

static void status_is_last_value() {
    Master m;
    NML out = open_as("emcStatus", "emc"), a = open_as("emcStatus", "xemc"), b = open_as("emcStatus", "xemc");
    printf("before: %d\n", a.peek());
    EMC_STAT s;
    for (int i = 1; i <= 3; i++) {
        s.debug = i;
        out.write(s);
    }
    int r = a.peek();
    printf("a: %d %d\n", r, a.get<EMC_STAT>()->debug);
    printf("a again: %d\n", a.peek());
    r = b.read();
    printf("b: %d %d\n", r, b.get<EMC_STAT>()->debug);
    r = a.write(s);
    printf("permission: %d %d\n", r, a.status);
    verbose_nml_error_messages = 0;
    printf("no such buffer: %d\n", NML(emc_messages(), "nowhere", "xemc", nml_file.c_str()).error_type);
}

// Readers see whole messages only, however fast the writer is.
static void status_is_never_torn() {
    Master m;
    pid_t writer = fork();
    if (writer == 0) {
        NML out = open_as("emcStatus", "emc");
        EMC_STAT s;
        for (unsigned i = 0;; i++) {
            s.task.taskbeat = i;
            s.motion.heartbeat = i;
            s.error_line = static_cast<int>(i);
            for (int &d : s.motion.synch_di) d = static_cast<int>(i);
            out.write(s);
        }
    }
    NML in = open_as("emcStatus", "xemc");
    int torn = 0, seen = 0;
    for (clock_t end = clock() + 2 * CLOCKS_PER_SEC; seen < 20000 && clock() < end;) { // of our CPU time
        if (in.peek() != EMC_STAT_TYPE) {
            sched_yield(); // the writer may have to share this CPU
            continue;
        }
        seen++;
        const EMC_STAT &s = *in.get<EMC_STAT>();
        if (s.task.taskbeat != s.motion.heartbeat || static_cast<int>(s.task.taskbeat) != s.error_line ||
            s.motion.synch_di[63] != s.error_line)
            torn++;
    }
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    printf("torn: %d\n", torn);
}

// Writers and readers are killed at any instant; the rest goes on, nothing that was
// acknowledged is lost and no queue is broken.
static void killed_client_blocks_nobody() {
    Master m;
    std::mt19937 random(7);
    NML out = open_as("emcCommand", "emc");
    long lost = 0, kills = 0;
    double slowest = 0;
    for (int round = 0; round < 300; round++) {
        pid_t child = fork();
        if (child == 0) {
            NML in = open_as("emcCommand", round % 2 ? "xemc" : "emc");
            for (;;) {
                EMC_JOINT_HOME h;
                if (in.get_queue_length() < 20) in.write(h);
                if (round % 2 == 0) in.read();
            }
        }
        timespec nap{0, static_cast<long>(random() % 400000)};
        nanosleep(&nap, nullptr);
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        kills++;
        timespec t0, t1;
        clock_gettime(CLOCK_MONOTONIC, &t0);
        int length = out.get_queue_length(), got = 0;
        while (out.read() > 0) got++;
        clock_gettime(CLOCK_MONOTONIC, &t1);
        slowest = std::max(slowest, static_cast<double>(t1.tv_sec - t0.tv_sec) +
                                        static_cast<double>(t1.tv_nsec - t0.tv_nsec) * 1e-9);
        if (got != length) lost++;
        if (out.status < 0) lost++;
    }
    printf("kills %ld, broken %ld, slowest below 5 s: %s\n", kills, lost, slowest < 5 ? "yes" : "no");
}

// Many clients write at once; each finds its own serial numbers rising, none is lost.
static void many_clients_lose_nothing() {
    Master m;
    constexpr int CLIENTS = 8, EACH = 2000;
    for (int c = 0; c < CLIENTS; c++) {
        if (fork() == 0) {
            verbose_nml_error_messages = 0;
            NML in = open_as("emcCommand", "xemc");
            int last = 0;
            for (int i = 0; i < EACH; i++) {
                EMC_JOINT_HOME h;
                h.joint = c * EACH + i;
                int serial = 0;
                while (in.write(h, &serial) != 0) {
                    timespec nap{0, 50000};
                    nanosleep(&nap, nullptr);
                }
                if (serial <= last) _exit(1);
                last = serial;
            }
            _exit(0);
        }
    }
    NML out = open_as("emcCommand", "emc");
    std::map<int, int> next;
    int got = 0, wrong = 0;
    for (time_t end = time(nullptr) + 60; got < CLIENTS * EACH && time(nullptr) < end;) {
        if (out.read() <= 0) continue;
        int v = out.get<EMC_JOINT_HOME>()->joint;
        if (v % EACH != next[v / EACH]++) wrong++;
        got++;
    }
    int failed = 0, status;
    while (wait(&status) > 0) failed += status != 0;
    printf("read %d, out of order %d, clients that failed %d\n", got, wrong, failed);
}

// Every message type survives the way over TCP; local-only fields stay behind.
static void tcp_carries_every_message() {
    Master m;
    static volatile int stop = 0;
    nml::Server server;
    for (auto &b : nml::buffers_of(nml_file))
        server.add(b.name == "emcCommand" ? m.command : b.name == "emcStatus" ? m.status : m.error, b);
    if (!server.listen()) { printf("no port\n"); return; }
    std::thread serving([&] { server.run(&stop); });
    {
        nmlForceRemoteConnection();
        NML command = open_as("emcCommand", "xemc"), status = open_as("emcStatus", "xemc"),
            error = open_as("emcError", "xemc");
        nmlForceLocalConnection();
        NML task_in = open_as("emcCommand", "emc"), task_out = open_as("emcStatus", "emc"),
            task_error = open_as("emcError", "emc");
        printf("valid: %d %d %d\n", command.valid(), status.valid(), error.valid());
        int wrong = 0, count = 0, last = 0;
        for (const nml::MessageType &t : emc_messages().all()) {
            if (t.kind != nml::Kind::command) continue;
            std::vector<unsigned char> raw(static_cast<size_t>(t.size));
            NMLmsg *msg = reinterpret_cast<NMLmsg *>(raw.data());
            msg->_type = t.type;
            msg->size = t.size;
            int serial = 0;
            if (command.write(*msg, &serial) != 0 || serial <= last) { wrong++; continue; }
            last = serial;
            if (task_in.read() != t.type || task_in.get<RCS_CMD_MSG>()->serial_number != serial ||
                task_in.get_address()->size != t.size)
                wrong++;
            count++;
        }
        printf("commands: %s, wrong %d\n", count > 90 ? "all" : "some", wrong);
        EMC_TASK_PLAN_EXECUTE mdi;
        snprintf(mdi.command, sizeof mdi.command, "G0 X1 (\xc3\xa4)");
        command.write(mdi);
        task_in.read();
        printf("mdi: %s\n", task_in.get<EMC_TASK_PLAN_EXECUTE>()->command);
        EMC_TRAJ_SET_G5X g;
        g.g5x_index = 3;
        g.origin.tran.x = 1.25;
        g.origin.w = -1e-300;
        command.write(g);
        task_in.read();
        printf("pose: %d %g %g\n", task_in.get<EMC_TRAJ_SET_G5X>()->g5x_index,
               task_in.get<EMC_TRAJ_SET_G5X>()->origin.tran.x, task_in.get<EMC_TRAJ_SET_G5X>()->origin.w);
        EMC_STAT s;
        s.task.taskbeat = 0x123456789abcull;
        s.motion.joint[15].output = 3.5;
        s.motion.traj.tag.fields[0] = 7;
        s.io.tool.pocketPrepped = -1;
        s.error_line = 42;
        task_out.write(s);
        printf("status: %d", status.peek());
        const EMC_STAT &r = *status.get<EMC_STAT>();
        printf(" %llx %g tag %d pocket %d line %d\n", static_cast<unsigned long long>(r.task.taskbeat),
               r.motion.joint[15].output, r.motion.traj.tag.fields[0], r.io.tool.pocketPrepped, r.error_line);
        printf("again: %d\n", status.peek());
        EMC_OPERATOR_ERROR e;
        snprintf(e.error, sizeof e.error, "text");
        task_error.write(e);
        task_error.write(e);
        printf("queue: %d", error.get_queue_length());
        printf(" read %d", error.read());
        printf(", then %d", error.get_queue_length());
        printf(", messages %d\n", error.get_msg_count());
    }
    stop = 1;
    serving.join();
}

// What each documented form of B and P line gives: the state of the connection and what was printed.
static void configuration_lines() {
    struct {
        const char *what, *buffer, *process, *text;
    } cases[] = {
        {"a plain one", "a", "p", "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"comments, short lines, continued", "a", "p",
         "# B a\n B a SHMEM\nx\nB a SHMEM localhost 4096 \\\n0 0 1 4 7001 queue\nP p a LOCAL localhost \\\nRW 0 INF 1 "
         "0\n"},
        {"options in any case, hexadecimal", "a", "p",
         "B a SHMEM localhost 0x1000 0 0 1 4 0x1b59 Queue Confirm_Write SERIAL mutex=OS_SEM xdr\nP p a LOCAL localhost "
         "RW 0 1.0 1 0\n"},
        {"default buffer of the process", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP q a LOCAL localhost W 0 1.0 1 0\nP p default LOCAL localhost RW 0 "
         "1.0 1 0\n"},
        {"default of all", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP default default LOCAL localhost RW 0 1.0 1 0\n"},
        {"AUTO on this computer", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a AUTO localhost RW 0 1.0 1 0\n"},
        {"autocnum with nine words", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 autocnum\nP p a LOCAL localhost RW 0 1.0 1\n"},
        {"in this process", "a", "p", "B a LOCMEM localhost 4096 0 0 1 4 0\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"phantom", "a", "p", "B a PHANTOM localhost 4096 0 0 1 4 0\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"phantom process", "a", "p", "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a PHANTOM localhost RW 0 1.0 1 0\n"},
        {"nobody made it", "a", "p", "B a SHMEM localhost 4096 0 0 1 4 7002\nP p a LOCAL localhost RW 0 1.0 0 0\n"},
        {"no such buffer", "b", "p", "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"no such process", "a", "q", "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"connection number too large", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 4\n"},
        {"split and queue", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 queue split\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"UDP", "a", "p", "B a SHMEM localhost 4096 0 0 1 4 7001 UDP=5\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"GLOBMEM", "a", "p", "B a GLOBMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"remote without a port", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a REMOTE localhost RW 0 1.0 1 0\n"},
        {"mutex=none", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 mutex=none\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"mutex=mao", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 queue mutex=mao semdelay=0.001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"mutex=mao_w_os_sem", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 queue mutex=mao_w_os_sem\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"mutex=mao_split", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 split mutex=mao_split\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"mutex=no_interrupts", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 mutex=no_interrupts\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"mutex=no_switching", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 queue mutex=no_switching\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"diagnostics, encodings, limits", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 diag ascii disp BSEM=5 BRPI=0.1 enc_max_size=100 version=3.9\nP p a "
         "LOCAL localhost RW 0 1.0 1 0\n"},
        {"diagnostics of an old version", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 diag VERSION=3.7\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"four parts", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 subdiv=4\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"parts too small for the message", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 subdiv=400\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"every message is of one type", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 FORCE_TYPE=124\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"no waiting for the lock", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 queue\nP p a LOCAL localhost RW 0 0 1 0\n"},
        {"serial port", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0 serialPortDevName=/dev/ttyS0\n"},
        {"FILEMEM", "a", "p", "B a FILEMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"RTLMEM", "a", "p", "B a RTLMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"too few words", "a", "p", "B a SHMEM localhost\nP p a LOCAL localhost RW 0 1.0 1 0\n"},
        {"may only write", "a", "p", "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost W 0 1.0 1 0\n"},
        {"may only read", "a", "p", "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost R 0 1.0 1 0\n"},
        {"a server may do both", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001\nP p a LOCAL localhost W 1 1.0 1 0\n"},
        {"remote without a server", "a", "p",
         "B a SHMEM localhost 4096 0 0 1 4 7001 TCP=1\nP p a REMOTE localhost RW 0 1.0 1 0\n"}};
    const char *name = "configuration.nml";
    int fd = open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (fd < 0) return;
    for (auto &c : cases) {
        if (ftruncate(fd, 0) != 0 || pwrite(fd, c.text, strlen(c.text), 0) < 0) return;
        printf("%s: ", c.what);
        NML n(emc_messages(), c.buffer, c.process, name);
        EMC_JOINT_HOME h;
        h.joint = 3;
        bool good = n.valid() && n.write(h) == 0;
        printf("valid %d error %d status %d written %d read %d queue %d space %s\n", n.valid(), n.error_type, n.status,
               good, n.valid() ? n.read() : -1, n.valid() ? n.get_queue_length() : -1,
               n.valid() && n.get_space_available() > 0 ? "yes" : "no");
    }
    int id = shmget(kerf_instance_key(7001), 0, 0);
    if (id >= 0) shmctl(id, IPC_RMID, nullptr);
    close(fd);
    unlink(name);
    printf("no such file: ");
    printf("%d\n", NML(emc_messages(), "a", "p", "/nonexistent/file.nml").error_type);
    for (int s = -16; s <= 6; s++) printf("%d->%d ", s, nml_error_of(static_cast<CMS_STATUS>(s)));
    printf("\n");
}

// What is garbled on its way is refused, or is a message whose strings end. Never more.
static void garbled_messages_are_refused_or_whole() {
    std::mt19937 random(3);
    const nml::MessageSet &set = emc_messages();
    for (auto [name, coding] :
         {std::pair{"xdr", nml::Coding::xdr}, {"disp", nml::Coding::disp}, {"raw", nml::Coding::raw}}) {
        int refused = 0, taken = 0, wrong = 0;
        for (const nml::MessageType &t : set.all()) {
            std::vector<unsigned char> raw(static_cast<size_t>(t.size)), back(static_cast<size_t>(t.size));
            NMLmsg *msg = reinterpret_cast<NMLmsg *>(raw.data()), *got = reinterpret_cast<NMLmsg *>(back.data());
            msg->_type = t.type;
            msg->size = t.size;
            const std::vector<unsigned char> good = nml::encode_message(set, *msg, coding);
            if (!nml::decode_message(set, good.data(), good.size(), got, back.size(), coding) ||
                nml::encode_message(set, *got, coding) != good)
                wrong++;
            for (int n = 0; n < 50; n++) {
                std::vector<unsigned char> bad = good;
                for (unsigned k = 1 + random() % 4; k > 0; k--)
                    bad[random() % bad.size()] = static_cast<unsigned char>(random());
                if (random() % 3 == 0) bad.resize(random() % bad.size());
                if (!nml::decode_message(set, bad.data(), bad.size(), got, back.size(), coding)) {
                    refused++;
                    continue;
                }
                taken++;
                const std::vector<unsigned char> again = nml::encode_message(set, *got, nml::Coding::xdr);
                if (again.empty() ||
                    !nml::decode_message(set, again.data(), again.size(), got, back.size(), nml::Coding::xdr))
                    wrong++;
            }
        }
        printf("%s: %s refused, %s taken, wrong %d\n", name, refused > 500 ? "hundreds" : "few",
               taken > 500 ? "hundreds" : "few", wrong);
    }
}

// Permissions, sizes, waiting, was-read marks of one value buffer and one queue.
static void calls_give_the_documented_results() {
    Master m;
    NML task = open_as("emcStatus", "emc"), screen = open_as("emcStatus", "xemc"), errors = open_as("emcError", "xemc"),
        writer = open_as("emcError", "emc");
    int r = task.read();
    printf("a writer that reads: %d %d\n", r, task.status);
    EMC_NULL null;
    r = screen.write(null);
    printf("a reader that writes: %d %d\n", r, screen.status);
    null.size = 0;
    r = writer.write(null);
    printf("size 0: %d %d\n", r, writer.error_type);
    EMC_NULL none;
    none._type = 0;
    r = writer.write(none);
    printf("type 0: %d %d\n", r, writer.error_type);
    writer.clear();
    EMC_STAT big;
    r = writer.write(big);
    printf("too big: %d status %d error %d\n", r, writer.status, writer.error_type);
    r = errors.blocking_read(0.01);
    printf("blocking read, nothing comes: %d %d %d\n", r, errors.status, errors.error_type);
    EMC_OPERATOR_TEXT text;
    writer.write(text);
    printf("queue: %d %d", errors.get_queue_length(), errors.check_if_read());
    printf(" peek %d", errors.peek());
    printf(" still %d", errors.get_queue_length());
    printf(" read %d", errors.blocking_read(1));
    printf(" then %d %d messages %d\n", errors.get_queue_length(), errors.check_if_read(), errors.get_msg_count());
    task.write(big);
    printf("value: read? %d", screen.check_if_read());
    printf(" peek %d", screen.peek());
    printf(" read? %d", screen.check_if_read());
    task.write(big);
    printf(" read %d", screen.read());
    printf(" read? %d", screen.check_if_read());
    printf(" again %d", screen.read());
    printf(" queue %d\n", screen.get_queue_length());
    printf("if read: %d", task.write_if_read(big));
    r = task.write_if_read(big);
    printf(" %d error %d status %d\n", r, task.error_type, task.status);
    m.status.clear();
    printf("cleared: %d\n", screen.peek());
    printf("symbols: %s %s\n", emc_symbol_lookup(124), emc_symbol_lookup(4711));
}

// Text of a message and back; connections that end and come again; who used a buffer, near and far.
static void messages_as_text_and_connections() {
    Master m;
    static volatile int stop = 0;
    nml::Server server;
    for (auto &b : nml::buffers_of(nml_file))
        server.add(b.name == "emcCommand" ? m.command : b.name == "emcStatus" ? m.status : m.error, b);
    if (!server.listen()) { printf("no port\n"); return; }
    std::thread serving([&] { server.run(&stop); });
    {
        nmlForceRemoteConnection();
        NML far = open_as("emcCommand", "xemc");
        nmlForceLocalConnection();
        NML task = open_as("emcCommand", "emc");
        EMC_TASK_PLAN_EXECUTE mdi;
        snprintf(mdi.command, sizeof mdi.command, "G0 X1, (\\)");
        const std::string text = far.msg2str(mdi);
        printf("%s\nback: %d %s\n", text.c_str(), far.str2msg(text), far.get<EMC_TASK_PLAN_EXECUTE>()->command);
        printf("cut: %d, none: %d\n", far.str2msg(text.substr(0, 20)), far.str2msg(""));
        printf("written %d", far.write(mdi));
        far.disconnect();
        printf(", disconnected: valid %d write %d status %d", far.valid(), far.write(mdi), far.status);
        printf(", again %d", far.reconnect());
        printf(" write %d\n", far.write(mdi));
        int got = 0;
        while (task.read() > 0) got++;
        printf("task got %d\n", got);
        printf("waited for: %d, a wrong name: %d\n",
               nmlWaitOpen(emc_messages(), "emcStatus", "emc", nml_file.c_str(), 0.01)->valid(),
               nmlWaitOpen(emc_messages(), "nowhere", "emc", nml_file.c_str(), 0.01)->valid());
        for (NML *channel : {&task, &far})
            for (const nml::Diagnosis &d : channel->get_diag_info())
                printf("%d %s alive %d: read %lld (%s) written %lld (%s)\n", d.cnum, d.process.c_str(),
                       d.pid == getpid() && d.last > 0, static_cast<long long>(d.reads),
                       d.read_bytes == d.reads * mdi.size ? "right" : "wrong", static_cast<long long>(d.writes),
                       d.write_bytes == d.writes * mdi.size ? "right" : "wrong");
        NML status = open_as("emcStatus", "emc");
        const size_t entries = status.get_diag_info().size();
        printf("a buffer without: %zu, status %d\n", entries, status.status);
    }
    stop = 1;
    serving.join();
}

int main(int argc, char **argv) {
    const std::map<std::string, void (*)()> cases = {
        {"queue-keeps-order", queue_keeps_order},
        {"error-queue-holds-25", error_queue_holds_25},
        {"full-queue-refuses", full_queue_refuses},
        {"status-is-last-value", status_is_last_value},
        {"status-is-never-torn", status_is_never_torn},
        {"killed-client-blocks-nobody", killed_client_blocks_nobody},
        {"many-clients-lose-nothing", many_clients_lose_nothing},
        {"tcp-carries-every-message", tcp_carries_every_message},
        {"messages-as-text-and-connections", messages_as_text_and_connections},
        {"configuration-lines", configuration_lines},
        {"garbled", garbled_messages_are_refused_or_whole},
        {"calls-give-the-documented-results", calls_give_the_documented_results}};
    auto it = argc > 1 ? cases.find(argv[1]) : cases.end();
    if (it == cases.end()) {
        for (auto &c : cases) printf("%s\n", c.first.c_str());
        return 1;
    }
    nml_file = argc > 2 ? argv[2] : default_nml_config_file();
    it->second();
    return 0;
}
