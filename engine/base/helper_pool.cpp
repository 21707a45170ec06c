#include "engine/base/helper_pool.h"

#include <algorithm>
#include <utility>

namespace stereonav {

HelperPool::HelperPool(std::string name, std::string purpose, std::size_t mostIdle)
    : mName(std::move(name)), mPurpose(std::move(purpose)), mMostIdle(mostIdle) {}

std::unique_ptr<HelperProgram> HelperPool::take(const std::filesystem::path& folder) {
    {
        const std::lock_guard lock(mLock);
        const auto found =
            std::find_if(mIdle.begin(), mIdle.end(), [&](const Idle& idle) { return idle.folder == folder; });
        if (found != mIdle.end()) {
            std::unique_ptr<HelperProgram> helper = std::move(found->helper);
            mIdle.erase(found);
            return helper;
        }
    }
    return std::make_unique<HelperProgram>(mName, mPurpose);
}

// The one that has waited longest makes room.
void HelperPool::keep(Idle idle) {
    Idle dropped;  // ends outside the lock
    const std::lock_guard lock(mLock);
    mIdle.push_back(std::move(idle));
    if (mIdle.size() <= mMostIdle) return;
    dropped = std::move(mIdle.front());
    mIdle.erase(mIdle.begin());
}

HelperAnswer HelperPool::ask(const std::filesystem::path& folder, std::string_view request,
                             const HelperLimits& limits) {
    std::unique_ptr<HelperProgram> helper = take(folder);
    HelperAnswer answer = helper->ask(request, limits);
    if (answer.kind == HelperAnswer::Kind::Given) keep({folder, std::move(helper)});
    return answer;
}

}  // namespace stereonav
