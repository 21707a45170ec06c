// Helper programs: what they answer, and that nothing they do ends the program or gets out of them.
#include "engine/base/helper_program.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "tests/support/lying_helper.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using Kind = HelperAnswer::Kind;

constexpr HelperLimits kMost{1 << 24};

HelperLimits within(std::chrono::milliseconds wait) {
    HelperLimits limits = kMost;
    limits.wait = wait;
    return limits;
}

bool isThere(int process) {
    return kill(process, 0) == 0;
}

TEST(HelperProgram, AnswersOneRequestAfterTheOther) {
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("echo a", kMost).text, "a");
    EXPECT_EQ(helper.ask("echo ", kMost).text, "");
    const std::string much(5'000'000, '\0');  // more than a socket holds
    const HelperAnswer answer = helper.ask("echo " + much, kMost);
    EXPECT_EQ(answer.kind, Kind::Given);
    EXPECT_TRUE(answer.text == much);
}

TEST(HelperProgram, TellsWhatItRefusesAndGoesOn) {
    HelperProgram helper("test_helper", "by this test");
    const HelperAnswer answer = helper.ask("throw", kMost);
    EXPECT_EQ(answer.kind, Kind::Refused);
    EXPECT_EQ(answer.text, "expected a sound request");
    EXPECT_EQ(helper.ask("echo b", kMost).text, "b");
}

TEST(HelperProgram, ItsEndIsAnAnswer) {
    HelperLimits limits = kMost;
    limits.work = std::chrono::seconds(0);
    for (const auto& [request, reason] :
         {std::pair{"leave", "with status 7"}, {"spin", "by CPU time"}, {"close", "by Killed"}}) {
        HelperProgram helper("test_helper", "by this test");
        const HelperAnswer answer = helper.ask(request, limits);
        EXPECT_EQ(answer.kind, Kind::Ended) << request;
        EXPECT_THAT(answer.text, HasSubstr(reason));
        EXPECT_EQ(helper.ask("echo c", kMost).kind, Kind::Ended) << "asked again";
    }
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("crash", kMost).kind, Kind::Ended);  // sanitizers end it in their own way
}

TEST(HelperProgram, AnswersThatAreTooLongAreNotTaken) {
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("echo 1234", {4}).text, "1234");
    EXPECT_EQ(helper.ask("echo 12345", {4}).kind, Kind::Ended);
}

TEST(HelperProgram, RefusalsAreLinesOfLetters) {
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("throw \x1b[2J\nred\xc2\x9b", kMost).text, "?[2J?red??");
    EXPECT_EQ(helper.ask("throw " + std::string(100'000, 'a'), kMost).kind, Kind::Ended);
}

// However long that may be: whoever does not answer is not waited for.
TEST(HelperProgram, OneThatSleepsIsEnded) {
    HelperProgram helper("test_helper", "by this test");
    const int process = helper.processId();
    const HelperAnswer answer = helper.ask("sleep", within(std::chrono::milliseconds(30)));
    EXPECT_EQ(answer.kind, Kind::Ended);
    EXPECT_THAT(answer.text, HasSubstr("without an answer"));
    EXPECT_FALSE(isThere(process));
    waitForHelpersAtMost(std::chrono::milliseconds(30));
    EXPECT_EQ(HelperProgram("test_helper", "by this test").ask("sleep", kMost).kind, Kind::Ended);
    waitForHelpersAtMost(std::chrono::hours(1));
}

TEST(HelperProgram, WhatAStrangerSaysThroughItIsNoAnswer) {
    const std::string good = test::helperMessage("ab");
    const std::pair<std::string, const char*> kSaid[] = {
        {test::helperMessage("ab", 2), "malformed"},  // Ended is not said, but seen
        {test::helperMessage("ab", 77), "malformed"},
        {test::helperMessage("ab", ~0ull), "malformed"},
        {test::helperMessage("ab", 0, 1ll << 62), "malformed"},
        {test::helperMessage("ab", 1, 1ll << 62), "malformed"},
        {test::helperMessage("ab", 0, 3), "without an answer"},
        {good.substr(0, 5), "without an answer"},
        {"", "without an answer"},  // nor does it read
    };
    for (const auto& [said, reason] : kSaid) {
        const test::LyingHelper liar("lies", said);
        HelperProgram helper("lies", "by this test");
        const bool late = std::string_view(reason).starts_with("without");
        const HelperAnswer answer =
            helper.ask(std::string(4'000'000, 'a'), late ? within(std::chrono::milliseconds(30)) : kMost);
        EXPECT_EQ(answer.kind, Kind::Ended) << testing::PrintToString(said);
        EXPECT_THAT(answer.text, HasSubstr(reason)) << testing::PrintToString(said);
    }
    const test::LyingHelper honest("lies", good + "more");
    HelperProgram helper("lies", "by this test");
    EXPECT_EQ(helper.ask("", kMost).text, "ab");
}

TEST(HelperProgram, MemoryBeyondItsLimitIsRefused) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers take memory as they like";
#endif
    HelperProgram helper("test_helper", "by this test");
    HelperLimits limits = kMost;
    limits.memory = 64 << 20;
    EXPECT_EQ(helper.ask("take", limits).text, "refused");
    limits.memory = std::uint64_t{1} << 30;
    EXPECT_EQ(helper.ask("take", limits).text, "taken") << "limits are of a request";
}

TEST(HelperProgram, PrintsNothing) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::string said;
    {
        HelperProgram helper("test_helper", "by this test");
        said = helper.ask("print", kMost).text;
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(said, "printed");
}

TEST(HelperProgram, EndsWithItsOwner) {
    int process = 0;
    {
        const HelperProgram helper("test_helper", "by this test");
        process = helper.processId();
        EXPECT_TRUE(isThere(process));
    }
    EXPECT_FALSE(isThere(process));
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(HelperProgram, SeveralWorkAtOnce) {
    std::vector<std::string> answers(8);
    std::vector<std::thread> threads;
    for (std::size_t n = 0; n < answers.size(); ++n)
        threads.emplace_back([&answers, n] {
            HelperProgram helper("test_helper", "by this test");
            answers[n] = helper.ask("echo " + std::to_string(n), kMost).text;
        });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t n = 0; n < answers.size(); ++n) EXPECT_EQ(answers[n], std::to_string(n));
}

std::string helperFailure(const std::string& name,
                          std::chrono::milliseconds startWithin = std::chrono::minutes(5)) {
    try {
        const HelperProgram helper(name, "by this test", startWithin);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(HelperProgram, MissingOrWrongOnesAreNamed) {
    EXPECT_THAT(helperFailure("nothing"), AllOf(HasSubstr((moduleFolder() / "stereonav_nothing").string()),
                                                HasSubstr("No such file"), HasSubstr("by this test")));
    const fs::path broken = moduleFolder() / "stereonav_test_broken_helper";
    std::ofstream(broken) << "#!/bin/sh\nexit 3\n";
    fs::permissions(broken, fs::perms::owner_all);
    EXPECT_THAT(helperFailure("test_broken_helper"), HasSubstr("it ended with status 3"));
    std::ofstream(broken) << "#!/bin/sh\nprintf 'another build, and long enough for a head' >&0\n";
    EXPECT_THAT(helperFailure("test_broken_helper"), HasSubstr("another build"));
    std::ofstream(broken) << "#!/bin/sh\nexec sleep 3600\n";
    EXPECT_THAT(helperFailure("test_broken_helper", std::chrono::milliseconds(30)),
                HasSubstr("no word from it"));
    fs::remove(broken);
}

}  // namespace
}  // namespace stereonav
