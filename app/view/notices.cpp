#include "app/view/notices.h"

#include <cstdio>

#include "engine/base/file.h"

namespace stereonav {

Notices::Notices(const ViewOptions& options) : mResult("view", options.telling, {}), mJson(options.json) {}

void Notices::tell(const std::string& text) {
    constexpr std::size_t kMost = 10'000;
    if (text.empty()) return;
    if (mTold.size() < kMost) mTold.push_back(text);
    mResult.say(text + "\n");
    std::fflush(stdout);
}

void Notices::tryTo(const std::function<void()>& what) {
    try {
        what();
    } catch (const std::exception& error) {
        mFailure = error.what();
    }
}

void Notices::finish(const std::string& scene) {
    mResult.addScene(scene);
    mResult.add("told", mTold);
    mResult.finish();
    if (!mJson.empty() && !isStandardOutput(mJson)) mResult.writeTo(mJson);
}

}  // namespace stereonav
