/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_tcl.cc - Tcl package Hal: the commands `hal` and `hal_stream`.
 *
 *   hal CMD ?args?    a command of halcmd; its output is the result, its complaint the error
 *   hal --commands    names of all commands
 *   hal --leave       gives back the component; the next command takes a new one
 *   hal_stream ...    reads and inspects HAL streams (attach depth maxdepth readable read drain detach)
 *
 * Thread: [task], one session per interpreter. Source: HAL tools reference, section 4.
 */
#include "../halcmd/commands.hh"

#include "hal.h"
#include "kerf_clock.h"
#include "rtapi.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <tcl.h>

using namespace halcmd;

namespace
{

/// Collects texts for the result of a Tcl command.
class TclChannels : public Channels
{
  public:
    void error(const Place &, const std::string &text) override
    {
        if (!errors.empty()) errors += "\n";
        errors += text;
    }
    void warning(const Place &, const std::string &text) override { result += text + "\n"; }
    void info(const Place &, const std::string &text) override { result += text; }
    void print(const Place &, const std::string &text) override { result += text; }
    void output(const std::string &text) override { result += text; }
    void console(const std::string &text) override { fwrite(text.data(), 1, text.size(), stdout); }

    void clear()
    {
        errors.clear();
        result.clear();
    }
    std::string errors, result;
};

constexpr int STREAMS = 16;

struct Stream {
    bool used = false;
    hal_stream_t stream = {};
};

/// What belongs to one interpreter.
struct State {
    Session session;
    TclChannels channels;
    std::array<Stream, STREAMS> streams;
    bool joined = false;

