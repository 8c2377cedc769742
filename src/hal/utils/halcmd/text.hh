/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * text.hh - from a line of a .hal file to tokens. No HAL, no I/O, no state.
 *
 * In:     one logical line (continuations joined), look-ups for $VAR and [SECTION]VAR
 * Out:    tokens, quote characters kept as typed; or one message
 * Thread: [any]
 * Source: HAL tools reference, section 1.3
 */
#ifndef KERF_HALCMD_TEXT_HH
#define KERF_HALCMD_TEXT_HH

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halcmd
{

constexpr size_t MAX_PHYSICAL = 1023;          ///< characters one read takes, newline included
constexpr size_t MAX_TOKENS = 32;              ///< of one logical line
constexpr size_t MAX_JOINED = (255 + 2) * 21 - 1; ///< characters of joined continuation lines
constexpr size_t MAX_SUBSTITUTED = 2046;       ///< characters after substitution
constexpr size_t MAX_VARIABLE = 127;           ///< characters of a variable's name

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string strf(const char *fmt, ...);

/// Where variables come from.
struct Lookup {
    std::function<std::optional<std::string>(const std::string &name)> env;
    std::function<std::optional<std::string>(const std::string &section, const std::string &name)> ini;
};

/// Cuts off a `#` comment outside quotes. Returns the message of a failure, "" if none.
[[nodiscard]] std::string strip_comment(std::string &line);

/// Replaces $VAR, $(VAR), [S]VAR and [S](VAR), also inside quotes, not recursively.
/// Returns the message of a failure, "" if none; out is then complete.
[[nodiscard]] std::string substitute(std::string_view line, const Lookup &lookup, std::string &out);

/// Splits at blanks; quoted runs stay together and keep their quotes. dos is set when the
/// line ended in a carriage return. Returns the message of a failure, "" if none.
[[nodiscard]] std::string tokenize(std::string_view line, std::vector<std::string> &tokens, bool &dos);

/// Collects physical lines into logical ones; one per file.
class Joiner
{
  public:
    /// Takes a physical line without its newline. True: `line` is complete.
    bool add(std::string_view physical, std::string &line);
    bool pending() const { return continued; }

  private:
    std::string joined;
    bool continued = false;
};

/// A leading "~/" becomes $HOME/ ; other texts are returned as they are.
std::string tilde_expand(const std::string &text);

} // namespace halcmd

#endif
