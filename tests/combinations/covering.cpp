#include "tests/combinations/covering.h"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <utility>

namespace stereonav::test {
namespace {

// splitmix64 (Steele et al. 2014)
std::uint64_t next(std::uint64_t& state) {
    std::uint64_t z = state += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
}

template <typename T>
void shuffle(std::vector<T>& items, std::uint64_t& random) {
    for (std::size_t n = items.size(); n > 1; --n) std::swap(items[n - 1], items[next(random) % n]);
}

LevelSet bit(int level) {
    return LevelSet{1} << level;
}

Row rowOf(const std::vector<LevelSet>& single) {
    Row row;
    for (const LevelSet domain : single) row.push_back(std::countr_zero(domain));
    return row;
}

}  // namespace

bool violates(const Row& row, const Clause& clause) {
    return std::all_of(clause.parts.begin(), clause.parts.end(), [&](const Clause::Part& part) {
        return (part.levels & bit(row[static_cast<std::size_t>(part.factor)])) != 0;
    });
}

bool holds(const Row& row, const Tuple& tuple) {
    return std::all_of(tuple.begin(), tuple.end(),
                       [&](const Level& at) { return row[static_cast<std::size_t>(at.factor)] == at.level; });
}

Covering::Covering(std::vector<int> levels, std::vector<Clause> clauses)
    : mLevels(std::move(levels)), mClauses(std::move(clauses)) {}

// Until nothing changes: where all parts of a clause but one are sure to hold, that one must not.
bool Covering::propagate(Domains& domains) const {
    for (bool changed = true; changed;) {
        changed = false;
        for (const Clause& clause : mClauses) {
            const Clause::Part* open = nullptr;
            bool done = false;
            for (const Clause::Part& part : clause.parts) {
                const LevelSet domain = domains[static_cast<std::size_t>(part.factor)];
                if ((domain & ~part.levels) == 0) continue;  // sure to hold
                done = open != nullptr || (domain & part.levels) == 0;
                open = &part;
                if (done) break;
            }
            if (done) continue;
            if (!open) return false;
            domains[static_cast<std::size_t>(open->factor)] &= ~open->levels;
            changed = true;
        }
    }
    return std::all_of(domains.begin(), domains.end(), [](LevelSet domain) { return domain != 0; });
}

// The factor with the fewest levels left first, its levels in a random order, but that what nobody asks for
// is mostly left at the first level; back where a clause breaks.
bool Covering::search(Domains& domains, std::uint64_t& random) const {
    if (!propagate(domains)) return false;
    std::size_t chosen = domains.size();
    for (std::size_t f = 0; f < domains.size(); ++f)
        if (std::popcount(domains[f]) > 1 &&
            (chosen == domains.size() || std::popcount(domains[f]) < std::popcount(domains[chosen])))
            chosen = f;
    if (chosen == domains.size()) return true;
    std::vector<int> levels;
    for (int level = 0; level < mLevels[chosen]; ++level)
        if (domains[chosen] & bit(level)) levels.push_back(level);
    shuffle(levels, random);
    if (next(random) % 4 != 0)
        std::sort(levels.begin(), levels.end(), [](int a, int b) { return a == 0 && b != 0; });
    for (const int level : levels) {
        Domains trial = domains;
        trial[chosen] = bit(level);
        if (!search(trial, random)) continue;
        domains = trial;
        return true;
    }
    return false;
}

std::optional<Row> Covering::complete(const Tuple& tuple, std::uint64_t seed) const {
    Domains domains = everything();
    for (const Level& at : tuple) domains[static_cast<std::size_t>(at.factor)] &= bit(at.level);
    if (!search(domains, seed)) return std::nullopt;
    return rowOf(domains);
}

std::vector<Tuple> Covering::tuplesOf(const std::vector<int>& factors) const {
    std::vector<int> sorted = factors;
    std::sort(sorted.begin(), sorted.end());
    std::vector<Tuple> tuples{{}};
    for (const int factor : sorted) {
        std::vector<Tuple> longer;
        for (const Tuple& tuple : tuples)
            for (int level = 0; level < mLevels[static_cast<std::size_t>(factor)]; ++level) {
                longer.push_back(tuple);
                longer.back().push_back({factor, level});
            }
        tuples = std::move(longer);
    }
    return tuples;
}

Covering::Domains Covering::everything() const {
    Domains domains;
    for (const int count : mLevels) domains.push_back(count == 32 ? ~LevelSet{0} : bit(count) - 1);
    return domains;
}

// Tuples side by side, levels packed: there are some 300,000, and each row looks at all that are left.
struct Covering::Entry {
    std::array<std::uint8_t, 7> factor{}, level{};
    std::uint8_t count = 0;
    Level operator[](int n) const {
        return {factor[static_cast<std::size_t>(n)], level[static_cast<std::size_t>(n)]};
    }
    int size() const { return count; }
    bool heldBy(const Row& row) const {
        for (std::size_t n = 0; n < count; ++n)
            if (row[factor[n]] != level[n]) return false;
        return true;
    }
};

Covering::Entry Covering::packed(const Tuple& tuple) {
    Entry entry;
    if (tuple.size() > entry.factor.size()) throw std::logic_error("a tuple of more than seven");
    for (const Level& at : tuple) {
        entry.factor[entry.count] = static_cast<std::uint8_t>(at.factor);
        entry.level[entry.count++] = static_cast<std::uint8_t>(at.level);
    }
    return entry;
}

// The domains narrowed to the tuple; whether that leaves something for each factor.
bool Covering::narrow(const Entry& tuple, Domains& domains) const {
    for (int n = 0; n < tuple.size(); ++n)
        domains[static_cast<std::size_t>(tuple[n].factor)] &= bit(tuple[n].level);
    return propagate(domains);
}

// Returns whether the tuple is possible, and not sure to hold.
bool Covering::bringsNews(const Entry& tuple, const Domains& domains) {
    bool news = false;
    for (int n = 0; n < tuple.size(); ++n) {
        const LevelSet domain = domains[static_cast<std::size_t>(tuple[n].factor)];
        if (!(domain & bit(tuple[n].level))) return false;
        news = news || domain != bit(tuple[n].level);
    }
    return news;
}

// Narrows the domains to the tuple where that leaves something for each factor.
void Covering::take(const Entry& tuple, Domains& domains, Domains& trial) const {
    if (!bringsNews(tuple, domains)) return;
    trial = domains;
    if (narrow(tuple, trial)) std::swap(domains, trial);
}

// The first tuple, and then as many others as go with it, in a random order.
std::optional<Row> Covering::fill(std::vector<Entry>& open, std::uint64_t& random) const {
    // Number of tuples that are tried first. After them most others no longer go with the row, and are passed
    // over without being shuffled.
    constexpr std::size_t kAtFirst = 1000;
    Domains domains = everything();
    if (!narrow(open.front(), domains)) return std::nullopt;
    Domains trial;
    const std::size_t all = open.size(), some = std::min(kAtFirst, all);
    for (std::size_t n = 1; n < some; ++n) {  // the first stays first
        std::swap(open[n], open[n + next(random) % (all - n)]);
        take(open[n], domains, trial);
    }
    std::vector<const Entry*> rest;
    for (std::size_t n = some; n < all; ++n)
        if (bringsNews(open[n], domains)) rest.push_back(&open[n]);
    shuffle(rest, random);
    for (const Entry* entry : rest) take(*entry, domains, trial);
    if (search(domains, random)) return rowOf(domains);
    Tuple first;
    for (int n = 0; n < open.front().size(); ++n) first.push_back(open.front()[n]);
    return complete(first, next(random));
}

std::vector<Row> Covering::cover(const std::vector<Tuple>& tuples, std::uint64_t seed) const {
    constexpr int kTries = 12;  // rows tried for each one that is kept
    std::uint64_t random = seed;
    // Most of what is not allowed shows at once, and need not be looked at for each row.
    std::vector<Entry> open;
    Domains trial;
    for (const Tuple& tuple : tuples)
        if (narrow(packed(tuple), trial = everything())) open.push_back(packed(tuple));
    shuffle(open, random);
    std::vector<Row> rows;
    while (!open.empty()) {
        Row best;
        std::ptrdiff_t bestCount = 0;
        for (int attempt = 0; attempt < kTries; ++attempt) {
            const std::optional<Row> row = fill(open, random);
            if (!row) break;
            const auto count =
                std::count_if(open.begin(), open.end(), [&](const Entry& t) { return t.heldBy(*row); });
            if (count > bestCount) best = *row, bestCount = count;
        }
        if (bestCount == 0) {  // not allowed
            std::swap(open.front(), open.back());
            open.pop_back();
            continue;
        }
        std::erase_if(open, [&](const Entry& t) { return t.heldBy(best); });
        rows.push_back(std::move(best));
    }
    return rows;
}

}  // namespace stereonav::test
