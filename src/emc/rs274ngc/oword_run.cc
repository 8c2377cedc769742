/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * oword_run.cc - subs, calls, branches and loops.
 *
 * In:     s.block of an O line
 * Out:    place of the next line, call stack, s.skipping
 * Thread: [task]
 * Source: O-word sheet, sections 2 to 7
 *
 * Invariants: s.skipping names the label that ends the skipping; skipping_to_sub says
 * that it is a sub called but not yet reached; s.defining is the sub whose body is
 * being skipped because it is only defined.
 */
#include "python_link.hh"
#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

const char *type_name(OWord type)
{
    static const char *const names[] = {"none", "sub",      "endsub",   "call",   "do",        "while",  "if",
                                        "elseif", "else",   "endif",    "break",  "continue",  "endwhile",
                                        "repeat", "endrepeat", "return", "O_",    "M98",       "M99"};
    return names[type];
}

// The label checks become warnings on request.
#define FLOW_FAIL(...) \
    do { \
        if (!s.oword_warn_only) return s.fail(__func__, __VA_ARGS__); \
        fprintf(stderr, __VA_ARGS__); \
        fputc('\n', stderr); \
        return INTERP_OK; \
    } while (0)

Label &add_label(Setup &s, OWord type)
{
    Label &l = s.labels.at(s.block.o_name);
    l = Label();
    l.type = type;
    l.source = s.source;
    l.offset = s.line_offset;
    l.after = s.after_offset;
    l.line = s.sequence_number;
    return l;
}

void go_to(Setup &s, int source, int64_t offset, int line)
{
    s.source = source;
    if (source < 0) return;
    s.sources[size_t(source)]->seek(offset);
    s.sources[size_t(source)]->line_number = line;
    s.sequence_number = line;
}

void skip_to(Setup &s, const std::string &label)
{
    s.skipping = label;
    s.skipping_line = s.sequence_number;
}

void stop_skipping(Setup &s)
{
    s.skipping.clear();
    s.skipping_to_sub = false;
}

const char *current_file(const Setup &s)
{
    return s.source >= 0 ? s.sources[size_t(s.source)]->path().c_str() : "";
}

const char *file_of(const Setup &s, const Label &l)
{
    return l.source >= 0 ? s.sources[size_t(l.source)]->path().c_str() : "";
}

// ---- subs --------------------------------------------------------------------------

int run_sub(Setup &s)
{
    const Block &b = s.block;
    const bool program = b.o_type == O_PROGRAM;
    if (s.skipping_to_sub) {
        // Reached what was called; or something else on the way.
        std::string_view wanted = s.skipping;
        if (b.o_name != wanted) return INTERP_OK;
        const CallType type = s.frame().type;
        CHECK(program && type != CALL_M98, "Fanuc 'O....' subroutine must be called with 'M98'");
        CHECK(!program && type == CALL_M98, "'O.... sub' subroutine must be called with 'O.... call'");
        const Label *known = s.labels.find(b.o_name);
        if (!known || known->source < 0) add_label(s, b.o_type);
        stop_skipping(s);
        return INTERP_OK;
    }
    if (!s.skipping.empty()) {
        CHECK(!s.defining.empty(), "Nested subroutine definition");
        return INTERP_OK;
    }
    if (program) { // a program number
        CHECK(s.frame().type == CALL_NGC, "Fanuc 'O....' subroutine must be called with 'M98'");
        return INTERP_OK;
    }
    CHECK(s.call_level > 0, "Nested subroutine definition: 'O%s sub' found inside called subroutine 'O%s'",
          b.o_name.c_str(), s.frame().sub.c_str());
    if (const Label *known = s.labels.find(b.o_name)) {
        CHECK(known->source == s.source && known->offset == s.line_offset,
              "File:%s line:%d sub: o|%s| found in illegal location", current_file(s), s.sequence_number,
              b.o_name.c_str());
        FAIL("File:%s line:%d redefining sub: o|%s| already defined in file:%s", current_file(s), s.sequence_number,
             b.o_name.c_str(), file_of(s, *known));
    }
    add_label(s, O_SUB);
    s.defining = b.o_name;
    skip_to(s, b.o_name);
    return INTERP_OK;
}

void take_return_value(Setup &s)
{
    s.value_returned = s.block.params > 0;
    s.return_value = s.value_returned ? s.block.param[0] : 0;
}

int run_endsub(Setup &s)
{
    if (!s.defining.empty()) {
        if (s.block.o_name != s.defining) return INTERP_OK;
        take_return_value(s);
        s.defining.clear();
        stop_skipping(s);
        return INTERP_OK;
    }
    CHECK(s.call_level == 0, "Not in subroutine definition");
    CHECK(s.frame().type == CALL_M98, "Fanuc 'O....' subroutine definition must end with 'M99'");
    take_return_value(s);
    return run_return(s);
}

