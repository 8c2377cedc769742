/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * commands.hh - the table of commands: name, arguments, help, function.
 *
 * Every function takes the words after the command's name, already counted against
 * the table, and returns 0 or a negative errno after telling why. [task]
 */
#ifndef KERF_HALCMD_COMMANDS_HH
#define KERF_HALCMD_COMMANDS_HH

#include "session.hh"

namespace halcmd
{

/// What completion offers for an argument; see complete.cc.
enum class Arg { None, Command, Pin, Param, PinOrParam, Signal, Funct, Thread, Comp, UserComp, RtComp, Module, Program,
                 File, Type, ShowType, ListType, SaveType, StatusType, LockType, AliasKind, DelsigName, Position, Any };

struct Command {
    const char *name;
    int required, optional;   ///< words after the name; optional < 0: any number more
    unsigned flags;           ///< ARROWS, TILDE
    int (*function)(Session &, const Args &);
    const char *synopsis;     ///< words after the name, for people
    Arg args[3];              ///< what the words are; the last one stands for all that follow
    const char *help;
    bool addition;            ///< ours: not a command of the reference
};
enum : unsigned {
    ARROWS = 1, ///< => <= <=> are dropped from the arguments
    TILDE = 2   ///< a leading ~/ of an argument is expanded
};

const std::vector<Command> &command_table(); ///< sorted by name
const Command *find_command(const std::string &name);

// Configuration (config.cc)
int do_addf(Session &, const Args &);
int do_initf(Session &, const Args &);
int do_delf(Session &, const Args &);
int do_alias(Session &, const Args &);
int do_unalias(Session &, const Args &);
int do_newsig(Session &, const Args &);
int do_delsig(Session &, const Args &);
int do_linkps(Session &, const Args &);
int do_linksp(Session &, const Args &);
int do_unlinkp(Session &, const Args &);
int do_net(Session &, const Args &);
int do_setp(Session &, const Args &);
int do_sets(Session &, const Args &);
int do_getp(Session &, const Args &);
int do_gets(Session &, const Args &);
int do_ptype(Session &, const Args &);
int do_stype(Session &, const Args &);
int do_start(Session &, const Args &);
int do_stop(Session &, const Args &);
int do_lock(Session &, const Args &);
int do_unlock(Session &, const Args &);
int do_setexact(Session &, const Args &);
int do_echo(Session &, const Args &);
int do_unecho(Session &, const Args &);
int do_print(Session &, const Args &);
int do_source(Session &, const Args &);

// Programs and modules (load.cc)
int do_loadrt(Session &, const Args &);
int do_loadusr(Session &, const Args &);
int do_unload(Session &, const Args &);
int do_unloadrt(Session &, const Args &);
int do_unloadusr(Session &, const Args &);
int do_waitusr(Session &, const Args &);
int do_debug(Session &, const Args &);

// Looking (show.cc, save.cc, json.cc, graph.cc)
int do_show(Session &, const Args &);
int do_list(Session &, const Args &);
int do_status(Session &, const Args &);
int do_save(Session &, const Args &);
int do_graph(Session &, const Args &);
int show_json(Session &, const Args &); ///< args: [type [pattern...]]

int do_help(Session &, const Args &);
/// The help of the program: usage, options and the list of commands.
std::string general_help(bool with_force_release);

} // namespace halcmd

#endif
