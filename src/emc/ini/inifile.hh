/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * inifile.hh - the one reader of INI files, for every program.
 *
 * In:     a file with #INCLUDEs, continuation lines and escapes
 * Out:    variables in file order, each with the file and line it stands on
 * Thread: [task]; loaded files are shared and immutable, so any thread may query
 * Source: INI reference, sections 1, 2 and 4
 *
 * A file is parsed once per process and path; a load that failed is not kept and is
 * tried again. Messages go to standard error as PATH:LINE: error|warning: TEXT.
 */
#ifndef KERF_INIFILE_HH
#define KERF_INIFILE_HH

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace linuxcnc
{

/// One `NAME = VALUE` line, escapes already resolved.
struct IniVariable {
    std::string section, name, value;
    std::string file; ///< path of the file or include that holds the line
    int line;         ///< last physical line of the (joined) line, from 1
};

class IniFile
{
  public:
    IniFile() = default;
    explicit IniFile(const std::string &path) { open(path); }

    /// Loads (or finds loaded) the file. False, with a message on stderr, on any error.
    bool open(const std::string &path);
    bool isOpen() const { return content != nullptr; }
    explicit operator bool() const { return isOpen(); }
    const std::string &fileName() const { return path; }

    // Typed reads. An empty section means any section; num counts occurrences from 1.
    // Missing, unconvertible (with a message) and out of range all give nullopt.
    std::optional<std::string> findString(int num, const std::string &tag, const std::string &section) const;
    std::optional<bool> findBool(int num, const std::string &tag, const std::string &section) const;
    std::optional<int64_t> findSInt(int num, const std::string &tag, const std::string &section,
                                    int64_t min = INT64_MIN, int64_t max = INT64_MAX) const;
    std::optional<uint64_t> findUInt(int num, const std::string &tag, const std::string &section,
                                     uint64_t min = 0, uint64_t max = UINT64_MAX) const;
    std::optional<double> findReal(int num, const std::string &tag, const std::string &section,
                                   double min = -std::numeric_limits<double>::max(),
                                   double max = std::numeric_limits<double>::max()) const;
    std::optional<int> findInt(int num, const std::string &tag, const std::string &section,
                               int min = INT32_MIN, int max = INT32_MAX) const;

    auto findString(const std::string &tag, const std::string &section) const
    {
        return findString(1, tag, section);
    }
    auto findBool(const std::string &tag, const std::string &section) const { return findBool(1, tag, section); }
    auto findSInt(const std::string &tag, const std::string &section, int64_t min = INT64_MIN,
                  int64_t max = INT64_MAX) const
    {
        return findSInt(1, tag, section, min, max);
    }
    auto findUInt(const std::string &tag, const std::string &section, uint64_t min = 0,
                  uint64_t max = UINT64_MAX) const
    {
        return findUInt(1, tag, section, min, max);
    }
    auto findReal(const std::string &tag, const std::string &section,
                  double min = -std::numeric_limits<double>::max(),
                  double max = std::numeric_limits<double>::max()) const
    {
        return findReal(1, tag, section, min, max);
    }
    auto findInt(const std::string &tag, const std::string &section, int min = INT32_MIN,
                 int max = INT32_MAX) const
    {
        return findInt(1, tag, section, min, max);
    }

    // The same with a default.
    std::string findStringV(const std::string &tag, const std::string &section, const std::string &dflt) const
    {
        return findString(1, tag, section).value_or(dflt);
    }
    bool findBoolV(const std::string &tag, const std::string &section, bool dflt) const
    {
        return findBool(1, tag, section).value_or(dflt);
    }
    int64_t findSIntV(const std::string &tag, const std::string &section, int64_t dflt,
                      int64_t min = INT64_MIN, int64_t max = INT64_MAX) const
    {
        return findSInt(1, tag, section, min, max).value_or(dflt);
    }
    uint64_t findUIntV(const std::string &tag, const std::string &section, uint64_t dflt,
                       uint64_t min = 0, uint64_t max = UINT64_MAX) const
    {
        return findUInt(1, tag, section, min, max).value_or(dflt);
    }
    double findRealV(const std::string &tag, const std::string &section, double dflt,
                     double min = -std::numeric_limits<double>::max(),
                     double max = std::numeric_limits<double>::max()) const
    {
        return findReal(1, tag, section, min, max).value_or(dflt);
    }
    int findIntV(const std::string &tag, const std::string &section, int dflt, int min = INT32_MIN,
                 int max = INT32_MAX) const
    {
        return findInt(1, tag, section, min, max).value_or(dflt);
    }

    // All occurrences in file order; elements that do not convert are left out.
    std::vector<std::string> findStringAll(const std::string &tag, const std::string &section) const;
    std::vector<bool> findBoolAll(const std::string &tag, const std::string &section) const;
    std::vector<int64_t> findSIntAll(const std::string &tag, const std::string &section,
                                     int64_t min = INT64_MIN, int64_t max = INT64_MAX) const;
    std::vector<uint64_t> findUIntAll(const std::string &tag, const std::string &section,
                                      uint64_t min = 0, uint64_t max = UINT64_MAX) const;
    std::vector<double> findRealAll(const std::string &tag, const std::string &section,
                                    double min = -std::numeric_limits<double>::max(),
                                    double max = std::numeric_limits<double>::max()) const;

    bool isSet(const std::string &tag, const std::string &section, int num = 1) const
    {
        return find(num, tag, section) != nullptr;
    }
    bool hasSection(const std::string &section) const;
    bool hasVariable(const std::string &tag, const std::string &section, int num = 1) const
    {
        return isSet(tag, section, num);
    }
    /// File and line of the num-th occurrence.
    std::optional<std::pair<std::string, int>> lineOf(const std::string &tag, const std::string &section,
                                                      int num = 1) const;
    std::vector<std::string> findSections() const;
    /// Names and values of a section ("" = all), in file order.
    std::vector<IniVariable> findVariables(const std::string &section = "") const;

    /// Value of a key in a map, for settings that are one of a list of words.
    template <class T>
    std::optional<T> findMap(const std::map<std::string, T> &words, const std::string &tag,
                             const std::string &section, bool caseless = true) const
    {
        auto text = findString(1, tag, section);
        if (!text) return std::nullopt;
        for (auto &[word, value] : words)
            if (caseless ? equalNoCase(word, *text) : word == *text) return value;
        return std::nullopt;
    }
    std::optional<double> findLinearUnits(const std::string &tag, const std::string &section, int num = 1) const;
    std::optional<double> findAngularUnits(const std::string &tag, const std::string &section, int num = 1) const;
    std::optional<int> findJointType(const std::string &tag, const std::string &section, int num = 1) const;

    // Conversions of a text. [any]
    static std::optional<bool> convertBool(const std::string &text);
    static std::optional<int64_t> convertSInt(const std::string &text);
    static std::optional<uint64_t> convertUInt(const std::string &text);
    static std::optional<double> convertReal(const std::string &text);
    static std::optional<double> mapLinearUnits(const std::string &text);  ///< units per mm
    static std::optional<double> mapAngularUnits(const std::string &text); ///< units per degree
    static std::optional<int> mapJointType(const std::string &text);       ///< LINEAR 1, ANGULAR 2
    /// `~/x` becomes $HOME/x; nullopt when HOME is needed and unset.
    static std::optional<std::string> tildeExpand(const std::string &path);
    static std::vector<std::string> split(const std::string &delimiters, const std::string &text);
    static std::string trim(const std::string &text);
    static bool equalNoCase(std::string_view a, std::string_view b);

    struct Content; ///< a loaded file; see inifile.cc

  private:
    const IniVariable *find(int num, const std::string &tag, const std::string &section) const;
    std::shared_ptr<const Content> content;
    std::string path;
};

} // namespace linuxcnc

#endif