int run_return_word(Setup &s)
{
    if (!s.defining.empty()) return INTERP_OK;
    if (s.call_level == 0) FLOW_FAIL("%d: not in a subroutine definition: '%s'", s.sequence_number, s.raw);
    CHECK(s.frame().type == CALL_M98, "Fanuc 'O....' subroutine definition must end with 'M99'");
    take_return_value(s);
    return run_return(s);
}

std::string last_component(const std::string &name)
{
    const size_t slash = name.rfind('/');
    return slash == name.npos ? name : name.substr(slash + 1);
}

// Level of its own for a call; the caller continues behind its line.
int enter(Setup &s, CallType type, const std::string &name)
{
    const bool saves = type == CALL_NGC || type == CALL_REMAP;
    CHECK(s.call_level + 1 >= MAX_CALL_LEVELS, "Too many subroutine levels");
    Frame &caller = s.frame();
    if (s.logs(1, type == CALL_REMAP ? LOG_REMAP : LOG_OWORD))
        s.log("call %s, level %d", name.c_str(), s.call_level + 1);
    caller.source = s.source;
    caller.offset = s.after_offset;
    caller.line = s.sequence_number;
    Frame &f = s.frames[++s.call_level];
    f.type = type;
    f.sub = name;
    f.locals.clear();
    f.modes.valid = f.modes.restore_on_return = false;
    if (saves) {
        memcpy(f.saved_arguments, s.parameters.data(), sizeof f.saved_arguments);
        for (int i = 1; i <= SUB_ARGUMENTS; ++i)
            s.parameters[size_t(i)] = i <= s.block.params ? s.block.param[i - 1] : 0;
        if (s.oword_nargs) {
            NamedParameter &n = f.locals.at("n_args");
            n.value = s.block.params;
            n.read_only = true;
        }
    }
    return INTERP_OK;
}

// Where the sub stands: the labels, a file, or later in this file.
int go_to_sub(Setup &s, const std::string &name)
{
    const std::string short_name = last_component(name);
    const Label *known = s.labels.find(short_name);
    if (known && known->source >= 0 && is_current(s, known->source)) {
        go_to(s, known->source, known->offset, known->line - 1);
    } else {
        const std::string path = find_sub_file(s, name);
        if (!path.empty()) {
            const int source = open_source(s, path);
            CHECK(source < 0, "Unable to open file <%s>", path.c_str());
            go_to(s, source, 0, 0);
        } else {
            const Frame &caller = s.frames[s.call_level - 1];
            CHECK(caller.source != 0 || s.mdi,
                  "Subroutine 'O%s' not found -- not in offset table and no file '%s.ngc' found", name.c_str(),
                  name.c_str());
        }
    }
    s.skipping = short_name;
    s.skipping_to_sub = true;
    s.skipping_line = s.frames[s.call_level - 1].line;
    return INTERP_OK;
}

int run_m99(Setup &s)
{
    CHECK(s.frame().type == CALL_NGC, "'O.... endsub' or 'O.... return' must follow 'O.... sub' subroutine definition");
    const std::string name = s.frame().sub;
    TRY(run_return(s));
    Frame &caller = s.frame();
    if (s.source >= 0 || caller.m98_repeats <= 0) return INTERP_OK;
    const int left = caller.m98_repeats - 1; // an MDI line cannot be read again
    TRY(enter(s, CALL_M98, name));
    s.frames[s.call_level - 1].m98_repeats = left;
    return go_to_sub(s, name);
}

int run_m98(Setup &s)
{
    const Block &b = s.block;
    Frame &caller = s.frame();
    long repeats = b.has('l') ? long(b['l']) : 1;
    if (caller.m98_offset == s.line_offset && caller.m98_line == s.sequence_number && caller.m98_repeats > 0)
        repeats = caller.m98_repeats; // the line is read again for the next turn
    if (repeats <= 0) {
        caller.m98_offset = -1;
        return INTERP_OK;
    }
    const std::string name = b.o_name;
    TRY(enter(s, CALL_M98, name));
    Frame &from = s.frames[s.call_level - 1];
    from.m98_repeats = int(repeats - 1);
    from.m98_offset = s.line_offset;
    from.m98_line = s.sequence_number;
    if (from.m98_repeats > 0 && from.source >= 0) {
        from.offset = s.line_offset;
        from.line = s.sequence_number - 1;
    } else {
        from.m98_offset = -1;
    }
    return go_to_sub(s, name);
}

} // namespace

