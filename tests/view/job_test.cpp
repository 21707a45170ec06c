// Commands that run beside the window: their progress, their end, what is left of one that was stopped.
#include "app/view/job.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// Until it has ended; the largest share that was seen before.
double waitFor(Job& job, bool cancelAtOnce = false) {
    double most = 0;
    while (job.running()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        job.look();
        if (job.running()) most = std::max(most, job.fraction());
        if (cancelAtOnce && job.fraction() > 0) job.cancel();
    }
    return most;
}

std::filesystem::path fileOf(const char* name) {
    return std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + name);
}

TEST(JobProgress, LinesAreRead) {
    double share = -1;
    std::string words;
    EXPECT_TRUE(progressOf(" 33 % frame 17 of 48, 2 s", share, words));
    EXPECT_EQ(share, 0.33);
    EXPECT_EQ(words, "frame 17 of 48, 2 s");
    EXPECT_TRUE(progressOf("[====>     ]  42 % reading", share, words));
    EXPECT_EQ(share, 0.42);
    EXPECT_TRUE(progressOf("100 % done", share, words));
    EXPECT_EQ(share, 1);
    for (const char* other :
         {"", "%", " % ", "50 %", "a 50 % share", "12345 % of it", "stereonav: 50 % of it"})
        EXPECT_FALSE(progressOf(other, share, words)) << other;
}

TEST(Job, MakesAMovieAndTellsItsProgress) {
    const std::filesystem::path file = fileOf("_job.mkv");
    Job job("a movie", {"play", "terrain", "--size=640x360", "--frames=60", "--video=" + file.string()},
            STEREONAV_PROGRAM);
    EXPECT_GT(waitFor(job), 0);
    EXPECT_FALSE(job.failed()) << job.lastLine();
    EXPECT_EQ(job.fraction(), 1);
    EXPECT_TRUE(std::filesystem::exists(file));
    std::filesystem::remove(file);
}

TEST(Job, ACancelLeavesNoHalfFile) {
    const std::filesystem::path file = fileOf("_cancelled.mkv");
    Job job("a movie", {"play", "terrain", "--size=640x360", "--frames=2000", "--video=" + file.string()},
            STEREONAV_PROGRAM);
    waitFor(job, true);
    EXPECT_TRUE(job.cancelled());
    EXPECT_FALSE(job.failed());
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Job, AFailureIsTold) {
    Job job("a movie", {"play", "terrain", "--video=/nowhere/at/all.mp4"}, STEREONAV_PROGRAM);
    waitFor(job);
    EXPECT_TRUE(job.failed());
    EXPECT_THAT(job.lastLine(), testing::HasSubstr("/nowhere/at"));
    EXPECT_THROW(Job("nothing", {}, "/nowhere/at/all"), Error);
}

TEST(Job, EndsWithItsOwner) {
    const auto start = std::chrono::steady_clock::now();
    {
        const Job job("a movie", {"play", "terrain", "--frames=100000", "--hash"}, STEREONAV_PROGRAM);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace stereonav
