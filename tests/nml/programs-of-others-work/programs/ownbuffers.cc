// Two processes with buffers of their own, one serves them over TCP.
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rcs.hh"

// A message of their own.
struct GRIP : RCS_CMD_MSG {
    double force = 0;
    char part[20] = "";
    GRIP() : RCS_CMD_MSG(7001, sizeof(GRIP)) {}
    template <class V, class X> static void fields(V &visit, X &x) {
        visit(nml::Field{"force", "", "N"}, x.force);
        visit(nml::Field{"part", "", "its name"}, x.part);
    }
};
static const nml::MessageSet grips({nml::describe<GRIP>("GRIP")});

static volatile int stop = 0;
static void end(int) { stop = 1; }

int main(int argc, char **argv) {
    if (argc > 1 && !strcmp(argv[1], "serve")) {
        signal(SIGTERM, end);
        NML commands(emcFormat, "robotCmd", "server", "own.nml", 1, 1);
        NML status(emcFormat, "robotSts", "server", "own.nml", 1, 1);
        NML gripper(grips, "gripper", "server", "own.nml", 1, 1);
        if (!commands.valid() || !status.valid() || !gripper.valid()) return 2;
        return run_nml_servers(&stop);
    }
    pid_t server = fork();
    if (!server) {
        execl(argv[0], argv[0], "serve", (char *)NULL);
        _exit(127);
    }
    verbose_nml_error_messages = 0;
    NML *near = NULL;
    for (int i = 0; i < 1000 && !(near = new NML(emcFormat, "robotCmd", "robot", "own.nml"))->valid(); i++) delete near, usleep(10000);
    NML *sent = NULL;
    for (int i = 0; i < 1000 && !(sent = new NML(emcFormat, "robotCmd", "operator", "far.nml"))->valid(); i++) delete sent, usleep(10000);
    EMC_TRAJ_DELAY wait;
    wait.delay = 1.5;
    printf("without a login: %d\n", sent->write(&wait));
    printf("wrong: %d", sent->login("anna", "mud"));
    printf(", error %d", sent->error_type != NML_NO_ERROR || !sent->valid());
    printf(", right: %d", sent->login("anna", "correct-horse"));
    printf(", again: %d\n", sent->reset());
    int serial = 0;
    int result = sent->write(wait, &serial);
    printf("written: %d serial %d, waiting %d\n", result, serial, sent->get_queue_length());
    NMLTYPE type = near->blocking_read(2.0);
    printf("read: %s %g", emc_symbol_lookup(type), ((EMC_TRAJ_DELAY *)near->get_address())->delay);
    type = near->blocking_read(0.05);
    printf(", then %d after a time-out (error %d)\n", type, near->error_type);
    NML out(emcFormat, "robotSts", "robot", "own.nml"), in(emcFormat, "robotSts", "operator", "far.nml");
    in.login("anna", "correct-horse");
    EMC_TASK_STAT s;
    for (int i = 1; i <= 3; i++) {
        s.readLine = i;
        out.write(&s);
    }
    type = in.read();
    printf("status: %d %d", type == EMC_TASK_STAT_TYPE, ((EMC_TASK_STAT *)in.get_address())->readLine);
    printf(", unchanged %d", in.peek());
    printf(", was read %d\n", out.check_if_read());
    NML hand(grips, "gripper", "robot", "own.nml"), far_hand(grips, "gripper", "operator", "far.nml");
    far_hand.login("anna", "correct-horse");
    GRIP grip;
    grip.force = 12.5;
    strcpy(grip.part, "a bolt");
    printf("own message: %d", far_hand.write(&grip));
    type = hand.read();
    printf(" %s %g %s\n", grips.name(type), hand.get<GRIP>()->force, hand.get<GRIP>()->part);
    kill(server, SIGTERM);
    int how;
    waitpid(server, &how, 0);
    printf("server ended %d", WEXITSTATUS(how));
    printf("; then a write: %d", sent->write(&wait));
    printf(", reset %d\n", sent->reset());
    delete sent;
    delete near;
    return 0;
}
