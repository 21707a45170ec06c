// Frames come back for reuse, as many as are enough, and no more.
#include "app/view/frame_pool.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace stereonav {
namespace {

TEST(FramePool, GivesAFrameThatCameBack) {
    const auto pool = std::make_shared<FramePool>();
    auto frame = pool->take();
    const ViewFrame* const first = frame.get();
    auto shared = pool->share(std::move(frame));
    auto reader = shared;
    shared.reset();
    EXPECT_EQ(pool->free(), 0u) << "it is still read";
    reader.reset();
    EXPECT_EQ(pool->free(), 1u);
    EXPECT_EQ(pool->take().get(), first);
    EXPECT_EQ(pool->free(), 0u);
}

// Many frames in use, which happens where pictures are being saved.
TEST(FramePool, KeepsAFewHoweverManyWereInUse) {
    const auto pool = std::make_shared<FramePool>();
    std::vector<std::shared_ptr<const ViewFrame>> held;
    for (int n = 0; n < 60; ++n) held.push_back(pool->share(pool->take()));
    held.clear();
    EXPECT_EQ(pool->free(), FramePool::kMostFree);
    std::set<const ViewFrame*> again;
    for (std::size_t n = 0; n < FramePool::kMostFree; ++n) {
        held.push_back(pool->share(pool->take()));
        again.insert(held.back().get());
    }
    EXPECT_EQ(again.size(), FramePool::kMostFree) << "each is given once";
}

TEST(FramePool, OutlivesItsOwnerWithTheFramesThatAreRead) {
    auto pool = std::make_shared<FramePool>();
    const auto frame = pool->share(pool->take());
    const std::weak_ptr<FramePool> gone = pool;
    pool.reset();
    EXPECT_FALSE(gone.expired());
    frame->left.width();
}

}  // namespace
}  // namespace stereonav
