/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * table.cc - the commands, and the one place that counts arguments and dispatches.
 */
#include "commands.hh"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace halcmd
{

const std::vector<Command> &command_table()
{
    // In the order of the names: find_command searches by halves.
    static const std::vector<Command> table = {
        {"addf", 2, -1, 0, do_addf, "FUNCT THREAD [POSITION]", {Arg::Funct, Arg::Thread, Arg::Position},
         "Adds a function to a thread. POSITION 1 is the start of the thread's list, 2 comes after it;\n"
         "-1 (default) is the end, -2 comes before it.\n", false},
        {"alias", 3, 0, 0, do_alias, "pin|param NAME ALIAS", {Arg::AliasKind, Arg::PinOrParam, Arg::None},
         "Gives a pin or parameter a second name. Both names work; listings show the alias.\n", false},
        {"debug", 1, 0, 0, do_debug, "LEVEL", {Arg::Any, Arg::None, Arg::None},
         "Sets the message level of the realtime process, 0 (nothing) to 5 (everything).\n", false},
        {"delf", 0, 2, 0, do_delf, "FUNCT THREAD", {Arg::Funct, Arg::Thread, Arg::None},
         "Takes a function out of a thread.\n", false},
        {"delsig", 1, 0, 0, do_delsig, "SIGNAL|all", {Arg::DelsigName, Arg::None, Arg::None},
         "Unlinks all pins of a signal and deletes it; 'all' deletes every signal.\n", false},
        {"echo", 0, 0, 0, do_echo, "", {Arg::None, Arg::None, Arg::None},
         "Shows each command line on standard error before it is executed.\n", false},
        {"getp", 1, 0, 0, do_getp, "NAME", {Arg::PinOrParam, Arg::None, Arg::None},
         "Prints the value of a pin or parameter.\n", false},
        {"gets", 1, 0, 0, do_gets, "SIGNAL", {Arg::Signal, Arg::None, Arg::None},
         "Prints the value of a signal.\n", false},
        {"graph", 0, -1, TILDE, do_graph, "[FILE [PATTERN...]]", {Arg::File, Arg::Signal, Arg::Signal},
         "Writes a picture (SVG) of components, pins and the signals between them, with present\n"
         "values, to FILE or standard output. Patterns choose signals by name or glob.\n", true},
        {"help", 0, 1, 0, do_help, "[COMMAND]", {Arg::Command, Arg::None, Arg::None},
         "Explains a command, or lists all of them.\n", false},
        {"initf", 2, -1, 0, do_initf, "FUNCT THREAD [POSITION]", {Arg::Funct, Arg::Thread, Arg::Position},
         "Adds a function to the list that a thread runs once, before its first cycle.\n"
         "POSITION is as for addf.\n", false},
        {"linkps", 2, 0, ARROWS, do_linkps, "PIN [ARROW] SIGNAL", {Arg::Pin, Arg::Signal, Arg::Signal},
         "Links a pin to an existing signal. An arrow is decoration.\n", false},
        {"linksp", 2, 0, ARROWS, do_linksp, "SIGNAL [ARROW] PIN", {Arg::Signal, Arg::Pin, Arg::Pin},
         "Links an existing signal to a pin. An arrow is decoration.\n", false},
        {"list", 1, -1, 0, do_list, "TYPE [PATTERN...]", {Arg::ListType, Arg::Any, Arg::Any},
         "Prints the names of items on one line. TYPE: comp, pin, sig, param, funct or thread.\n"
         "A pattern is the beginning of a name or a glob (and2.*.out).\n", false},
        {"loadrt", 1, -1, 0, do_loadrt, "MODULE [KEY=VALUE...]", {Arg::Module, Arg::None, Arg::None},
         "Loads a realtime module.\n", false},
        {"loadusr", 0, -1, TILDE, do_loadusr, "[FLAGS] PROGRAM [ARGUMENT...]", {Arg::Program, Arg::File, Arg::File},
         "Starts a program.\n"
         "  -W       wait until its HAL component is ready\n"
         "  -Wn NAME the same, for a component called NAME (default: the program's name)\n"
         "  -w       wait until the program ends\n"
         "  -i       with -w: do not care how it ended\n", false},
        {"lock", 0, 1, 0, do_lock, "[all|tune|none]", {Arg::LockType, Arg::None, Arg::None},
         "Locks HAL against changes: 'all' (default) everything, 'tune' all but values.\n", false},
        {"net", 1, -1, ARROWS, do_net, "SIGNAL [ARROW] PIN...", {Arg::Signal, Arg::Pin, Arg::Pin},
         "Links pins to a signal, which is created when it does not exist. Arrows (=> <= <=>)\n"
         "are decoration.\n", false},
        {"newsig", 2, 0, 0, do_newsig, "SIGNAL TYPE", {Arg::None, Arg::Type, Arg::None},
         "Creates a signal. TYPE: bit, float, s32, u32, s64, u64 or port.\n", false},
        {"print", 0, 1, 0, do_print, "[WORD]", {Arg::None, Arg::None, Arg::None},
         "Prints a word with file and line on standard error.\n", false},
        {"ptype", 1, 0, 0, do_ptype, "NAME", {Arg::PinOrParam, Arg::None, Arg::None},
         "Prints the type of a pin or parameter.\n", false},
        {"save", 0, 2, TILDE, do_save, "[TYPE [FILE]]", {Arg::SaveType, Arg::File, Arg::None},
         "Prints the present state as commands. TYPE: comp, alias, sig, sigu, link, linka, net,\n"
         "neta, netl, netla, param, thread, unconnectedinpins, all (default) or allu.\n", false},
        {"setexact_for_test_suite_only", 0, 0, 0, do_setexact, "", {Arg::None, Arg::None, Arg::None},
         "Makes HAL claim that the requested base period is met exactly. For tests only: do not\n"
         "use it with a machine.\n", false},
        {"setp", 2, 0, 0, do_setp, "NAME VALUE", {Arg::PinOrParam, Arg::None, Arg::None},
         "Sets a parameter, or a pin that is not an output and not linked.\n"
         "'NAME = VALUE' does the same.\n", false},
        {"sets", 2, 0, 0, do_sets, "SIGNAL VALUE", {Arg::Signal, Arg::None, Arg::None},
         "Sets a signal that no pin writes. For a port: allocates VALUE bytes.\n", false},
        {"show", 0, -1, 0, do_show, "[--json] [TYPE [-tVALUETYPE] [PATTERN...]]", {Arg::ShowType, Arg::Any, Arg::Any},
         "Prints items with their properties. TYPE: all (default), comp, pin, sig, param, funct,\n"
         "thread or alias. A pattern is the beginning of a name or a glob. -tVALUETYPE keeps one\n"
         "type of value (pin, sig, param). --json prints a JSON object instead.\n", false},
        {"source", 1, 0, TILDE, do_source, "FILE", {Arg::File, Arg::None, Arg::None},
         "Executes the commands of a file, up to the first that fails.\n", false},
        {"start", 0, 0, 0, do_start, "", {Arg::None, Arg::None, Arg::None},
         "Lets the realtime threads run.\n", false},
        {"status", 0, 1, 0, do_status, "[all|lock|mem]", {Arg::StatusType, Arg::None, Arg::None},
         "Prints locks and memory use.\n", false},
        {"stop", 0, 0, 0, do_stop, "", {Arg::None, Arg::None, Arg::None},
         "Stops the realtime threads.\n", false},
        {"stype", 1, 0, 0, do_stype, "SIGNAL", {Arg::Signal, Arg::None, Arg::None},
         "Prints the type of a signal.\n", false},
        {"unalias", 2, 0, 0, do_unalias, "pin|param NAME", {Arg::AliasKind, Arg::PinOrParam, Arg::None},
         "Takes the alias of a pin or parameter away.\n", false},
        {"unecho", 0, 0, 0, do_unecho, "", {Arg::None, Arg::None, Arg::None},
         "Ends what 'echo' began.\n", false},
        {"unlinkp", 1, 0, 0, do_unlinkp, "PIN", {Arg::Pin, Arg::None, Arg::None},
         "Unlinks a pin, which keeps its present value.\n", false},
        {"unload", 1, 0, 0, do_unload, "COMPONENT|all", {Arg::Comp, Arg::None, Arg::None},
         "Ends a program or unloads a realtime module; 'all' does so with every one.\n", false},
        {"unloadrt", 1, 0, 0, do_unloadrt, "COMPONENT|all", {Arg::RtComp, Arg::None, Arg::None},
         "Unloads a realtime module, or all, the newest first.\n", false},
        {"unloadusr", 1, 0, 0, do_unloadusr, "COMPONENT|all", {Arg::UserComp, Arg::None, Arg::None},
         "Asks the program of a component, or all, to end; does not wait for it.\n", false},
        {"unlock", 0, 1, 0, do_unlock, "[all|tune|none]", {Arg::LockType, Arg::None, Arg::None},
         "Takes locks away: 'all' (default) every one, 'tune' those that 'lock tune' set.\n", false},
        {"waitusr", 1, 0, 0, do_waitusr, "COMPONENT", {Arg::UserComp, Arg::None, Arg::None},
         "Waits until a program's component is gone.\n", false},
    };
    return table;
}

const Command *find_command(const std::string &name)
{
    auto &table = command_table();
    auto found = std::lower_bound(table.begin(), table.end(), name,
                                  [](const Command &c, const std::string &n) { return n.compare(c.name) > 0; });
    return found != table.end() && name == found->name ? &*found : nullptr;
}

static bool is_arrow(const std::string &word) { return word == "=>" || word == "<=" || word == "<=>"; }

/// The complaint about a wrong number of arguments, "" if it is right.
static std::string count_fault(const Command &command, int given)
{
    if (given < command.required)
        return strf("%s requires %s%d arguments, %d given", command.name, command.optional < 0 ? "at least " : "",
                    command.required, given);
    if (command.optional >= 0 && given > command.required + command.optional)
        return strf("%s requires %s%d arguments, %d given", command.name, command.optional > 0 ? "at most " : "",
                    command.required + command.optional, given);
    return "";
}

int Session::run(const Args &words)
{
    // An empty word ends the list; tokens of a file are never empty.
    Args args(words.begin(), std::find(words.begin(), words.end(), ""));
    if (args.empty()) return 0;
    const Command *command = find_command(args[0]);
    if (!command && args.size() == 3 && args[1] == "=") {
        command = find_command("setp");
        args.erase(args.begin() + 1);
    } else if (command) {
        args.erase(args.begin());
    }
    if (!command) {
        error(strf("Unknown command '%s'", args[0].c_str()));
        return -EINVAL;
    }
    if (command->flags & ARROWS) args.erase(std::remove_if(args.begin(), args.end(), is_arrow), args.end());
    std::string fault = count_fault(*command, static_cast<int>(args.size()));
    if (!fault.empty()) {
        error(fault);
        return -EINVAL;
    }
    if (command->flags & TILDE)
        for (auto &arg : args) arg = tilde_expand(arg);
    sig_atomic_t was_busy = busy;
    busy = 1;
    int r = command->function(*this, args);
    busy = was_busy;
    return r;
}

std::string general_help(bool with_force_release)
{
    std::string text = "\nUsage:   halcmd [options] [command [arguments]]\n"
                       "         halcmd [options] -f [file]\n\n"
                       "Executes HAL commands: the one on the command line, or with -f those of a file\n"
                       "(standard input without a name).\n\n"
                       "Options:\n"
                       "  -e          show each line of a file before it is executed\n"
                       "  -f [file]   read commands from a file or standard input\n"
                       "  -i inifile  with -f: replace [SECTION]VARIABLE by values of this INI file\n"
                       "  -k          keep going after a command has failed\n"
                       "  -q          print errors only (default)\n"
                       "  -Q          print no messages\n"
                       "  -v          tell what was done\n"
                       "  -V          tell everything, for debugging\n"
                       "  -s          output for scripts: no headings, values packed\n";
    if (with_force_release) text += "  -R          release the HAL mutex by force (after a crash)\n";
    text += "  -C          print completions of the command line, for shells\n"
            "  -h [command] print this help, or that of a command\n\n"
            "Commands:\n";
    size_t column = 0;
    for (auto &c : command_table()) {
        if (column + 12 > 78) {
            text += "\n";
            column = 0;
        }
        std::string cell = strf("  %-10s", c.name);
        text += cell;
        column += cell.size();
    }
    return text + "\n\n'halcmd help COMMAND' explains a command.\n";
}

int do_help(Session &s, const Args &args)
{
    if (args.empty()) {
        s.console(general_help(false));
    } else if (args[0] == "help") {
        s.console("If you need help to use 'help', then I can't help you.\n");
    } else if (auto *c = find_command(args[0])) {
        s.console(strf("%s%s%s\n%s", c->name, *c->synopsis ? " " : "", c->synopsis, c->help));
    } else if (args[0] == "quit" || args[0] == "exit") {
        s.console(args[0] + "\nStops reading commands.\n");
    } else {
        s.console(strf("No help for unknown command '%s'\n", args[0].c_str()));
    }
    return 0;
}

} // namespace halcmd