int enter_sub(Setup &s, CallType type, const std::string &name) { return enter(s, type, name); }
int seek_sub(Setup &s, const std::string &name) { return go_to_sub(s, name); }

namespace
{

// ---- branches --------------------------------------------------------------------

int run_if(Setup &s)
{
    const Block &b = s.block;
    Label *l = s.labels.find(b.o_name);
    if (l && l->line != s.sequence_number)
        FLOW_FAIL("%d: duplicate O-word label - already defined in line %d: '%s'", s.sequence_number, l->line, s.raw);
    if (!l) l = &add_label(s, O_IF);
    l->taken = b.param[0] != 0;
    if (!l->taken) skip_to(s, b.o_name);
    return INTERP_OK;
}

int find_if(Setup &s, Label **label)
{
    *label = s.labels.find(s.block.o_name);
    if (!*label) FLOW_FAIL("%d: undefined O-word label: '%s'", s.sequence_number, s.raw);
    if ((*label)->type != O_IF) {
        const Label &l = **label;
        *label = nullptr;
        FLOW_FAIL("%d: no matching 'if' label: '%s' (found '%s' in line %d)", s.sequence_number, s.raw,
                  type_name(l.type), l.line);
    }
    return INTERP_OK;
}

// ELSEIF and ELSE: here a branch starts or ends.
int run_else(Setup &s, bool condition)
{
    Label *l = nullptr;
    TRY(find_if(s, &l));
    if (!l) return INTERP_OK;
    if (!s.skipping.empty() && !l->taken && condition) {
        l->taken = true;
        stop_skipping(s);
    } else {
        skip_to(s, s.block.o_name);
    }
    return INTERP_OK;
}

int run_endif(Setup &s)
{
    const Label *l = s.labels.find(s.block.o_name);
    stop_skipping(s);
    if (!l) FLOW_FAIL("%d: undefined O-word label: '%s'", s.sequence_number, s.raw);
    if (l->type != O_IF)
        FLOW_FAIL("%d: no matching label: '%s' (found '%s' in line %d): '%s'", s.sequence_number,
                  s.block.o_name.c_str(), type_name(l->type), l->line, s.raw);
    return INTERP_OK;
}

// ---- loops ------------------------------------------------------------------------

int run_do(Setup &s)
{
    Label *l = s.labels.find(s.block.o_name);
    if (!l) l = &add_label(s, O_DO);
    l->source = s.source; // the file may have got another place since
    return INTERP_OK;
}

int run_while(Setup &s)
{
    const Block &b = s.block;
    const bool again = b.params > 0 && b.param[0] != 0;
    Label *l = s.labels.find(b.o_name);
    if (l && l->type == O_DO) { // its end
        const bool leave = l->leaving || !again;
        l->leaving = l->continuing = false;
        stop_skipping(s);
        if (!leave) go_to(s, l->source, l->offset, l->line - 1);
        return INTERP_OK;
    }
    if (l && l->line != s.sequence_number)
        FLOW_FAIL("%d: duplicate O-word label: '%s' - defined in line %d", s.sequence_number, s.raw, l->line);
    if (!l) l = &add_label(s, O_WHILE);
    l->source = s.source;
    l->leaving = l->continuing = false;
    if (!again) {
        l->leaving = true;
        skip_to(s, b.o_name);
    }
    return INTERP_OK;
}

int run_repeat(Setup &s)
{
    const Block &b = s.block;
    Label *l = s.labels.find(b.o_name);
    if (l && l->line != s.sequence_number)
        FLOW_FAIL("%d: duplicate O-word label: '%s' - defined in line %d", s.sequence_number, s.raw, l->line);
    if (!l) l = &add_label(s, O_REPEAT);
    l->source = s.source;
    const double count = rint(b.param[0]);
    l->repeats = count > 2e9 ? 2000000000L : long(count);
    l->running = l->repeats > 0;
    if (!l->running) skip_to(s, b.o_name);
    return INTERP_OK;
}

int run_loop_end(Setup &s, OWord wanted)
{
    Label *l = s.labels.find(s.block.o_name);
    if (!l) {
        stop_skipping(s);
        FLOW_FAIL("%d: undefined O-word label: '%s'", s.sequence_number, s.raw);
    }
    if (l->type != wanted) {
        stop_skipping(s);
        FLOW_FAIL("%d: no matching label: '%s' (found '%s' in line %d)", s.sequence_number, s.raw, type_name(l->type),
                  l->line);
    }
    stop_skipping(s);
    if (wanted == O_WHILE) {
        const bool leave = l->leaving;
        l->leaving = l->continuing = false;
        if (!leave) go_to(s, l->source, l->offset, l->line - 1);
    } else if (l->running && --l->repeats > 0) {
        go_to(s, l->source, l->after, l->line);
    } else {
        l->running = false;
    }
    return INTERP_OK;
}

int run_break(Setup &s, bool leave)
{
    Label *l = s.labels.find(s.block.o_name);
    if (!l) FLOW_FAIL("%d: undefined O-word label: '%s'", s.sequence_number, s.raw);
    if (l->type != O_WHILE && l->type != O_DO)
        FLOW_FAIL("%d: no matching while/do label: '%s' (found '%s' in line %d)", s.sequence_number, s.raw,
                  type_name(l->type), l->line);
    if (!s.skipping.empty()) return INTERP_OK; // the loop is being left already
    l->leaving = leave;
    l->continuing = !leave;
    skip_to(s, s.block.o_name);
    return INTERP_OK;
}

} // namespace

