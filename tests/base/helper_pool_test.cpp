// Helper processes that a pool keeps: which requests they serve, and how long they are kept.
#include "engine/base/helper_pool.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace stereonav {
namespace {

constexpr HelperLimits kSmall{100};

class HelperPools : public testing::Test {
protected:
    std::string who(const std::string& folder) { return mPool.ask(folder, "who", kSmall).text; }
    static bool isThere(const std::string& process) { return kill(std::atoi(process.c_str()), 0) == 0; }

    HelperPool mPool{"test_helper", "by this test", 1};
};

TEST_F(HelperPools, OneFolderIsServedByOneHelper) {
    const std::string first = who("/a");
    EXPECT_NE(first, "");
    EXPECT_EQ(who("/a"), first);
    EXPECT_EQ(who("/a"), first);
}

TEST_F(HelperPools, AHelperThatHasSeenOneFolderSeesNoOther) {
    const std::string first = who("/a"), second = who("/b");
    EXPECT_NE(second, first);
    EXPECT_FALSE(isThere(first)) << "one is kept";
    EXPECT_EQ(who("/b"), second);
    EXPECT_NE(who("/a"), second);
}

TEST_F(HelperPools, OneThatRefusedOrEndedIsNotAskedAgain) {
    for (const char* request : {"throw", "crash",
                                "echo more than the hundred bytes that its answer may have, "
                                "so that nobody knows what else it has in store: it is gone"}) {
        const std::string first = who("/a");
        EXPECT_NE(mPool.ask("/a", request, kSmall).kind, HelperAnswer::Kind::Given);
        EXPECT_FALSE(isThere(first)) << request;
        EXPECT_NE(who("/a"), first);
    }
}

TEST(HelperPoolOfMany, EachThreadThatAsksAtOnceHasItsOwn) {
    constexpr std::size_t kThreads = 4;
    HelperPool pool("test_helper", "by this test", kThreads);
    std::vector<std::string> answers(kThreads);
    std::vector<std::thread> threads;
    for (std::size_t n = 0; n < kThreads; ++n)
        threads.emplace_back([&, n] {
            for (int k = 0; k < 20; ++k) answers[n] = pool.ask("", "echo " + std::to_string(n), kSmall).text;
        });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t n = 0; n < kThreads; ++n) EXPECT_EQ(answers[n], std::to_string(n));
}

TEST(HelperPoolOfMany, EndsWithItsHelpers) {
    std::string process;
    {
        HelperPool pool("test_helper", "by this test", 1);
        process = pool.ask("", "who", kSmall).text;
        EXPECT_EQ(kill(std::atoi(process.c_str()), 0), 0);
    }
    EXPECT_NE(kill(std::atoi(process.c_str()), 0), 0);
}

}  // namespace
}  // namespace stereonav
