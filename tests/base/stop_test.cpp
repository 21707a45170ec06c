// How long a run that is to stop may take until it ends at once.
#include "engine/base/stop.h"

#include <gtest/gtest.h>

namespace stereonav {
namespace {

TEST(StoppingTime, LeavesTheSystemTimeToTakeMemoryBack) {
    EXPECT_EQ(stoppingTime_ms(0), kMostStopping_ms);
    EXPECT_EQ(stoppingTime_ms(4e9), kMostStopping_ms - 200);
    EXPECT_GT(stoppingTime_ms(1e13), 0) << "what is unfinished is taken away first";
    for (double bytes = 0; bytes < 1e11; bytes += 1e9)
        EXPECT_LE(stoppingTime_ms(bytes + 1e9), stoppingTime_ms(bytes));
}

}  // namespace
}  // namespace stereonav
