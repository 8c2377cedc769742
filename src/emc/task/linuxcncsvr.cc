// SPDX-License-Identifier: GPL-2.0-or-later
//
// linuxcncsvr.cc - makes the NML buffers, goes into the background, serves them over TCP.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <vector>

#include "emc_args.hh"
#include "inifile.hh"
#include "kerf_clock.h"
#include "messages.hh"
#include "nml_server.hh"
#include "nml_transport.hh"
#include "rcs_print.hh"

static volatile int stop = 0;
static void on_signal(int) { stop = 1; }

// The starting shell goes on when the buffers exist: this is called after that.
static void go_into_background() {
    fflush(nullptr);
    for (int i = 0; i < 2; i++) {
        pid_t pid = fork();
        if (pid < 0) exit(1);
        if (pid > 0) _exit(0);
        if (i == 0) setsid();
    }
    signal(SIGHUP, SIG_IGN);
    int null = open("/dev/null", O_RDONLY);
    if (null >= 0) {
        dup2(null, STDIN_FILENO);
        if (null > 2) close(null);
    }
}

// A stop that nobody needs would be an error, in a running program for instance.
static bool something_jogs(const std::vector<std::unique_ptr<NML>> &channels) {
    auto status = std::find_if(channels.begin(), channels.end(),
                               [](const auto &c) { return c->buffer_name() == "emcStatus"; });
    if (status == channels.end()) return true;
    (*status)->transport()->set_last_id(0); // whatever the clients have read
    if ((*status)->peek() != EMC_STAT_TYPE) return true;
    const EMC_STAT &s = *(*status)->get<EMC_STAT>();
    return s.task.state == EMC_TASK_STATE_ON && s.task.mode == EMC_TASK_MODE_MANUAL && s.motion.jogging_active;
}

int main(int argc, char **argv) {
    EmcArgs args(argc, argv);
    linuxcnc::IniFile ini;
    if (!ini.open(args.ini_file)) return 1;
    uint64_t debug = set_rcs_print(ini);
    if (debug & EMC_DEBUG_CONFIG)
        rcs_print("linuxcncsvr: machine '%s' version '%s'\n", ini.findStringV("MACHINE", "EMC", "<unknown>").c_str(),
                  ini.findStringV("VERSION", "EMC", "unknown").c_str());
    std::string file = ini.findStringV("NML_FILE", "EMC", default_nml_config_file());

    nml::Server server;
    std::vector<std::unique_ptr<NML>> channels;
    std::vector<const char *> names = {"emcCommand", "emcStatus", "emcError"};
    for (const nml::BufferLine &b : nml::buffers_of(file))
        if (b.name == "emcMessages") names.push_back("emcMessages"); // older files have none
    for (const char *name : names) {
        std::unique_ptr<NML> channel;
        for (int tries = 0; tries < 50; tries++) {
            channel = std::make_unique<NML>(emc_messages(), name, "emcsvr", file.c_str());
            if (channel->valid() || channel->status == CMS_CONFIG_ERROR) break; // a wrong file stays wrong
            usleep(200'000); // wall time: what is in the way is another process that ends
        }
        if (!channel->valid()) {
            rcs_print_error("can't make the %s buffer of %s\n", name, file.c_str());
            return 1;
        }
        channels.push_back(std::move(channel));
    }
    go_into_background();
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    signal(SIGPIPE, SIG_IGN);
    std::vector<nml::BufferLine> lines = nml::buffers_of(file);
    for (auto &c : channels)
        for (auto &l : lines)
            if (l.name == c->buffer_name()) server.add(*c, l);
    // A client that has gone holds no jog and no control.
    std::map<int, NML *> in_control;
    std::map<int, std::map<std::pair<int, int>, NML *>> jogs; // of a client: (number, mode)
    auto nobody_jogs = [&](int nr, int jjogmode) { // a jog belongs to the client that began it last
        for (auto c = jogs.begin(); c != jogs.end();) {
            c->second.erase({nr, jjogmode});
            c = c->second.empty() ? jogs.erase(c) : std::next(c);
        }
    };
    server.wrote = [&](int client, NML &channel, const NMLmsg &m) {
        if (m._type == EMC_JOG_CONT_TYPE) {
            const EMC_JOG_CONT &j = static_cast<const EMC_JOG_CONT &>(m);
            nobody_jogs(j.joint_or_axis, j.jjogmode);
            jogs[client][{j.joint_or_axis, j.jjogmode}] = &channel;
        } else if (m._type == EMC_JOG_INCR_TYPE) {
            const EMC_JOG_INCR &j = static_cast<const EMC_JOG_INCR &>(m);
            nobody_jogs(j.joint_or_axis, j.jjogmode);
        } else if (m._type == EMC_TASK_TAKE_CONTROL_TYPE) {
            in_control[client] = &channel;
        } else if (m._type == EMC_TASK_RELEASE_CONTROL_TYPE) {
            in_control.erase(client);
        } else if (m._type == EMC_JOG_STOP_TYPE) {
            const EMC_JOG_STOP &j = static_cast<const EMC_JOG_STOP &>(m);
            nobody_jogs(j.joint_or_axis, j.jjogmode);
        }
    };
    auto end_jogs = [&](int client) {
        for (auto &j : jogs[client]) {
            EMC_JOG_STOP stop_it;
            stop_it.joint_or_axis = j.first.first;
            stop_it.jjogmode = j.first.second;
            if (something_jogs(channels)) j.second->write_raw(stop_it, false, nullptr);
        }
        jogs.erase(client);
    };
    server.holds = [&](int client) { return jogs.count(client) != 0; };
    server.unheard = end_jogs;
    server.gone = [&](int client) {
        end_jogs(client);
        if (auto it = in_control.find(client); it != in_control.end()) {
            EMC_TASK_RELEASE_CONTROL release;
            it->second->write_raw(release, false, nullptr);
            in_control.erase(it);
        }
    };
    server.listen(ini.findStringV("NML_BIND", "EMC", "127.0.0.1"));
    server.run(&stop);
    return 0;
}
