// Commands that run beside the window: their progress, their end, and what a stopped one leaves.
#include "app/view/job.h"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <optional>

#include "engine/base/error.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

void awaitEnd(Job& job) {
    ASSERT_TRUE(test::waitFor([&] {
        job.look();
        return !job.running();
    }));
}

// Waits until there is text on its progress: it is working.
void awaitProgress(Job& job) {
    ASSERT_TRUE(test::waitFor([&] {
        job.look();
        return !job.progress().empty() || !job.running();
    }));
    ASSERT_TRUE(job.running()) << job.lastLine();
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

TEST(Job, TellsItsProgressWhileItRuns) {
    const TemporaryFolder folder;
    const std::filesystem::path script = folder / "script", gate = folder / "gate";
    std::ofstream(script) << "#!/bin/sh\necho ' 33 % frame 17 of 48'\n"
                          << "while [ -e '" << gate.string() << "' ]; do sleep 0.01; done\necho done\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    std::ofstream(gate) << "shut";
    Job job("a script", {}, script.c_str());
    ASSERT_NO_FATAL_FAILURE(awaitProgress(job));
    EXPECT_EQ(job.fraction(), 0.33);
    EXPECT_EQ(job.progress(), "frame 17 of 48");
    std::filesystem::remove(gate);
    ASSERT_NO_FATAL_FAILURE(awaitEnd(job));
    EXPECT_FALSE(job.failed()) << job.lastLine();
    EXPECT_EQ(job.fraction(), 1);
    EXPECT_EQ(job.lastLine(), "done");
}

TEST(Job, MakesAMovie) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "job.mkv";
    Job job("a movie", {"play", "terrain", "--size=640x360", "--frames=60", "--video=" + file.string()},
            STEREONAV_PROGRAM);
    ASSERT_NO_FATAL_FAILURE(awaitEnd(job));
    EXPECT_FALSE(job.failed()) << job.lastLine();
    EXPECT_EQ(job.fraction(), 1);
    EXPECT_TRUE(std::filesystem::exists(file));
}

// A movie that would take hours.
TEST(Job, ACancelLeavesNoHalfFile) {
    const TemporaryFolder folder;
    Job job("a movie",
            {"play", "terrain", "--size=640x360", "--frames=1000000",
             "--video=" + (folder / "cancelled.mkv").string()},
            STEREONAV_PROGRAM);
    ASSERT_NO_FATAL_FAILURE(awaitProgress(job));
    job.cancel();
    ASSERT_NO_FATAL_FAILURE(awaitEnd(job));
    EXPECT_TRUE(job.cancelled());
    EXPECT_FALSE(job.failed());
    EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
}

TEST(Job, AFailureIsTold) {
    Job job("a movie", {"play", "terrain", "--video=/nowhere/at/all.mp4"}, STEREONAV_PROGRAM);
    ASSERT_NO_FATAL_FAILURE(awaitEnd(job));
    EXPECT_TRUE(job.failed());
    EXPECT_THAT(job.lastLine(), testing::HasSubstr("/nowhere/at"));
    EXPECT_THROW(Job("nothing", {}, "/nowhere/at/all"), Error);
}

// A job that would take hours.
TEST(Job, EndsWithItsOwner) {
    std::optional<Job> job(std::in_place, "a movie",
                           std::vector<std::string>{"play", "terrain", "--frames=1000000", "--hash"},
                           STEREONAV_PROGRAM);
    ASSERT_NO_FATAL_FAILURE(awaitProgress(*job));
    const int process = job->processId();
    const std::future<void> end = std::async(std::launch::async, [&] { job.reset(); });
    EXPECT_TRUE(
        test::waitFor([&] { return end.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
    EXPECT_EQ(kill(process, 0), -1) << "no child is left";
}

}  // namespace
}  // namespace stereonav
