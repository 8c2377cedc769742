/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * names.hh - a small hash table from names to values, for named parameters and labels.
 *
 * Lookup by string_view without allocation; insertion order is kept for listings.
 * Thread: [task]
 */
#ifndef KERF_NAMES_HH
#define KERF_NAMES_HH

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ngc
{

template <class Value> class NameTable
{
  public:
    struct Entry {
        std::string name;
        Value value;
    };

    Value *find(std::string_view name)
    {
        if (slots.empty()) return nullptr;
        for (size_t i = hash(name) & mask();; i = (i + 1) & mask()) {
            if (slots[i] == 0) return nullptr;
            Entry &e = entries[slots[i] - 1];
            if (e.name == name) return &e.value;
        }
    }
    const Value *find(std::string_view name) const { return const_cast<NameTable *>(this)->find(name); }

    /// The value of that name, made if it is not there.
    Value &at(std::string_view name)
    {
        if (Value *v = find(name)) return *v;
        if ((entries.size() + 1) * 2 > slots.size()) grow();
        entries.push_back(Entry{std::string(name), Value{}});
        place(entries.size());
        return entries.back().value;
    }

    void clear()
    {
        if (entries.empty()) return;
        entries.clear();
        slots.assign(slots.size(), 0);
    }
    size_t size() const { return entries.size(); }
    auto begin() { return entries.begin(); }
    auto end() { return entries.end(); }
    auto begin() const { return entries.begin(); }
    auto end() const { return entries.end(); }

  private:
    static size_t hash(std::string_view s)
    {
        uint64_t h = 1469598103934665603ull; // FNV-1a
        for (unsigned char c : s) h = (h ^ c) * 1099511628211ull;
        return size_t(h ^ (h >> 29));
    }
    size_t mask() const { return slots.size() - 1; }
    void place(size_t number)
    {
        size_t i = hash(entries[number - 1].name) & mask();
        while (slots[i]) i = (i + 1) & mask();
        slots[i] = uint32_t(number);
    }
    void grow()
    {
        slots.assign(slots.empty() ? 16 : slots.size() * 2, 0);
        for (size_t n = 1; n <= entries.size(); ++n) place(n);
    }

    std::vector<Entry> entries;
    std::vector<uint32_t> slots; // entry number + 1; 0: free
};

} // namespace ngc

#endif
