/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * handover.c - `motion-handover N`: two processes write commands into motion's shared block as
 * task does, a third one takes them as motion does, and looks whether any is a mixture. Writers
 * are killed now and then in the middle of it.
 */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "emcmotutil.h"
#include "motion.h"

/* Each byte of a command tells its number and writer; only the number itself stands as it is. */
static void fill(emcmot_command_t *c, unsigned char pattern, int number)
{
    memset(c, pattern, sizeof *c);
    c->commandNum = number;
}

static int whole(const emcmot_command_t *c)
{
    emcmot_command_t want;
    fill(&want, ((const unsigned char *)c)[sizeof *c - 1], c->commandNum);
    return memcmp(&want, c, sizeof want) == 0;
}

static pid_t writer(emcmot_struct_t *shared, unsigned char start)
{
    pid_t pid = fork();
    if (pid != 0) return pid;
    emcmot_command_t c;
    for (unsigned char n = start;; n = (unsigned char)(n + 2)) {
        fill(&c, n, 0);
        while (!emcmotCommandTryLockUser(shared, getpid()))
            ;
        c.commandNum = shared->command.commandNum + 1;
        shared->command = c;
        emcmotCommandUnlock(shared);
    }
}

int main(int argc, char **argv)
{
    long commands = argc > 1 ? atol(argv[1]) : 1000000, got = 0, mixed = 0, kills = 0;
    emcmot_struct_t *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return 1;
    pid_t writers[2] = {writer(shared, 0), writer(shared, 1)};
    int last = 0;
    emcmot_command_t c;
    while (got < commands) {
        if (!emcmotCommandTryLock(shared)) continue;
        int fresh = shared->command.commandNum != last;
        if (fresh) c = shared->command;
        emcmotCommandUnlock(shared);
        if (!fresh) continue;
        last = c.commandNum;
        got++;
        if (!whole(&c)) mixed++;
        if (got % (commands / 20 + 1) == 0) {
            int who = (int)(kills++ % 2);
            kill(writers[who], SIGKILL);
            waitpid(writers[who], NULL, 0);
            writers[who] = writer(shared, (unsigned char)who);
        }
    }
    for (int i = 0; i < 2; i++) {
        kill(writers[i], SIGKILL);
        waitpid(writers[i], NULL, 0);
    }
    printf("commands %ld, mixed %ld, writers killed %ld\n", got, mixed, kills);
    return mixed != 0;
}
