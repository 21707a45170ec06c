// The covering array against a search by hand: what is allowed is there, what is not is in no row.
#include "tests/combinations/covering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "tests/combinations/model.h"

namespace stereonav::test {
namespace {

bool allowed(const Row& row, const std::vector<Clause>& clauses) {
    return std::none_of(clauses.begin(), clauses.end(), [&](const Clause& c) { return violates(row, c); });
}

// Every row there is.
std::vector<Row> everyRow(const std::vector<int>& levels) {
    std::vector<Row> rows{{}};
    for (const int count : levels) {
        std::vector<Row> longer;
        for (const Row& row : rows)
            for (int level = 0; level < count; ++level) {
                longer.push_back(row);
                longer.back().push_back(level);
            }
        rows = std::move(longer);
    }
    return rows;
}

TEST(Covering, HoldsJustTheTuplesThatSomeAllowedRowHas) {
    const std::vector<int> levels{3, 2, 4, 2, 3};
    // The third makes pairs impossible that no clause names: 0 at 2 wants 1 at 1, which wants 3 at 0.
    const std::vector<Clause> clauses{{{{0, 0b001}, {2, 0b1010}}},
                                      {{{1, 0b01}, {0, 0b100}}},
                                      {{{1, 0b10}, {3, 0b10}}},
                                      {{{2, 0b0001}, {3, 0b01}, {4, 0b110}}}};
    const Covering covering(levels, clauses);
    std::vector<Row> all = everyRow(levels);
    std::erase_if(all, [&](const Row& row) { return !allowed(row, clauses); });
    int impossible = 0;
    for (const std::vector<int>& strength : {std::vector<int>{0, 3}, {1, 2}, {0, 2, 4}, {0, 1, 2, 3, 4}}) {
        const std::vector<Tuple> tuples = covering.tuplesOf(strength);
        const std::vector<Row> rows = covering.cover(tuples, 7);
        for (const Row& row : rows) EXPECT_TRUE(allowed(row, clauses));
        for (const Tuple& tuple : tuples) {
            const auto has = [&](const Row& row) { return holds(row, tuple); };
            const bool possible = std::any_of(all.begin(), all.end(), has);
            EXPECT_EQ(std::any_of(rows.begin(), rows.end(), has), possible);
            EXPECT_EQ(covering.complete(tuple, 3).has_value(), possible);
            impossible += !possible;
        }
        EXPECT_LE(rows.size(), tuples.size());
    }
    EXPECT_GT(impossible, 0);
}

TEST(Covering, IsSmallWithoutConstraints) {
    const Covering covering(std::vector<int>(13, 3), {});
    std::vector<Tuple> pairs;
    for (int a = 0; a < 13; ++a)
        for (int b = a + 1; b < 13; ++b)
            for (const Tuple& tuple : covering.tuplesOf({a, b})) pairs.push_back(tuple);
    const std::vector<Row> rows = covering.cover(pairs, 1);
    EXPECT_GE(rows.size(), 15u) << "no smaller one is known";
    EXPECT_LE(rows.size(), 26u) << "AETG has 15 to 20";
    for (const Tuple& pair : pairs)
        EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return holds(row, pair); }));
}

TEST(Covering, IsTheSameEachTime) {
    const Covering covering({4, 4, 4, 4, 3}, {{{{0, 1}, {4, 2}}}});
    std::vector<Tuple> pairs = covering.tuplesOf({0, 4});
    for (const Tuple& pair : covering.tuplesOf({1, 2})) pairs.push_back(pair);
    EXPECT_EQ(covering.cover(pairs, 5), covering.cover(pairs, 5));
}

TEST(Combinations, AreRefusedByATextThatNamesWhatThereIsNot) {
    EXPECT_THROW(rowFrom("scene hills.asc, light of the moon"), std::runtime_error);
    EXPECT_EQ(textOf(rowFrom("scene wax, size 1x1")), "scene wax, size 1x1");
}

TEST(Combinations, HoldEveryPairThatIsAllowed) {
    const Covering all = covering();
    const std::vector<Tuple> tuples = wantedTuples(all, std::getenv("STEREONAV_ALL_TRIPLES") != nullptr);
    const std::vector<Row> rows = all.cover(tuples, kCombinationsSeed);
    const std::vector<Clause> clauses = clausesOf(rules());
    for (const Row& row : rows) {
        EXPECT_TRUE(allowed(row, clauses)) << textOf(row);
        EXPECT_EQ(rowFrom(textOf(row)), row) << textOf(row);
    }
    long long covered = 0;
    for (const Tuple& tuple : tuples) {
        const bool held =
            std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return holds(row, tuple); });
        // What is in no row must not be possible at all.
        EXPECT_EQ(held, all.complete(tuple, 1).has_value());
        covered += held;
    }
    std::printf("%zu combinations hold %lld pairs or triples; %lld others are not allowed\n", rows.size(),
                covered, static_cast<long long>(tuples.size()) - covered);
}

}  // namespace
}  // namespace stereonav::test
