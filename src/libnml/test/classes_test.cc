// SPDX-License-Identifier: GPL-2.0-or-later
//
// classes_test.cc - tests/nml/lists-timers-semaphores-and-shared-memory: prints what the small
// classes of the library do. In virtual time.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "kerf_clock.h"
#include "linklist.hh"
#include "sem.hh"
#include "shm.hh"
#include "timer.hh"

static const char *text(void *data) { return data ? static_cast<const char *>(data) : "-"; }

static void show(LinkedList &list) {
    for (void *d = list.get_head(); d; d = list.get_next()) printf(" %s", text(d));
    printf(" (%d)\n", list.list_size);
}

static void lists() {
    LinkedList list;
    char word[] = "b";
    printf("ids: %d", list.store_before_current_node(word, sizeof word, true));
    printf(" %d", list.store_at_tail(word, sizeof word, true));
    word[0] = 'c';
    printf(" %d", list.store_at_tail(word, sizeof word, true));
    word[0] = 'a';
    printf(" %d\n", list.store_at_head(word, sizeof word, false));
    show(list);
    word[0] = 'z'; // the head is a pointer, the others are copies
    show(list);
    printf("tail %s", text(list.get_tail()));
    printf(", before it %s", text(list.get_last()));
    printf(", again %s", text(list.get_last()));
    printf(", before the head %s\n", text(list.get_last()));
    printf("second %s, tenth %s", text(list.find_node(1)), text(list.find_node(9)));
    printf(", id 2 %s, first newer than 1 %s", text(list.get_by_id(2)), text(list.get_first_newer(1)));
    printf(", last newer than 1 %s, newer than 3 %s\n", text(list.get_last_newer(1)), text(list.get_first_newer(3)));
    char more[] = "m";
    list.get_by_id(2);
    list.store_after_current_node(more, sizeof more, true);
    show(list);
    list.get_by_id(2);
    list.delete_current_node();
    printf("at %s:", text(list.get_by_id(list.get_current_id())));
    show(list);
    void *head = list.retrieve_head(), *tail = list.retrieve_tail();
    printf("taken %s %s:", text(head), text(tail));
    ::operator delete(tail);
    show(list);
    list.delete_node(1);
    printf("empty: %d\n", list.is_empty());

    for (LIST_SIZING_MODE mode : {DELETE_FROM_HEAD, DELETE_FROM_TAIL, STOP_AT_MAX}) {
        LinkedList three;
        three.set_list_sizing_mode(3, mode);
        int last = 0;
        for (char c = 'a'; c <= 'e'; c++) {
            char s[2] = {c, 0};
            last = three.store_at_tail(s, sizeof s, true);
        }
        printf("full, mode %d, last id %d:", mode, last);
        show(three);
    }
}

// Any order of calls does what the same calls do to a vector.
static void lists_at_random() {
    std::mt19937 random(7);
    LinkedList list;
    std::vector<std::pair<int, std::string>> known;
    int wrong = 0;
    for (int n = 0; n < 20000; n++) {
        std::string s = std::to_string(n);
        switch (random() % 5) {
        case 0: known.emplace_back(list.store_at_tail(s.data(), s.size() + 1, true), s); break;
        case 1: known.insert(known.begin(), {list.store_at_head(s.data(), s.size() + 1, true), s}); break;
        case 2:
            if (known.empty()) break;
            {
                size_t i = random() % known.size();
                list.delete_node(known[i].first);
                known.erase(known.begin() + static_cast<std::ptrdiff_t>(i));
            }
            break;
        case 3:
            if (void *d = list.retrieve_head()) {
                wrong += known.empty() || known[0].second != text(d);
                known.erase(known.begin());
                ::operator delete(d);
            }
            break;
        default:
            if (!known.empty()) {
                size_t i = random() % known.size();
                wrong += known[i].second != text(list.get_by_id(known[i].first)) ||
                         known[i].second != text(list.find_node(static_cast<int>(i)));
            }
        }
        wrong += list.list_size != static_cast<int>(known.size());
    }
    printf("at random: wrong %d\n", wrong);
}

