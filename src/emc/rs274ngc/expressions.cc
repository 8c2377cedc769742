/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * expressions.cc - values: literals, parameters, functions and bracketed expressions.
 *
 * In:     s.text at s.pos, parameters
 * Out:    values; s.pos behind what was read
 * Thread: [task]; recursion is bounded by the length of a line
 * Source: G-code sheet, section 3
 */
#include <cmath>

#include "stages.hh"

namespace ngc
{
namespace
{

enum Operator : uint8_t {
    OP_END, OP_POWER, OP_TIMES, OP_DIVIDE, OP_MOD, OP_PLUS, OP_MINUS,
    OP_LT, OP_EQ, OP_NE, OP_LE, OP_GE, OP_GT, OP_AND, OP_OR, OP_XOR
};
// How tightly each binds; 0 ends the expression.
constexpr uint8_t precedence[] = {0, 6, 5, 5, 5, 4, 4, 3, 3, 3, 3, 3, 3, 2, 2, 2};

constexpr double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10,
                                   1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

inline bool is_digit(char c) { return unsigned(c - '0') < 10; }
constexpr double degrees(double radians) { return radians * (180.0 / M_PI); }
constexpr double radians(double degrees) { return degrees * (M_PI / 180.0); }

// A literal: digits with at most one point, perhaps a sign. Exact for up to 15 digits
// (mantissa and power of ten are exact doubles), else by strtod.
int read_literal(Setup &s, double *value)
{
    const char *start = s.text + s.pos, *p = start;
    bool negative = *p == '-';
    if (*p == '-' || *p == '+') ++p;
    uint64_t mantissa = 0;
    int digits = 0, fraction = 0;
    while (is_digit(*p)) mantissa = mantissa * 10 + uint64_t(*p++ - '0'), ++digits;
    if (*p == '.') {
        ++p;
        const char *point = p;
        while (is_digit(*p)) mantissa = mantissa * 10 + uint64_t(*p++ - '0'), ++digits;
        fraction = int(p - point);
    }
    if (__builtin_expect(digits == 0 || *p == '.', 0)) {
        const char *end = start + (*start == '-' || *start == '+');
        while (is_digit(*end) || *end == '.') ++end;
        s.word_start = s.pos;
        s.pos = int(end - s.text);
        FAIL("bad number format (%s) parsing '%.*s'", digits ? "trailing characters" : "conversion failed",
             int(end - start), start);
    }
    if (__builtin_expect(digits <= 15, 1)) {
        double v = double(mantissa);
        if (fraction) v /= power_of_ten[fraction];
        *value = negative ? -v : v;
    } else {
        char digits_text[INTERP_LINELEN + 8]; // the text up to p only: a letter E may follow
        memcpy(digits_text, start, size_t(p - start));
        digits_text[p - start] = 0;
        *value = strtod(digits_text, nullptr);
    }
    s.pos = int(p - s.text);
    return INTERP_OK;
}

int read_operator(Setup &s, Operator *op)
{
    const char *t = s.text + s.pos;
    int length = 2;
    switch (*t) {
    case '+': *op = OP_PLUS, length = 1; break;
    case '-': *op = OP_MINUS, length = 1; break;
    case '/': *op = OP_DIVIDE, length = 1; break;
    case ']': *op = OP_END, length = 1; break;
    case '*':
        if (t[1] == '*') *op = OP_POWER;
        else *op = OP_TIMES, length = 1;
        break;
    case 'a':
        CHECK(strncmp(t, "and", 3) != 0, "Unknown operation name starting with a");
        *op = OP_AND, length = 3;
        break;
    case 'm':
        CHECK(strncmp(t, "mod", 3) != 0, "Unknown operation name starting with m");
        *op = OP_MOD, length = 3;
        break;
    case 'x':
        CHECK(strncmp(t, "xor", 3) != 0, "Unknown operation name starting with x");
        *op = OP_XOR, length = 3;
        break;
    case 'o':
        CHECK(t[1] != 'r', "Unknown operation name starting with o");
        *op = OP_OR;
        break;
    case 'e':
        CHECK(t[1] != 'q', "Unknown operation name starting with e");
        *op = OP_EQ;
        break;
    case 'n':
        CHECK(t[1] != 'e', "Unknown operation name starting with n");
        *op = OP_NE;
        break;
    case 'g':
        CHECK(t[1] != 'e' && t[1] != 't', "Unknown operation name starting with g");
        *op = t[1] == 'e' ? OP_GE : OP_GT;
        break;
    case 'l':
        CHECK(t[1] != 'e' && t[1] != 't', "Unknown operation name starting with l");
        *op = t[1] == 'e' ? OP_LE : OP_LT;
        break;
    case 0:
        FAIL("Unclosed expression");
    default:
        FAIL("Unknown operation");
    }
    s.pos += length;
    return INTERP_OK;
}

int apply(Setup &s, Operator op, double *left, double right)
{
    switch (op) {
    case OP_POWER:
        CHECK(*left < 0 && floor(right) != right && !s.syntax_only, "Attempt to raise negative to non integer power");
        *left = pow(*left, right);
        break;
    case OP_TIMES: *left *= right; break;
    case OP_DIVIDE:
        CHECK(right == 0 && !s.syntax_only, "Attempt to divide by zero");
        *left /= right;
        break;
    case OP_MOD:
        *left = fmod(*left, right);
        if (*left < 0) *left += fabs(right);
        break;
    case OP_PLUS: *left += right; break;
    case OP_MINUS: *left -= right; break;
    case OP_LT: *left = *left < right; break;
    case OP_GT: *left = *left > right; break;
    case OP_EQ: *left = fabs(*left - right) < TOLERANCE_EQUAL; break;
    case OP_NE: *left = !(fabs(*left - right) < TOLERANCE_EQUAL); break;
    case OP_LE: *left = *left < right || fabs(*left - right) < TOLERANCE_EQUAL; break;
    case OP_GE: *left = *left > right || fabs(*left - right) < TOLERANCE_EQUAL; break;
    case OP_AND: *left = *left != 0 && right != 0; break;
    case OP_OR: *left = *left != 0 || right != 0; break;
    case OP_XOR: *left = (*left != 0) != (right != 0); break;
    case OP_END: break;
    }
    return INTERP_OK;
}

// Reads operands and operators as long as they bind tighter than `floor_level`.
// *op: in: operator after *left; out: the one that ended the run.
int read_run(Setup &s, double *left, Operator *op, int floor_level)
{
    while (precedence[*op] > floor_level) {
        Operator mine = *op;
        double right;
        TRY(read_real(s, &right));
        TRY(read_operator(s, op));
        if (precedence[*op] > precedence[mine]) TRY(read_run(s, &right, op, precedence[mine]));
        TRY(apply(s, mine, left, right));
    }
    return INTERP_OK;
}

int read_exists(Setup &s, double *value)
{
    CHECK(s.text[s.pos] != '[', "Left bracket missing after unary operation name");
    ++s.pos;
    CHECK(s.text[s.pos] != '#', "Expected # reading parameter");
    ++s.pos;
    if (s.text[s.pos] == '<') {
        std::string_view name;
        TRY(read_parameter_name(s, &name));
        double ignored;
        *value = named_value(s, name, &ignored);
    } else {
        int index;
        TRY(read_integer(s, &index));
        *value = index >= 1 && index <= MAX_PARAMETER;
    }
    CHECK(s.text[s.pos] != ']', "Expected ] reading bracketed parameter");
    ++s.pos;
    return INTERP_OK;
}

enum Function : uint8_t {
    F_ABS, F_ACOS, F_ASIN, F_ATAN, F_COS, F_EXISTS, F_EXP, F_FIX, F_FUP, F_LN, F_ROUND, F_SIN, F_SQRT, F_TAN
};

int read_function_name(Setup &s, Function *function)
{
    struct Name { const char *text; Function function; };
    static const Name names[] = {{"abs", F_ABS},       {"acos", F_ACOS}, {"asin", F_ASIN}, {"atan", F_ATAN},
                                 {"cos", F_COS},       {"exp", F_EXP},   {"exists", F_EXISTS}, {"fix", F_FIX},
                                 {"fup", F_FUP},       {"ln", F_LN},     {"round", F_ROUND}, {"sin", F_SIN},
                                 {"sqrt", F_SQRT},     {"tan", F_TAN}};
    const char *t = s.text + s.pos;
    bool known_letter = false;
    for (const Name &n : names) {
        if (n.text[0] != *t) continue;
        known_letter = true;
        size_t length = strlen(n.text);
        if (strncmp(t, n.text, length) == 0) {
            *function = n.function;
            s.pos += int(length);
            return INTERP_OK;
        }
    }
    s.word_start = s.pos;
    CHECK(known_letter, "Unknown word starting with %c", *t);
    FAIL("Unknown word where unary operation could be");
}

int read_function(Setup &s, double *value)
{
    Function f = F_ABS;
    int start = s.pos;
    TRY(read_function_name(s, &f));
    if (f == F_EXISTS) return read_exists(s, value);
    CHECK(s.text[s.pos] != '[', "Left bracket missing after unary operation name");
    double x;
    TRY(read_bracketed(s, &x));
    if (f == F_ATAN) {
        CHECK(s.text[s.pos] != '/', "Slash missing after first atan argument");
        ++s.pos;
        CHECK(s.text[s.pos] != '[', "Left bracket missing after slash with atan");
        double adjacent;
        TRY(read_bracketed(s, &adjacent));
        *value = degrees(atan2(x, adjacent));
        return INTERP_OK;
    }
    s.word_start = start;
    switch (f) {
    case F_ABS: x = fabs(x); break;
    case F_ACOS:
        CHECK((x < -1 || x > 1) && !s.syntax_only, "Argument to acos out of range");
        x = degrees(acos(x));
        break;
    case F_ASIN:
        CHECK((x < -1 || x > 1) && !s.syntax_only, "Argument to asin out of range");
        x = degrees(asin(x));
        break;
    case F_COS: x = cos(radians(x)); break;
    case F_EXP: x = exp(x); break;
    case F_FIX: x = floor(x); break;
    case F_FUP: x = ceil(x); break;
    case F_LN:
        CHECK((x <= 0) && !s.syntax_only, "Zero or negative argument to ln");
        x = log(x);
        break;
    case F_ROUND: x = round(x); break;
    case F_SIN: x = sin(radians(x)); break;
    case F_SQRT:
        CHECK((x < 0) && !s.syntax_only, "Negative argument to sqrt");
        x = sqrt(x);
        break;
    case F_TAN: x = tan(radians(x)); break;
    case F_ATAN:
    case F_EXISTS: break;
    }
    *value = x;
    return INTERP_OK;
}

int read_parameter(Setup &s, double *value)
{
    int start = s.pos;
    ++s.pos;
    if (s.text[s.pos] == '<') {
        std::string_view name;
        TRY(read_parameter_name(s, &name));
        bool failed = false;
        if (named_value(s, name, value, &failed)) return INTERP_OK;
        s.word_start = start;
        if (failed) return INTERP_ERROR;
        if (!s.defining.empty() || s.syntax_only) { // inside a definition nothing is defined yet
            *value = 0;
            return INTERP_OK;
        }
        FAIL("Named parameter #<%.*s> not defined", int(name.size()), name.data());
    }
    int index;
    TRY(read_integer(s, &index));
    s.word_start = start;
    if (s.syntax_only) { // any number may be meant
        *value = 1;
        return INTERP_OK;
    }
    return parameter_value(s, index, value);
}

} // namespace

int to_integer(Setup &s, double value, int *result)
{
    double below = floor(value);
    double above = value - below;
    if (above > 1 - TOLERANCE_INT)
        below = ceil(value);
    else
        CHECK(above > TOLERANCE_INT && !s.syntax_only, "Non integer value for integer");
    *result = saturated(below);
    return INTERP_OK;
}

int read_integer(Setup &s, int *value)
{
    // Plain digits are by far the most frequent.
    const char *p = s.text + s.pos;
    if (is_digit(*p)) {
        int v = 0, n = 0;
        while (is_digit(*p) && n < 9) v = v * 10 + (*p++ - '0'), ++n;
        if (!is_digit(*p) && *p != '.') {
            *value = v;
            s.pos = int(p - s.text);
            return INTERP_OK;
        }
    }
    double real;
    int start = s.pos;
    TRY(read_real(s, &real));
    s.word_start = start;
    return to_integer(s, real, value);
}

int read_parameter_name(Setup &s, std::string_view *name)
{
    const char *start = s.text + s.pos + 1;
    const char *end = strchr(start, '>');
    if (!end) {
        s.word_start = s.pos > 0 ? s.pos - 1 : 0;
        FAIL("Named parameter not terminated");
    }
    *name = std::string_view(start, size_t(end - start));
    s.pos = int(end + 1 - s.text);
    return INTERP_OK;
}

int read_bracketed(Setup &s, double *value)
{
    ++s.pos; // [
    double left;
    Operator op;
    TRY(read_real(s, &left));
    TRY(read_operator(s, &op));
    TRY(read_run(s, &left, &op, 0));
    *value = left;
    return INTERP_OK;
}

int read_real(Setup &s, double *value)
{
    char c = s.text[s.pos];
    if (__builtin_expect(is_digit(c) || c == '.', 1)) return read_literal(s, value);
    int start = s.pos;
    switch (c) {
    case 0:
        FAIL("No characters found in reading real value");
    case '[':
        TRY(read_bracketed(s, value));
        break;
    case '#':
        TRY(read_parameter(s, value));
        break;
    case '+':
    case '-': {
        char next = s.text[s.pos + 1];
        if (is_digit(next) || next == '.') return read_literal(s, value);
        ++s.pos;
        TRY(read_real(s, value));
        if (c == '-') *value = -*value;
        break;
    }
    default:
        if (c >= 'a' && c <= 'z') {
            TRY(read_function(s, value));
        } else {
            return read_literal(s, value);
        }
    }
    if (__builtin_expect(!std::isfinite(*value), 0)) {
        if (s.syntax_only) {
            *value = 1;
            return INTERP_OK;
        }
        s.word_start = start;
        FAIL("Calculation resulted in '%s'", std::isnan(*value) ? "not a number" : "infinity");
    }
    return INTERP_OK;
}

} // namespace ngc
