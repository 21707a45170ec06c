// Covering arrays under constraints: few rows in which every tuple of levels that is allowed is there
// (greedy, one row at a time; Cohen et al. 1997, AETG, with unit propagation over the constraints). The same
// seed gives the same rows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace stereonav::test {

// Levels of one factor as bits: at most 32 of them.
using LevelSet = std::uint32_t;
using Row = std::vector<int>;  // the level of each factor

// A combination that is not allowed: all of these factors at levels of these sets at once.
struct Clause {
    struct Part {
        int factor;
        LevelSet levels;
    };
    std::vector<Part> parts;
};
bool violates(const Row& row, const Clause& clause);

struct Level {
    int factor, level;
};
using Tuple = std::vector<Level>;  // levels of different factors, by increasing factor

class Covering {
public:
    // levels: how many each factor has, 1 to 32.
    Covering(std::vector<int> levels, std::vector<Clause> clauses);

    // A row that holds the tuple and breaks no clause; none where there is no such row. Which one, of many,
    // follows from the seed.
    std::optional<Row> complete(const Tuple& tuple, std::uint64_t seed) const;

    // All tuples of one level of each of these factors, allowed or not.
    std::vector<Tuple> tuplesOf(const std::vector<int>& factors) const;

    // Rows that hold each of the tuples for which there is a row at all.
    std::vector<Row> cover(const std::vector<Tuple>& tuples, std::uint64_t seed) const;

private:
    using Domains = std::vector<LevelSet>;  // what each factor may still be
    Domains everything() const;
    bool propagate(Domains& domains) const;
    struct Entry;  // a tuple, packed
    static Entry packed(const Tuple& tuple);
    bool narrow(const Entry& tuple, Domains& domains) const;
    static bool bringsNews(const Entry& tuple, const Domains& domains);
    void take(const Entry& tuple, Domains& domains, Domains& trial) const;
    std::optional<Row> fill(std::vector<Entry>& open, std::uint64_t& random) const;
    bool search(Domains& domains, std::uint64_t& random) const;

    std::vector<int> mLevels;
    std::vector<Clause> mClauses;
};

bool holds(const Row& row, const Tuple& tuple);

}  // namespace stereonav::test