static void timers() {
    const double start = etime();
    auto at = [&] { return etime() - start; };
    RCS_TIMER t(0.010);
    for (double work : {0.0, 0.004, 0.010, 0.025}) {
        esleep(work);
        const int missed = t.wait();
        printf("worked %.3f: missed %d, at %.3f\n", work, missed, at());
    }
    printf("load %.3f\n", t.load());
    esleep(0.003);
    t.sync();
    printf("after sync: load %.1f", t.load());
    printf(", missed %d", t.wait());
    printf(", at %.3f\n", at());
    int beats = 0;
    RCS_TIMER foreign(0.010, [](void *n) { return ++*static_cast<int *>(n) == 3 ? -1 : 0; }, &beats);
    printf("of a function: %d", foreign.wait());
    printf(" %d", foreign.wait());
    printf(" %d\n", foreign.wait());
}

static void semaphores() {
    constexpr unsigned long KEY = 4711;
    RCS_SEMAPHORE none(KEY, RCS_SEMAPHORE_NOCREATE, 0);
    printf("not there: valid %d", none.valid());
    RCS_SEMAPHORE s(KEY, RCS_SEMAPHORE_CREATE, 0.5, 0666, 1);
    printf(", made: %d, taken %d", s.valid(), s.trywait());
    printf(", again %d", s.trywait());
    const double before = etime();
    printf(", waited %d", s.wait());
    printf(" for %.2f s\n", etime() - before);
    RCS_SEMAPHORE other(KEY, RCS_SEMAPHORE_CREATE, 0);
    other.post();
    other.post();
    printf("two posts are one: %d", s.wait());
    printf(" %d", s.trywait());
    other.setflag();
    s.clear();
    printf(", cleared: %d\n", other.wait());
    fflush(stdout);
    kerf_clock_suspend();
    const pid_t child = fork();
    if (child == 0) {
        RCS_SEMAPHORE mine(KEY, RCS_SEMAPHORE_NOCREATE, -1);
        _exit(mine.wait() == 0 ? 0 : 1);
    }
    int status = -1;
    while (waitpid(child, &status, WNOHANG) == 0) { // until it waits there is nobody to be let go
        s.flush();
        usleep(1000);
    }
    kerf_clock_resume();
    printf("another process was let go: %d, left %d\n", WEXITSTATUS(status), s.trywait());
}

static void memory() {
    constexpr unsigned long KEY = 4712;
    {
        RCS_SHAREDMEM none(KEY, 100, RCS_SHAREDMEM_NOCREATE);
        printf("not there: %d %s\n", none.addr != nullptr, strerror(none.create_errno));
        RCS_SHAREDMEM a(KEY, 100, RCS_SHAREDMEM_CREATE);
        {
            RCS_SHAREDMEM b(KEY, 100, RCS_SHAREDMEM_CREATE);
            printf("made %d %d, attached %d, zero %d\n", a.created, b.created, a.nattch(),
                   *static_cast<char *>(b.addr));
            strcpy(static_cast<char *>(a.addr), "shared");
            printf("%s\n", static_cast<char *>(b.addr));
        }
        printf("attached %d", a.nattch());
        RCS_SHAREDMEM big(KEY, 100000, RCS_SHAREDMEM_NOCREATE);
        printf(", a bigger one: %s\n", strerror(big.create_errno));
    }
    RCS_SHAREDMEM gone(KEY, 100, RCS_SHAREDMEM_NOCREATE);
    printf("after the last: %s\n", strerror(gone.create_errno));
}

int main() {
    kerf_clock_join("classes-test", KERF_CLOCK_PRIO_TEST);
    lists();
    lists_at_random();
    timers();
    semaphores();
    memory();
    kerf_clock_leave();
    return 0;
}
