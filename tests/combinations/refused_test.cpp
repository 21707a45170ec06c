// What makes no sense together: for each rule and each choice of levels that breaks it and no other, the real
// program ends with exit status 1 and one line, and leaves nothing behind.
#include <gtest/gtest.h>

#include "tests/app/program.h"
#include "tests/combinations/inputs.h"

namespace stereonav::test {
namespace {

// One level of each part of the rule's clause, all ways.
std::vector<Tuple> waysOf(const Clause& clause) {
    std::vector<Tuple> ways{{}};
    for (const Clause::Part& part : clause.parts) {
        std::vector<Tuple> longer;
        for (const Tuple& way : ways)
            for (int level = 0; level < 32; ++level)
                if (part.levels >> level & 1) {
                    longer.push_back(way);
                    longer.back().push_back({part.factor, level});
                }
        ways = std::move(longer);
    }
    return ways;
}

// Returns some of the ways: few, but each level of each part is among them.
std::vector<Tuple> someOf(const std::vector<Tuple>& ways) {
    std::vector<Tuple> some;
    std::set<std::pair<int, int>> seen;
    for (const Tuple& way : ways) {
        bool news = false;
        for (const Level& at : way) news = seen.insert({at.factor, at.level}).second || news;
        if (news) some.push_back(way);
    }
    return some;
}

class RefusedCombinations : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
        std::filesystem::create_directory(mFolder / "inputs");
    }
};

TEST_F(RefusedCombinations, AreRefusedInOneLineEach) {
    Inputs inputs(mFolder / "inputs", [this](const Arguments& arguments) {
        const Outcome outcome = run(arguments);
        ASSERT_EQ(outcome.status, 0) << shellLine(arguments) << "\n" << outcome.err;
    });
    int refused = 0, rule = 0;
    for (const Rule& broken : rules()) {
        ++rule;
        if (!broken.isRefusal()) continue;
        std::vector<Rule> others = rules();
        others.erase(others.begin() + (rule - 1));
        const Covering all = coveringUnder(others);
        int tried = 0;
        for (const Tuple& way : someOf(waysOf(broken.clause))) {
            const std::optional<Row> row = all.complete(way, static_cast<std::uint64_t>(rule));
            if (!row) continue;
            const Arguments line = inputs.commandLine(*row);
            expectRefused(line, {broken.says});
            ++tried;
        }
        EXPECT_GT(tried, 0) << "no combination breaks only this rule: " << broken.why << ", " << broken.says;
        refused += tried;
    }
    std::printf("%d combinations refused, by %zu rules\n", refused, rules().size());
}

}  // namespace
}  // namespace stereonav::test
