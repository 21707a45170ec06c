// Progress in parts and in steps: exact at its ends, in order whatever the threads do, and stopped from
// above.
#include "engine/base/progress.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

using test::WrittenProgress;

TEST(ProgressPart, LiesBetweenItsEnds) {
    WrittenProgress whole;
    Progress first(whole.progress(), 0, 1.0 / 3), second(whole.progress(), 1.0 / 3, 1);
    first.report(0, "a");
    first.report(0.5, "a");
    first.report(1, "a");
    second.report(0, "b");
    second.report(1, "b");
    EXPECT_EQ(whole.told(), (std::vector<double>{0, 0.5 / 3, 1.0 / 3, 1.0 / 3, 1}));
}

TEST(ProgressPart, HandsNotesOn) {
    std::vector<std::string> notes;
    Progress whole({}, [&](const std::string& note) { notes.push_back(note); });
    Progress part(whole, 0, 0.5), within(part, 0.2, 0.4);
    within.note("a");
    whole.note("b");
    EXPECT_EQ(notes, (std::vector<std::string>{"a", "b"}));
    Progress deaf;
    Progress(deaf, 0, 1).note("nobody reads it");
}

// Sums of thirds and tenths are not exact: what is told at a part's end is its end.
TEST(ProgressPart, EndsExactlyWhereTheNextBegins) {
    for (int parts = 1; parts < 200; ++parts) {
        WrittenProgress whole;
        for (int n = 0; n < parts; ++n) {
            Progress part(whole.progress(), n / double(parts), (n + 1) / double(parts));
            Progress within(part, 0.1, 1);
            part.report(0, "");
            within.report(0, "");
            within.report(1, "");
        }
        whole.expectWhole(std::to_string(parts) + " parts");
    }
}

TEST(ProgressPart, WhoeverStopsTheWholeStopsIt) {
    Progress whole;
    Progress part(whole, 0, 1), within(part, 0, 1);
    EXPECT_FALSE(within.cancelled());
    whole.cancel();
    EXPECT_TRUE(within.cancelled());
    EXPECT_THROW(within.report(0, ""), Cancelled);
}

TEST(ProgressPart, OneThatIsStoppedLeavesTheOthers) {
    Progress whole;
    Progress part(whole, 0, 0.5), other(whole, 0.5, 1);
    part.cancel();
    EXPECT_THROW(part.report(0, ""), Cancelled);
    EXPECT_FALSE(whole.cancelled());
    EXPECT_NO_THROW(other.report(0, ""));
}

TEST(ProgressSteps, AreToldInOrderByAnyThreads) {
    for (const int count : {1, 2, 3, 7, 1000}) {
        WrittenProgress written;
        ProgressSteps steps(written.progress(), static_cast<std::size_t>(count), "steps");
        parallelFor(count, [&](int) { steps.done(); });
        const std::vector<double> told = written.told();
        ASSERT_EQ(told.size(), static_cast<std::size_t>(count) + 1);
        for (int n = 0; n <= count; ++n)
            ASSERT_EQ(told[static_cast<std::size_t>(n)], n / double(count)) << count << " " << n;
    }
}

TEST(ProgressSteps, NoneAreDoneAtOnce) {
    WrittenProgress written;
    const ProgressSteps steps(written.progress(), 0, "nothing");
    EXPECT_EQ(written.told(), (std::vector<double>{0, 1}));
}

TEST(ProgressSteps, AreStoppedBetweenTwo) {
    Progress progress;
    ProgressSteps steps(progress, 3, "steps");
    steps.done();
    progress.cancel();
    EXPECT_THROW(steps.done(), Cancelled);
}

// What the helper of all other tests refuses: else they could hold nothing.
TEST(WholeProgress, IsNotWhatBeginsLateGoesBackOrEndsEarly) {
    const auto failures = [](const std::vector<double>& told, std::size_t steps = 0) {
        testing::TestPartResultArray found;
        {
            const testing::ScopedFakeTestPartResultReporter catching(
                testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &found);
            WrittenProgress written;
            for (const double fraction : told) written.progress().report(fraction, "");
            written.expectWhole("it", steps);
        }
        return found.size();
    };
    EXPECT_EQ(failures({0, 0.2, 0.2, 1}, 1), 0);
    EXPECT_EQ(failures({0, 1}), 0);
    EXPECT_GT(failures({}), 0);
    EXPECT_GT(failures({0.1, 1}), 0);
    EXPECT_GT(failures({0, 0.999}), 0);
    EXPECT_GT(failures({0, 1, 1.5}), 0);
    EXPECT_GT(failures({0, 0.5, 0.4, 1}), 0);
    EXPECT_GT(failures({0, 1}, 1), 0) << "too few on the way";
}

}  // namespace
}  // namespace stereonav
