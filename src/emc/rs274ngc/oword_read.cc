/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * oword_read.cc - an O line, M98 or M99 becomes a block.
 *
 * In:     s.text at the label, what is being skipped
 * Out:    s.block.o_type, o_name, arguments
 * Thread: [task]
 * Source: O-word sheet, sections 1 and 4
 */
#include "python_link.hh"
#include "stages.hh"

namespace ngc
{

[[nodiscard]] int read_words(Setup &s); // words.cc

namespace
{

struct Command {
    const char *text;
    OWord type;
};
// Tried in this order; the beginning of the text decides.
const Command commands[] = {{"sub", O_SUB},         {"endsub", O_ENDSUB},     {"call", O_CALL},
                            {"do", O_DO},           {"while", O_WHILE},       {"repeat", O_REPEAT},
                            {"if", O_IF},           {"elseif", O_ELSEIF},     {"else", O_ELSE},
                            {"endif", O_ENDIF},     {"break", O_BREAK},       {"continue", O_CONTINUE},
                            {"endwhile", O_ENDWHILE}, {"endrepeat", O_ENDREPEAT}, {"return", O_RETURN}};

constexpr bool global_label(OWord type)
{
    return type == O_SUB || type == O_ENDSUB || type == O_CALL || type == O_RETURN || type == O_PROGRAM ||
           type == O_M98 || type == O_M99;
}

bool is_word_end(char c) { return !((c >= '0' && c <= '9') || c == '.'); }

int read_label(Setup &s, std::string *label)
{
    ++s.pos;
    if (s.text[s.pos] == '<') {
        const char *start = s.text + s.pos + 1;
        const char *end = strchr(start, '>');
        const size_t length = end ? size_t(end - start) : strlen(start);
        label->assign(start, length);
        s.pos = int(start + length + (end ? 1 : 0) - s.text);
        return INTERP_OK;
    }
    int number;
    TRY(read_integer(s, &number));
    char buf[16];
    snprintf(buf, sizeof buf, "%d", number);
    *label = buf;
    return INTERP_OK;
}

// Only comments may follow.
int read_tail(Setup &s)
{
    for (;;) {
        const char c = s.text[s.pos];
        if (c == 0 || c == ';') return INTERP_OK;
        s.word_start = s.pos;
        CHECK(c != '(', "Unexpected character after O-word");
        const char *close = strchr(s.text + s.pos, ')');
        if (!close) return INTERP_OK;
        s.pos = int(close + 1 - s.text);
    }
}

int read_call_arguments(Setup &s, Block &b)
{
    for (;;) {
        const char c = s.text[s.pos];
        if (c == '(') {
            const char *close = strchr(s.text + s.pos, ')');
            if (!close) return INTERP_OK;
            s.pos = int(close + 1 - s.text);
        } else if (c == '[') {
            s.word_start = s.pos;
            CHECK(b.params == SUB_ARGUMENTS, "Too many subroutine parameters");
            TRY(read_bracketed(s, &b.param[b.params]));
            ++b.params;
        } else {
            return INTERP_OK;
        }
    }
}

int read_condition(Setup &s, Block &b, const char *command)
{
    CHECK(s.text[s.pos] != '[', "Left bracket missing after '%s'", command);
    TRY(read_bracketed(s, &b.param[0]));
    b.params = 1;
    return INTERP_OK;
}

int read_arguments(Setup &s, Block &b)
{
    switch (b.o_type) {
    case O_CALL:
        return read_call_arguments(s, b);
    case O_ENDSUB: case O_RETURN:
        if (s.text[s.pos] == '[') {
            TRY(read_bracketed(s, &b.param[0]));
            b.params = 1;
        }
        return INTERP_OK;
    case O_IF: return read_condition(s, b, "if");
    case O_ELSEIF: return read_condition(s, b, "elseif");
    case O_WHILE: return read_condition(s, b, "while");
    case O_REPEAT: return read_condition(s, b, "repeat");
    default: return INTERP_OK;
    }
}

// M98 P<sub> [L<count>]: the line is an ordinary one, but it moves the program. M99 is like an O word.
int read_fanuc(Setup &s)
{
    Block &b = s.block;
    const bool m98 = s.text[s.pos + 2] == '8';
    if (!s.skipping.empty()) {
        // The end of a program that is skipped.
        if (!m98 && !s.defining.empty()) {
            b.o_type = O_M99;
            b.o_name = s.defining;
        }
        return INTERP_OK;
    }
    b.o_type = m98 ? O_M98 : O_M99;
    CHECK(s.disable_fanuc_subs, "DISABLE_FANUC_STYLE_SUB set in INI file, but found %s", m98 ? "m98" : "m99");
    b.o_name.clear();
    if (!m98) {
        s.pos += 3;
        return read_tail(s);
    }
    TRY(read_words(s));
    TRY(infer_motion(s));
    TRY(check_block(s));
    b.m_modes[MM_STOP] = -1;
    b.motion = -1;
    CHECK(!b.has('p'), "Found 'm98' code with no P-word");
    int number;
    TRY(to_integer(s, b['p'], &number));
    b.o_name = std::to_string(number);
    return INTERP_OK;
}

} // namespace

bool at_fanuc_word(const Setup &s)
{
    const char *t = s.text + s.pos;
    if (t[0] != 'm' || t[1] != '9' || !is_word_end(t[3])) return false;
    if (t[2] == '8') return true;
    return t[2] == '9' && (s.call_level > 0 || !s.skipping.empty());
}

int read_oword(Setup &s)
{
    Block &b = s.block;
    if (s.text[s.pos] == 'm') return read_fanuc(s);
    std::string label;
    TRY(read_label(s, &label));
    const char *t = s.text + s.pos;
    b.o_type = O_NONE;
    for (const Command &c : commands)
        if (strncmp(t, c.text, strlen(c.text)) == 0) {
            b.o_type = c.type;
            s.pos += int(strlen(c.text));
            break;
        }
    if (b.o_type == O_NONE) {
        if (*t == 0 || *t == '(' || *t == ';') {
            b.o_type = O_PROGRAM;
        } else {
            if (!s.defining.empty()) return INTERP_OK; // the body is not looked at
            s.word_start = s.pos;
            FAIL("Unknown control command in o word");
        }
    }
    if (global_label(b.o_type)) {
        b.o_name = std::move(label);
    } else {
        const std::string &scope = s.defining.empty() ? s.frame().sub : s.defining;
        b.o_name.reserve(scope.size() + 1 + label.size());
        b.o_name = scope;
        b.o_name += '#';
        b.o_name += label;
    }
    if (!s.skipping.empty() && (s.skipping_to_sub || b.o_name != s.skipping)) return INTERP_OK;
    if (b.o_type == O_CALL && s.python) b.python_call = s.python->callable("oword", b.o_name);
    TRY(read_arguments(s, b));
    return read_tail(s);
}

} // namespace ngc
