// The one line a person reads: its parts, its separators, and that it stays one line.
#include "engine/base/error.h"

#include <gtest/gtest.h>

#include "engine/base/progress.h"

namespace stereonav {
namespace {

TEST(Error, NamesFilePlaceProblemAndAdvice) {
    const Error error("scan.toml", "12", "expected 3 positive numbers, got 2", "give x, y and z");
    EXPECT_STREQ(error.what(), "scan.toml:12: expected 3 positive numbers, got 2; give x, y and z");
}

TEST(Error, LeavesOutWhatIsEmpty) {
    EXPECT_STREQ(Error("", "", "no display", "").what(), "no display");
    EXPECT_STREQ(Error("a.tif", "", "is empty", "").what(), "a.tif: is empty");
    EXPECT_STREQ(Error("", "--size", "is 0", "give 1 or more").what(), "--size: is 0; give 1 or more");
}

TEST(Error, StaysOneLineWhateverItsPartsHold) {
    const std::string line = Error("a\nb", "1\r", "first\r\nsecond", "third\n").what();
    EXPECT_EQ(line.find_first_of("\r\n"), std::string::npos) << line;
    EXPECT_NE(line.find("second"), std::string::npos);
}

TEST(Progress, ReportsUntilCancelled) {
    double last = -1;
    Progress progress([&](double fraction, const std::string&) { last = fraction; });
    progress.report(0.25, "reading");
    EXPECT_EQ(last, 0.25);
    progress.cancel();
    EXPECT_THROW(progress.report(0.5, "reading"), Cancelled);
    EXPECT_EQ(last, 0.25) << "a cancelled job must not report further";
}

TEST(Progress, WithoutListenerIsSilent) {
    Progress progress;
    EXPECT_NO_THROW(progress.report(1.0, "done"));
}

}  // namespace
}  // namespace stereonav