void leave_frame(Setup &s)
{
    Frame &f = s.frame();
    if (s.logs(1, f.type == CALL_REMAP ? LOG_REMAP : LOG_OWORD)) s.log("return from %s", f.sub.c_str());
    if (f.type == CALL_NGC || f.type == CALL_REMAP)
        memcpy(s.parameters.data(), f.saved_arguments, sizeof f.saved_arguments);
    f.locals.clear();
    f.modes.valid = f.modes.restore_on_return = false;
    f.m98_offset = -1;
    f.m98_repeats = 0;
    f.type = CALL_NONE;
    f.sub.clear();
    --s.call_level;
    const Frame &caller = s.frame();
    go_to(s, caller.source, caller.offset, caller.line);
    s.after_offset = caller.offset;
    s.sequence_number = caller.line;
}

// A Python sub has returned, or waits.
int finish_python_sub(Setup &s, int status)
{
    if (status == INTERP_OK) leave_frame(s);
    else if (status > INTERP_MIN_ERROR) s.trace(__func__);
    return status;
}

int run_call(Setup &s)
{
    Block &b = s.block;
    const std::string name = b.o_name;
    if (b.python_call) {
        TRY(enter(s, CALL_PYTHON, name));
        return finish_python_sub(s, s.python->call_oword(s, name, b.param, b.params));
    }
    TRY(enter(s, CALL_NGC, last_component(name)));
    return go_to_sub(s, name);
}

int run_return(Setup &s)
{
    if (s.frame().type == CALL_REMAP) return finish_remap(s);
    const SavedModes modes = s.frame().modes;
    leave_frame(s);
    if (modes.valid && modes.restore_on_return) TRY(restore_modes(s, modes));
    return INTERP_OK;
}

void unwind(Setup &s)
{
    while (s.call_level > 0) leave_frame(s);
    stop_skipping(s);
    s.defining.clear();
    forget_remaps(s);
    s.frames[0].m98_offset = -1;
    s.frames[0].m98_repeats = 0;
}

void clear_labels(Setup &s) { s.labels.clear(); }

int execute_oword(Setup &s)
{
    const Block &b = s.block;
    s.word_start = s.text[0] == '/' ? 1 : 0;
    if (b.o_type == O_SUB || b.o_type == O_PROGRAM) {
        CHECK(b.o_type == O_PROGRAM && s.disable_fanuc_subs && s.skipping.empty(),
              "DISABLE_FANUC_STYLE_SUB disabled in INI file, but found bare O-word");
        return run_sub(s);
    }
    if (s.skipping_to_sub) return INTERP_OK;
    if (!s.skipping.empty() && b.o_name != s.skipping) return INTERP_OK;
    switch (b.o_type) {
    case O_ENDSUB: return run_endsub(s);
    case O_RETURN: return run_return_word(s);
    case O_CALL: return s.skipping.empty() ? run_call(s) : int(INTERP_OK);
    case O_M98: return run_m98(s);
    case O_M99: return s.defining.empty() ? run_m99(s) : int(INTERP_OK);
    case O_IF: return s.skipping.empty() ? run_if(s) : int(INTERP_OK);
    case O_ELSEIF: return run_else(s, b.params > 0 && b.param[0] != 0);
    case O_ELSE: return run_else(s, true);
    case O_ENDIF: return run_endif(s);
    case O_DO: return s.skipping.empty() ? run_do(s) : int(INTERP_OK);
    case O_WHILE: return run_while(s);
    case O_REPEAT: return s.skipping.empty() ? run_repeat(s) : int(INTERP_OK);
    case O_ENDWHILE: return run_loop_end(s, O_WHILE);
    case O_ENDREPEAT: return run_loop_end(s, O_REPEAT);
    case O_BREAK: return run_break(s, true);
    case O_CONTINUE: return run_break(s, false);
    default: return INTERP_OK;
    }
}

} // namespace ngc
