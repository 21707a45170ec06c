// Frames that nobody looks at any more, to be used again.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "app/view/worker.h"

namespace stereonav {

class FramePool : public std::enable_shared_from_this<FramePool> {
public:
    // The most that are kept. More are in use where many pictures are saved at a time: those are let go.
    static constexpr std::size_t kMostFree = 4;

    std::unique_ptr<ViewFrame> take() {
        const std::lock_guard lock(mMutex);
        if (mFree.empty()) return std::make_unique<ViewFrame>();
        auto frame = std::move(mFree.back());
        mFree.pop_back();
        return frame;
    }
    // Comes back here when its last reader lets it go, on whatever thread.
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
