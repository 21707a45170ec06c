// Helper programs: what they answer, and that nothing they do ends the program or gets out of them.
#include "engine/base/helper_program.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/module.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using Kind = HelperAnswer::Kind;

constexpr std::uint64_t kMost = 1 << 24;

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
    for (const auto& [request, reason] : {std::pair{"leave", "with status 7"}, std::pair{"spin", "by "}}) {
        HelperProgram helper("test_helper", "by this test");
        const HelperAnswer answer = helper.ask(request, kMost);
        EXPECT_EQ(answer.kind, Kind::Ended) << request;
        EXPECT_THAT(answer.text, HasSubstr(reason));
        EXPECT_EQ(helper.ask("echo c", kMost).kind, Kind::Ended) << "asked again";
    }
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("crash", kMost).kind, Kind::Ended);  // sanitizers end it in their own way
}

TEST(HelperProgram, AnswersThatAreTooLongAreNotTaken) {
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("echo 1234", 4).text, "1234");
    EXPECT_EQ(helper.ask("echo 12345", 4).kind, Kind::Ended);
}

TEST(HelperProgram, MemoryBeyondItsLimitIsRefused) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "sanitizers take memory as they like";
#endif
    HelperProgram helper("test_helper", "by this test");
    EXPECT_EQ(helper.ask("take", kMost).text, "refused");
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

std::string helperFailure(const std::string& name) {
    try {
        const HelperProgram helper(name, "by this test");
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
    fs::remove(broken);
}

}  // namespace
}  // namespace stereonav