    ~State()
    {
        for (auto &s : streams)
            if (s.used) hal_stream_detach(&s.stream);
        session.leave();
        if (joined) kerf_clock_leave();
    }
};

int fail(Tcl_Interp *interp, const std::string &text)
{
    Tcl_SetObjResult(interp, Tcl_NewStringObj(text.data(), static_cast<int>(text.size())));
    return TCL_ERROR;
}

int command_names(Tcl_Interp *interp)
{
    Tcl_Obj *list = Tcl_NewListObj(0, nullptr);
    for (auto &c : command_table())
        Tcl_ListObjAppendElement(interp, list, Tcl_NewStringObj(c.name, -1));
    Tcl_SetObjResult(interp, list);
    return TCL_OK;
}

/// `hal --join NAME`: the script takes its turn in virtual time (haltcl does this).
int join_clock(State &state, const char *name)
{
    kerf_clock_join(name, KERF_CLOCK_PRIO_USER);
    state.joined = kerf_clock_joined() != 0;
    return TCL_OK;
}

int hal_command(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    auto &state = *static_cast<State *>(data);
    if (argc < 2) {
        Tcl_WrongNumArgs(interp, 1, argv, "command ...");
        return TCL_ERROR;
    }
    const std::string first = Tcl_GetString(argv[1]);
    if (argc == 2 && first == "--commands") return command_names(interp);
    if (argc == 2 && first == "--leave") {
        state.session.leave();
        return TCL_OK;
    }
    if (argc == 3 && first == "--join") return join_clock(state, Tcl_GetString(argv[2]));
    if (argc == 2 && first == "--lend") { // to a program that the script waits for; empty: nothing to lend
        char place[KERF_CLOCK_SLOT_LEN] = "";
        if (state.joined && kerf_clock_lend(place, sizeof place) != 0) place[0] = 0;
        Tcl_SetObjResult(interp, Tcl_NewStringObj(place, -1));
        return TCL_OK;
    }
    if (argc == 2 && first == "--reclaim") {
        kerf_clock_reclaim();
        return TCL_OK;
    }
    if (argc == 3 && first == "--sleep") {
        Tcl_WideInt ms;
        if (Tcl_GetWideIntFromObj(interp, argv[2], &ms) != TCL_OK) return TCL_ERROR;
        kerf_clock_sleep_ns(ms * 1000000);
        return TCL_OK;
    }
    Args args;
    for (int i = 1; i < argc; i++) args.emplace_back(Tcl_GetString(argv[i]));
    state.channels.clear();
    int r = state.session.attach();
    if (r == 0) r = state.session.run(args);
    if (r != 0)
        return fail(interp, state.channels.errors.empty() ? strerror(r < 0 ? -r : r) : state.channels.errors);
    std::string &text = state.channels.result;
    if (!text.empty() && text.back() == '\n') text.pop_back();
    Tcl_SetObjResult(interp, Tcl_NewStringObj(text.data(), static_cast<int>(text.size())));
    return TCL_OK;
}

/* ---- Streams ---- */

int attach_stream(State &state, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    if (argc != 4) return fail(interp, "args: attach KEY TYPESTRING");
    int key;
    if (Tcl_GetIntFromObj(nullptr, argv[2], &key) != TCL_OK)
        return fail(interp, strf("bad key: %s", Tcl_GetString(argv[2])));
    for (int i = 0; i < STREAMS; i++) {
        Stream &s = state.streams[i];
        if (s.used) continue;
        int r = state.session.attach();
        if (r == 0) r = hal_stream_attach(&s.stream, state.session.component(), key, Tcl_GetString(argv[3]));
        if (r != 0) return fail(interp, strf("hal_stream_attach: %s", strerror(-r)));
        s.used = true;
        Tcl_SetObjResult(interp, Tcl_NewIntObj(i));
        return TCL_OK;
    }
    return fail(interp, "no free hal_stream slots");
}

/// Appends one record to the list; false when the stream is empty.
bool read_record(hal_stream_t *stream, Tcl_Obj *list)
{
    hal_stream_data_u record[HAL_STREAM_MAX_PINS];
    if (!hal_stream_readable(stream) || hal_stream_read(stream, record, nullptr) != 0) return false;
    int n = hal_stream_element_count(stream);
    for (int i = 0; i < n; i++) {
        Tcl_Obj *value;
        switch (hal_stream_element_type(stream, i)) {
        case HAL_BIT: value = Tcl_NewIntObj(record[i].b ? 1 : 0); break;
        case HAL_FLOAT: value = Tcl_NewStringObj(strf("%g", record[i].f).c_str(), -1); break;
        case HAL_S32: value = Tcl_NewWideIntObj(record[i].s); break;
        case HAL_U32: value = Tcl_NewWideIntObj(record[i].u); break;
        case HAL_S64: value = Tcl_NewWideIntObj(record[i].l); break;
        default: value = Tcl_NewStringObj(strf("%llu", static_cast<unsigned long long>(record[i].k)).c_str(), -1);
        }
        Tcl_ListObjAppendElement(nullptr, list, value);
    }
    return true;
}

int hal_stream_command(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    auto &state = *static_cast<State *>(data);
    if (argc < 2) return fail(interp, "wrong # args: should be \"hal_stream subcommand ?args?\"");
    const std::string sub = Tcl_GetString(argv[1]);
    if (sub == "attach") return attach_stream(state, interp, argc, argv);
    if (argc != 3) return fail(interp, strf("args: %s HANDLE", sub.c_str()));
    int handle;
    if (Tcl_GetIntFromObj(nullptr, argv[2], &handle) != TCL_OK || handle < 0 || handle >= STREAMS ||
        !state.streams[handle].used)
        return fail(interp, strf("bad hal_stream handle: %s", Tcl_GetString(argv[2])));
    Stream &s = state.streams[handle];
    if (sub == "depth") {
        Tcl_SetObjResult(interp, Tcl_NewIntObj(hal_stream_depth(&s.stream)));
    } else if (sub == "maxdepth") {
        Tcl_SetObjResult(interp, Tcl_NewWideIntObj(hal_stream_maxdepth(&s.stream)));
    } else if (sub == "readable") {
        Tcl_SetObjResult(interp, Tcl_NewIntObj(hal_stream_readable(&s.stream) ? 1 : 0));
    } else if (sub == "read" || sub == "drain") {
        Tcl_Obj *list = Tcl_NewListObj(0, nullptr);
        while (read_record(&s.stream, list) && sub == "drain") {}
        Tcl_SetObjResult(interp, list);
    } else if (sub == "detach") {
        hal_stream_detach(&s.stream);
        s = Stream();
    } else {
        return fail(interp, strf("unknown hal_stream subcommand: %s", sub.c_str()));
    }
    return TCL_OK;
}

void destroy(ClientData data) { delete static_cast<State *>(data); }

} // namespace

extern "C" int Hal_Init(Tcl_Interp *interp)
{
    if (!Tcl_InitStubs(interp, "8.6", 0)) return TCL_ERROR;
    auto *state = new State;
    state->session.channels = &state->channels;
    if (int r = state->session.attach()) {
        delete state;
        return fail(interp, strf("hal_init() failed: %d", r));
    }
    Tcl_CreateObjCommand(interp, "hal", hal_command, state, nullptr);
    Tcl_CreateObjCommand(interp, "hal_stream", hal_stream_command, state, nullptr);
    Tcl_CreateExitHandler(destroy, state);
    return Tcl_PkgProvide(interp, "Hal", "1.0");
}
