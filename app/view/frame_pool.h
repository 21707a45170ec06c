// Frames that are no longer used, for reuse.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "app/view/view_frame.h"

namespace stereonav {

class FramePool : public std::enable_shared_from_this<FramePool> {
public:
    // Most free frames to keep. While many pictures are being saved more are in use; those beyond this number
    // are deleted when they come back.
    static constexpr std::size_t kMostFree = 4;

    std::unique_ptr<ViewFrame> take() {
        const std::lock_guard lock(mMutex);
        if (mFree.empty()) return std::make_unique<ViewFrame>();
        auto frame = std::move(mFree.back());
        mFree.pop_back();
        return frame;
    }
    // Shares a frame, which returns to the pool when its last reader releases it, on any thread.
    std::shared_ptr<const ViewFrame> share(std::unique_ptr<ViewFrame> frame) {
        return {frame.release(), [pool = shared_from_this()](const ViewFrame* done) {
                    std::unique_ptr<ViewFrame> free(const_cast<ViewFrame*>(done));
                    const std::lock_guard lock(pool->mMutex);
                    if (pool->mFree.size() < kMostFree) pool->mFree.push_back(std::move(free));
                }};
    }
    std::size_t free() const {
        const std::lock_guard lock(mMutex);
        return mFree.size();
    }

private:
    mutable std::mutex mMutex;
    std::vector<std::unique_ptr<ViewFrame>> mFree;  // guarded by mMutex
};

}  // namespace stereonav
