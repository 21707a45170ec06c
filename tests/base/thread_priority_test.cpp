#include "engine/base/thread_priority.h"

#include <gtest/gtest.h>

#include <thread>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

namespace stereonav {
namespace {

int own() {
    return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
}

TEST(ThreadPriority, StepsBackAloneWithWhatItStarts) {
    const int before = own();
    int inside = before, started = before;
    std::thread([&] {
        stepBehindTheWindow();
        inside = own();
        std::thread([&] { started = own(); }).join();
    }).join();
    EXPECT_EQ(own(), before) << "another thread's";
    EXPECT_EQ(started, inside);
    if (before < 19)
        EXPECT_GT(inside, before);
    else
        EXPECT_EQ(inside, before);
}

}  // namespace
}  // namespace stereonav
#endif
