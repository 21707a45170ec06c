// Keys, clicks, drags and sizes by chance: the window goes on, ends as it should, and says nothing that is
// wrong.
#include <algorithm>
#include <cstdio>
#include <sstream>

#include "tests/window/window_test.h"

namespace stereonav {
namespace {

class RandomWindowNightly : public WindowTest {
protected:
    void TearDown() override {
        unsetenv("MESA_DEBUG");
        WindowTest::TearDown();
    }
};

TEST_F(RandomWindowNightly, StandsWhatComesByChance) {
    constexpr int kRounds = 10;
    setenv("MESA_DEBUG", "1", 1);  // wrong calls of OpenGL are told
    ASSERT_EQ(drive("drive_random.sh", std::to_string(kRounds) + " 20261123 terrain"), 0)
        << textOf("log.txt");
    const std::string events = textOf("events.txt");
    EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 16 * kRounds)
        << "eight things, a breath after each";

    std::istringstream runs(textOf("runs.txt"));
    int count = 0;
    for (std::string line; std::getline(runs, line); ++count) {
        // A run that a click ended at once has no figures.
        int status = -1;
        long threads[2] = {}, files[2] = {}, kibibytes[2] = {};
        const int read =
            std::sscanf(line.c_str(), "status %d first %ld %ld %ld last %ld %ld %ld", &status, &threads[0],
                        &files[0], &kibibytes[0], &threads[1], &files[1], &kibibytes[1]);
        EXPECT_EQ(status, 0) << line;
        if (read < 7) continue;
        // A job, a file that is looked at, slices that are read; other built-in scenes.
        EXPECT_LE(threads[1], threads[0] + 8) << line;
        EXPECT_LE(files[1], files[0] + 12) << line;
        EXPECT_LE(kibibytes[1], kibibytes[0] + 500'000) << line;
    }
    EXPECT_GT(count, 0);
    const std::string log = textOf("log.txt");
    for (const char* word : {"Sanitizer", "runtime error", "User error", "did not end", "terminate called",
                             "stereonav: ", "Assertion"})
        EXPECT_THAT(log, testing::Not(testing::HasSubstr(word)));
}

}  // namespace
}  // namespace stereonav
