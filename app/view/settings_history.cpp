#include "app/view/settings_history.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace stereonav {
namespace {

constexpr double kRestSeconds = 0.6;
constexpr std::size_t kMostSettings = 500;

}  // namespace

void SettingsHistory::start(SettingTexts now) {
    mSteps.assign(1, std::move(now));
    mAt = 0;
    mPending.reset();
}

void SettingsHistory::observe(const SettingTexts& now, bool changing, double dt) {
    if (mSteps.empty()) return start(now);
    const SettingTexts& last = mPending ? *mPending : mSteps[mAt];
    if (now != last) {
        mRest = 0;
        if (now == mSteps[mAt])
            mPending.reset();
        else
            mPending = now;
        return;
    }
    mRest = changing ? 0 : mRest + dt;
    if (mPending && mRest >= kRestSeconds) keep();
}

void SettingsHistory::keep() {
    mSteps.resize(mAt + 1);
    mSteps.push_back(*std::exchange(mPending, std::nullopt));
    if (mSteps.size() > kMostSettings) mSteps.erase(mSteps.begin());
    mAt = mSteps.size() - 1;
}

void SettingsHistory::backTo(const SettingTexts& now) {
    mPending.reset();
    const auto isNow = [&](const SettingTexts& step) { return step == now; };
    const auto here = mSteps.begin() + static_cast<std::ptrdiff_t>(mAt);
    // The settings in effect are those of a later step where an undo failed. That step becomes the present
    // one; the steps after it stay.
    if (const auto after = std::find_if(here, mSteps.end(), isNow); after != mSteps.end()) {
        mAt = static_cast<std::size_t>(after - mSteps.begin());
        return;
    }
    const auto before = std::find_if(std::reverse_iterator(here), mSteps.rend(), isNow);
    if (before == mSteps.rend()) return;
    mSteps.erase(before.base(), mSteps.end());
    mAt = mSteps.size() - 1;
}

std::optional<SettingTexts> SettingsHistory::undo() {
    if (mPending) keep();
    if (mAt == 0) return std::nullopt;
    return mSteps[--mAt];
}

std::optional<SettingTexts> SettingsHistory::redo() {
    if (mPending) keep();
    if (mAt + 1 >= mSteps.size()) return std::nullopt;
    return mSteps[++mAt];
}

}  // namespace stereonav
