/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * words.cc - canonical text becomes a block.
 *
 * In:     s.text, parameters (expressions are evaluated here)
 * Out:    s.block
 * Thread: [task]
 * Source: G-code sheet, section 2
 */
#include "remap.hh"
#include "stages.hh"

namespace ngc
{

void Block::clear()
{
    present = 0;
    for (auto &g : g_modes) g = -1;
    for (auto &m : m_modes) m = -1;
    m_count = 0;
    user_m = -1;
    motion = -1;
    any_word = false;
    phases = 0;
    comment = nullptr;
    comment_length = 0;
    settings = named_settings = 0;
    o_type = O_NONE;
    params = 0;
    python_call = false;
    executing = nullptr;
    phase = 0;
    builtin_used = false;
}

namespace
{

int read_g(Setup &s, Block &b)
{
    double value;
    TRY(read_real(s, &value));
    double tenfold = 10 * value;
    double below = floor(tenfold);
    double above = tenfold - below;
    if (above > 0.999)
        below = ceil(tenfold);
    else
        CHECK(above > 0.001, "G-code out of range");
    CHECK(below > 999, "G-code out of range");
    CHECK(below < 0, "Negative g code used");
    int code = int(below);
    int group = g_group(code);
    if (__builtin_expect(group < 0, 0)) {
        const Remap *remap = s.remaps ? s.remaps->g(code) : nullptr;
        CHECK(!remap, "Unknown g code used");
        group = remap->modal_group;
        CHECK(b.g_modes[group] != -1, "Two g codes used from same modal group");
        b.g_modes[group] = int16_t(code);
        return INTERP_OK;
    }
    if (group == GM_MOTION && b.g_modes[group] != -1) {
        // G80 yields to another motion code, in either order.
        if (code == G_80) return INTERP_OK;
        if (b.g_modes[group] == G_80) {
            b.g_modes[group] = int16_t(code);
            return INTERP_OK;
        }
    }
    CHECK(b.g_modes[group] != -1, "Two g codes used from same modal group");
    b.g_modes[group] = int16_t(code);
    b.phases |= phase_bit(code == G_4 ? PHASE_DWELL : phase_of_g_group(group));
    return INTERP_OK;
}

int read_m(Setup &s, Block &b)
{
    int value;
    TRY(read_integer(s, &value));
    CHECK(value < 0, "Negative m code used");
    const Remap *remap = s.remaps ? s.remaps->m(value) : nullptr;
    int group = m_group(value);
    if (value == 98 && b.o_type == O_M98) group = MM_STOP;
    if (value == 99 && b.o_type == O_M99) return INTERP_OK;
    if (remap && remappable_m(value)) {
        group = remap->modal_group;
        CHECK(b.m_modes[group] != -1, "Two m codes used from same modal group");
    } else {
        CHECK(value > 199, "M-code greater than 199: M%d", value);
        CHECK(group < 0, "Unknown m code used: M%d", value);
        CHECK(b.m_modes[group] != -1, "Two m codes used from same modal group");
    }
    b.m_modes[group] = int16_t(value);
    if (value >= 100 && value < 200) b.user_m = value;
    b.phases |= phase_bit(phase_of_m_group(group));
    ++b.m_count;
    return INTERP_OK;
}

// #n=value or #<name>=value
int read_setting(Setup &s, Block &b)
{
    b.phases |= phase_bit(PHASE_COMMENT);
    ++s.pos;
    if (s.text[s.pos] == '<') {
        std::string_view name;
        TRY(read_parameter_name(s, &name));
        CHECK(s.text[s.pos] != '=', "Equal sign missing in parameter setting");
        ++s.pos;
        if (!find_named(s, name)) make_named(s, name);
        double value;
        TRY(read_real(s, &value));
        CHECK(b.named_settings == MAX_SETTINGS, "Command too long");
        b.named_setting[b.named_settings].name = name;
        b.named_setting[b.named_settings++].value = value;
        return INTERP_OK;
    }
    int index;
    TRY(read_integer(s, &index));
    CHECK(index < 1 || index > MAX_PARAMETER, "Parameter number out of range");
    CHECK(parameter_read_only(index), "Parameter is readonly");
    CHECK(s.text[s.pos] != '=', "Equal sign missing in parameter setting");
    ++s.pos;
    double value;
    TRY(read_real(s, &value));
    CHECK(b.settings == MAX_SETTINGS, "Command too long");
    b.setting[b.settings].index = index;
    b.setting[b.settings++].value = value;
    return INTERP_OK;
}

int read_comment(Setup &s, Block &b)
{
    const char *start = s.text + s.pos + 1;
    const char *end = strchr(start, ')');
    b.comment = start;
    b.comment_length = int(end ? end - start : int(strlen(start)));
    b.phases |= phase_bit(PHASE_COMMENT);
    s.pos = int((end ? end + 1 : start + b.comment_length) - s.text);
    return INTERP_OK;
}

// A letter with a value that may stand once on a line.
int read_word(Setup &s, Block &b, char letter)
{
    uint32_t bit = word_bit(letter);
    if (__builtin_expect(b.present & bit, 0)) {
        // P and Q: a negative value counts as none
        if (!((letter == 'p' || letter == 'q') && b[letter] <= -1) && !(bit & POLAR_WORDS)) {
            CHECK(letter == '$', "Multiple spindle choice ($) words on one line");
            char shown = letter >= 'u' && letter <= 'w' ? char(letter - 32) : letter;
            FAIL("Multiple %c words on one line", shown);
        }
    }
    double value;
    int whole;
    switch (letter) {
    case 'x':
        TRY(read_real(s, &value));
        if (s.lathe_diameter) value /= 2;
        break;
    case 'f':
        TRY(read_real(s, &value));
        CHECK(value < 0, "Negative f word used");
        b.phases |= phase_bit(PHASE_F);
        break;
    case 's':
        TRY(read_real(s, &value));
        CHECK(value < 0, "Negative spindle speed used");
        b.phases |= phase_bit(PHASE_S);
        break;
    case 'h':
        TRY(read_integer(s, &whole));
        CHECK(whole < -1, "Negative h word used");
        value = whole;
        break;
    case 'l':
        TRY(read_integer(s, &whole));
        CHECK(whole < 0, "Negative l word used");
        value = whole;
        break;
    case 't':
        TRY(read_integer(s, &whole));
        CHECK(whole < 0, "Negative tool id (tool not found)");
        b.phases |= phase_bit(PHASE_T);
        value = whole;
        break;
    case '$':
        TRY(read_real(s, &value));
        value = value > 1e9 ? 1e9 : value < -1e9 ? -1e9 : trunc(value);
        break;
    default:
        TRY(read_real(s, &value));
    }
    b.set(letter, value);
    return INTERP_OK;
}

int skip_digits(Setup &s)
{
    CHECK(s.text[s.pos] < '0' || s.text[s.pos] > '9', "Bad format unsigned integer");
    while (s.text[s.pos] >= '0' && s.text[s.pos] <= '9') ++s.pos;
    return INTERP_OK;
}

int read_line_number(Setup &s)
{
    ++s.pos;
    TRY(skip_digits(s));
    if (s.text[s.pos] != '.') return INTERP_OK;
    ++s.pos;
    return skip_digits(s);
}

int bad_character(Setup &s)
{
    unsigned char c = static_cast<unsigned char>(s.text[s.pos]);
    s.word_start = s.pos;
    CHECK(c < ' ' || c > 'z', "Bad character '\\%03o' used", c);
    FAIL("Bad character '%c' used", c);
}

int mask_bit(char letter)
{
    for (int i = 0; i < AXES; ++i)
        if (AXIS_LETTERS[i] == letter) return 1 << i;
    return 0;
}

} // namespace

int read_words(Setup &s)
{
    Block &b = s.block;
    for (;;) {
        char c = s.text[s.pos];
        s.word_start = s.pos;
        switch (c) {
        case 0:
            return INTERP_OK;
        case ';':
            return INTERP_OK; // read_block() has looked for ;py,
        case '(':
            TRY(read_comment(s, b));
            continue;
        case '#':
            TRY(read_setting(s, b));
            b.any_word = true;
            continue;
        case 'g':
            ++s.pos;
            TRY(read_g(s, b));
            break;
        case 'm':
            ++s.pos;
            TRY(read_m(s, b));
            break;
        case 'x': case 'y': case 'z': case 'a': case 'b': case 'c': case 'u': case 'v': case 'w':
            if (__builtin_expect(!(s.axis_mask & mask_bit(c)), 0) && !s.g7x_words_allowed(c)) return bad_character(s);
            ++s.pos;
            TRY(read_word(s, b, c));
            break;
        case 'd': case 'e': case 'f': case 'h': case 'i': case 'j': case 'k': case 'l': case 'p': case 'q': case 'r':
        case 's': case 't': case '$': case '@': case '^':
            ++s.pos;
            TRY(read_word(s, b, c));
            break;
        default:
            return bad_character(s);
        }
        b.any_word = true;
    }
}

int read_block(Setup &s)
{
    Block &b = s.block;
    b.clear();
    b.line_number = s.sequence_number;
    s.pos = 0;
    if (s.text[0] == 0) return INTERP_OK;
    if (s.text[0] == '/') ++s.pos;
    s.word_start = s.pos;
    if (s.text[s.pos] == 'n') TRY(read_line_number(s));
    s.word_start = s.pos;
    if (s.text[s.pos] == 'o' || at_fanuc_word(s)) return read_oword(s);
    if (!s.skipping.empty()) return INTERP_OK;
    if (s.raw[0] == ';' && strncasecmp(s.raw, ";py,", 4) == 0) TRY(run_python_line(s, s.raw + 4));
    TRY(read_words(s));
    if (!b.any_word) return INTERP_OK; // only comments
    TRY(infer_motion(s));
    if (b.motion != -1) b.phases |= phase_bit(PHASE_MOTION);
    return check_block(s);
}

} // namespace ngc
