/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rs274_main.cc - rs274: interprets a program or typed lines, prints canonical calls.
 *
 * Source: canonical sheet, section 3
 */
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <memory>

#include <getopt.h>
#include <unistd.h>

#include "config.h"
#ifdef HAVE_READLINE
#include <readline/history.h>
#include <readline/readline.h>
#endif

#include "check_program.hh"
#include "inifile.hh"
#include "interp.hh"
#include "printer.hh"
#include "tooldata.h"

namespace
{

enum OnError { CONTINUE = 0, MDI = 1, STOP = 2 };

struct Options {
    std::string tool_file, var_file = "/etc/emc2/sample-configs/sim/sim.var", ini_file, plugin;
    int on_error = STOP;
    bool block_delete = false, print_stack = false, go = false, task = false;
    bool check = false, json = false, var_given = false;
    int log_level = -1;
    std::string input, output;
    bool have_input = false, have_output = false;
    int argc = 1;
};

struct Session {
    Options o;
    CanonPrinter canon;
    std::unique_ptr<Interp> interp;
};

void usage(const char *name)
{
    fprintf(stderr,
            "Usage: %s [-p interp.so] [-t tool.tbl] [-v var-file.var] [-n 0|1|2]\n"
            "          [-b] [-s] [-g] [input file [output file]]\n"
            "\n"
            "    -p: Specify the pluggable interpreter to use\n"
            "    -t: Specify the .tbl (tool table) file to use\n"
            "    -v: Specify the .var (parameter) file to use\n"
            "    -n: Specify the continue mode:\n"
            "           0: continue\n"
            "           1: enter MDI mode\n"
            "           2: stop (default)\n"
            "    -b: Toggle the 'block delete' flag (default: OFF)\n"
            "    -s: Toggle the 'print stack' flag (default: OFF)\n"
            "    -g: Toggle the 'go (batch mode)' flag (default: OFF)\n"
            "    -i: specify the .ini file (default: no ini file)\n"
            "    -T: call task_init()\n"
            "    -l: specify the log_level (default: -1)\n"
            "    --check: report every error and suspicious line of the program\n"
            "    --json: with --check: as JSON\n",
            name);
}

void report_error(Session &s, int code)
{
    s.canon.flush();
    if (!s.o.plugin.empty() && code == INTERP_ERROR) { // its languages have no documented form of this
        fputs(s.interp->fault().report().c_str(), stderr);
        return;
    }
    const char *text = s.interp->error_text(code);
    fprintf(stderr, "%s\n%s\n", *text ? text : "Unknown error, bad error code", s.interp->line_text());
    if (!s.o.print_stack) return;
    for (int i = 0; *s.interp->stack_name(i); ++i) fprintf(stderr, "%s\n", s.interp->stack_name(i));
}

// ---- interactive ---------------------------------------------------------------

// One line from the terminal or from standard input; false at the end.
bool get_line(std::string *line)
{
#ifdef HAVE_READLINE
    if (isatty(0)) {
        char *text = readline("READ => ");
        if (!text) return false;
        *line = text;
        free(text);
        if (!line->empty()) add_history(line->c_str());
        return true;
    }
#endif
    if (isatty(0)) { // nobody reads a prompt elsewhere, and calls are all that pipes expect
        fputs("READ => ", stdout);
        fflush(stdout);
    }
    char *text = nullptr;
    size_t room = 0;
    ssize_t n = getline(&text, &room, stdin);
    if (n >= 0) {
        while (n > 0 && text[n - 1] == '\n') --n;
        line->assign(text, size_t(n));
    }
    free(text);
    return n >= 0;
}

#ifdef HAVE_READLINE
std::string history_file()
{
    if (const char *name = getenv("RS274_HISTORY"))
        return linuxcnc::IniFile::tildeExpand(name).value_or(name);
    return linuxcnc::IniFile::tildeExpand("~/.rs274").value_or("");
}
#endif

// Reads and executes lines of a person until "quit" or the end of the input.
int run_interactive(Session &s)
{
#ifdef HAVE_READLINE
    const std::string history = history_file();
    if (isatty(0)) read_history(history.c_str());
#endif
    std::string line;
    for (;;) {
        s.canon.flush();
        if (!get_line(&line) || line == "quit") break;
        int status = s.interp->read(line.c_str());
        if (status <= INTERP_MIN_ERROR) status = s.interp->execute();
        if (status > INTERP_MIN_ERROR) report_error(s, status);
    }
#ifdef HAVE_READLINE
    if (isatty(0)) write_history(history.c_str());
#endif
    return 0;
}

// ---- a program -------------------------------------------------------------------

enum Verdict { GO_ON, GIVE_UP };

// What is done after an error, by -n.
Verdict after_error(Session &s, int status)
{
    report_error(s, status);
    if (s.o.on_error == CONTINUE) return GO_ON;
    if (s.o.on_error == STOP) return GIVE_UP;
    fprintf(stderr, "starting MDI\n");
    run_interactive(s);
    fprintf(stderr, "continue program? y/n =>");
    char reply[256];
    if (!fgets(reply, sizeof reply, stdin) || reply[0] != 'y') return GIVE_UP;
    return GO_ON;
}

int run_program(Session &s, bool *opened)
{
    s.canon.SET_BLOCK_DELETE(s.o.block_delete);
    int status = s.interp->open(s.o.input.c_str());
    *opened = status == INTERP_OK;
    if (!*opened) {
        report_error(s, status);
        return 1;
    }
    for (;;) {
        status = s.interp->read();
        if (status == INTERP_ENDFILE) return 0;
        if (status == INTERP_OK || status == INTERP_EXECUTE_FINISH) {
            status = s.interp->execute();
            if (status == INTERP_EXIT || status == INTERP_ENDFILE) return 0;
        }
        if (status > INTERP_MIN_ERROR && after_error(s, status) == GIVE_UP) return 1;
    }
}

// ---- the menus --------------------------------------------------------------------

bool ask_number(int *number)
{
    char text[256];
    if (!fgets(text, sizeof text, stdin)) return false;
    *number = atoi(text);
    return true;
}

void error_menu(Session &s)
{
    Options &o = s.o;
    for (;;) {
        fprintf(stderr, "enter a number:\n1 = done with error handling\n2 = %sprint stack on error\n",
                o.print_stack ? "do not " : "");
        if (o.argc == 3)
            fprintf(stderr, "3 = %s\n",
                    o.on_error == CONTINUE ? "stop on error (do not continue)" : "continue on error (do not stop)");
        else if (o.argc == 2)
            fprintf(stderr, "3 = %s\n",
                    o.on_error == CONTINUE ? "mdi on error (do not continue or stop)"
                    : o.on_error == MDI    ? "stop on error (do not mdi or continue)"
                                           : "continue on error (do not stop or mdi)");
        fprintf(stderr, "enter choice => ");
        int choice;
        if (!ask_number(&choice) || choice == 1) return;
        if (choice == 2) o.print_stack = !o.print_stack;
        if (choice == 3 && o.argc == 3) o.on_error = o.on_error == CONTINUE ? STOP : CONTINUE;
        if (choice == 3 && o.argc == 2)
            o.on_error = o.on_error == CONTINUE ? MDI : o.on_error == MDI ? STOP : CONTINUE;
    }
}

bool ask_name(const char *prompt, std::string *name)
{
    char text[1024];
    fputs(prompt, stderr);
    if (!fgets(text, sizeof text, stdin)) return false;
    text[strcspn(text, "\n")] = 0;
    *name = text;
    return true;
}

// 0, or the exit status.
int main_menu(Session &s)
{
    Options &o = s.o;
    for (;;) {
        fprintf(stderr,
                "enter a number:\n1 = start interpreting\n2 = choose parameter file ...\n3 = read tool file ...\n"
                "4 = turn block delete switch %s\n5 = adjust error handling...\nenter choice => ",
                o.block_delete ? "OFF" : "ON");
        int choice;
        if (!ask_number(&choice) || choice == 1) return 0;
        if (choice == 2) {
            if (!ask_name("name of parameter file => ", &o.var_file)) return 0;
            if (access(o.var_file.c_str(), R_OK) != 0) {
                fprintf(stderr, "Cannot open %s\n", o.var_file.c_str());
                return 1;
            }
        } else if (choice == 3) {
            if (!ask_name("name of tool file => ", &o.tool_file)) return 0;
            if (tooldata_load(o.tool_file.c_str()) != 0) return 1;
        } else if (choice == 4) {
            o.block_delete = !o.block_delete;
        } else if (choice == 5) {
            error_menu(s);
        }
    }
}

// ---- start -------------------------------------------------------------------------

// rs274 --check [--json] [-i ini] [-t tools] [-v parameters] program: 0 when there is no error.
int check(const Options &o)
{
    CheckOptions c;
    c.interp.ini_file = o.ini_file;
    c.interp.task = o.task;
    c.tool_file = o.tool_file;
    if (o.var_given) c.parameter_file = o.var_file;
    if (!o.have_input) {
        fprintf(stderr, "rs274 --check: name the program\n");
        return 1;
    }
    const std::vector<Finding> findings = check_program(o.input, c);
    int errors = 0;
    for (const Finding &f : findings) errors += f.severity == Finding::ERROR;
    if (o.json) {
        fputs(findings_as_json(findings).c_str(), stdout);
    } else {
        for (const Finding &f : findings) {
            Fault shown = f.fault;
            shown.what = (f.severity == Finding::ERROR ? "error: " : "warning: ") + shown.what;
            fputs(shown.report().c_str(), stdout);
        }
        printf("%s: %d error%s, %d warning%s\n", o.input.c_str(), errors, errors == 1 ? "" : "s",
               int(findings.size()) - errors, int(findings.size()) - errors == 1 ? "" : "s");
    }
    return errors ? 1 : 0;
}

// False: usage has been printed.
bool read_options(int argc, char **argv, Options &o, bool *tool_given)
{
    static const struct option longer[] = {{"check", no_argument, nullptr, 1000},
                                           {"json", no_argument, nullptr, 1001},
                                           {nullptr, 0, nullptr, 0}};
    int c;
    while ((c = getopt_long(argc, argv, "p:t:v:bsn:gi:l:T", longer, nullptr)) != -1) {
        switch (c) {
        case 1000: o.check = true; break;
        case 1001: o.json = true; break;
        case 'p': o.plugin = optarg; break;
        case 't':
            o.tool_file = optarg;
            *tool_given = true;
            break;
        case 'v':
            o.var_given = true;
            o.var_file = std::string(optarg).substr(0, PARAMETER_FILE_NAME_LENGTH - 1);
            break;
        case 'b': o.block_delete = !o.block_delete; break;
        case 's': o.print_stack = !o.print_stack; break;
        case 'n': o.on_error = atoi(optarg); break;
        case 'g': o.go = !o.go; break;
        case 'i': o.ini_file = optarg; break;
        case 'l': o.log_level = atoi(optarg); break;
        case 'T': o.task = true; break;
        default: usage(argv[0]); return false;
        }
    }
    const int names = argc - optind;
    if (names > 3) {
        usage(argv[0]);
        return false;
    }
    o.argc = argc;
    if (names >= 1) {
        o.input = argv[optind];
        o.have_input = true;
    }
    if (names == 2) {
        o.output = argv[optind + 1];
        o.have_output = true;
    }
    return true;
}

// Tool data in a file of our own, gone with this process.
void make_tool_store()
{
    const char *dir = getenv("TMPDIR");
    std::string name = std::string(dir && *dir ? dir : "/tmp") + "/rs274.tool.mmap.XXXXXX";
    const int fd = mkstemp(name.data());
    if (fd >= 0) close(fd);
    tool_mmap_set_fname(name.c_str());
    if (tool_mmap_creator(nullptr, 0) == 0) unlink(name.c_str());
}

// What is in the spindle and in the table when no file is named.
void default_tools()
{
    static const char *const lines[] = {"T1 P1 Z0.511 D0.125 ;1/8 end mill", "T2 P2 Z0.1 D0.0625 ;1/16 end mill",
                                        "T3 P3 Z1.273 D0.201 ;no. 7 tap drill"};
    tooldata_reset();
    tooldata_add_init(1);
    for (const char *line : lines) tooldata_read_entry(line);
}

std::unique_ptr<Interp> interpreter(const std::string &plugin, Canon &canon)
{
    std::string why;
    std::unique_ptr<Interp> made = make_interpreter(plugin, canon, &why);
    if (!made) fprintf(stderr, "emcTaskInit: %s\n", why.c_str());
    else if (!plugin.empty())
        fprintf(stderr, "emcTaskInit: using custom interpreter '%s'\n", interpreter_path(plugin).c_str());
    return made ? std::move(made) : std::make_unique<Interp>(canon);
}

// Machine units from the INI; false when it cannot be read.
bool use_ini(Session &s)
{
    unsetenv("INI_FILE_NAME");
    if (s.o.ini_file.empty()) return true;
    linuxcnc::IniFile ini;
    if (!ini.open(s.o.ini_file)) {
        fprintf(stderr, "could not open supplied INI file %s\n", s.o.ini_file.c_str());
        return false;
    }
    setenv("INI_FILE_NAME", s.o.ini_file.c_str(), 1);
    if (ini.findStringV("LINEAR_UNITS", "TRAJ", "") == "mm") s.canon.set_machine_units(1.0);
    return true;
}

int run(int argc, char **argv)
{
    Session s;
    bool tools_given = false;
    if (!read_options(argc, argv, s.o, &tools_given)) return 1;
    if (s.o.check) return check(s.o);
    make_tool_store();
    if (tools_given) tooldata_load(s.o.tool_file.c_str());
    if (!s.o.go)
        if (const int status = main_menu(s)) return status;
    fprintf(stderr, "executing\n");
    if (s.o.tool_file.empty()) default_tools();
    FILE *output = stdout;
    if (s.o.have_output) {
        output = fopen(s.o.output.c_str(), "we");
        if (!output) {
            fprintf(stderr, "could not open output file %s\n", s.o.output.c_str());
            return 1;
        }
        s.canon.set_output(output);
    }
    if (!use_ini(s)) return 1;
    s.canon.set_parameter_file(s.o.var_file);
    s.interp = interpreter(s.o.plugin, s.canon);
    s.canon.set_line_text(s.interp->line_text());
    InterpOptions options = InterpOptions::from_environment();
    options.task = s.o.task;
    int status = s.interp->init(options);
    if (status != INTERP_OK) {
        report_error(s, status);
        return 1;
    }
    if (s.o.log_level != -1) s.interp->set_log_level(s.o.log_level);
    bool opened = true;
    if (s.o.have_input) {
        status = run_program(s, &opened);
        if (opened) s.interp->close();
    } else {
        status = run_interactive(s);
    }
    if (opened) s.interp->exit();
    s.canon.flush();
    s.canon.set_line_text(nullptr);
    if (output != stdout) {
        s.canon.set_output(stdout);
        fclose(output);
    }
    return status;
}

} // namespace

int main(int argc, char **argv)
{
    const int status = run(argc, argv);
    tool_mmap_close();
    return status;
}
