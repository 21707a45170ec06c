// What was set, step by step, to go back and forth in. A step is what was changed until things came to rest:
// a drag, or a key that was held.
#pragma once

#include <optional>
#include <vector>

#include "app/view/setting_texts.h"

namespace stereonav {

class SettingsHistory {
public:
    // Begins anew: with what a scene was opened with.
    void start(SettingTexts now);
    // Of every look at the settings. dt: seconds since the last; changing: a control is held.
    void observe(const SettingTexts& now, bool changing, double dt);

    bool canUndo() const { return mAt > 0 || mPending; }
    bool canRedo() const { return mAt + 1 < mSteps.size() && !mPending; }
    // What was set, or gone to, did not come about: it is no step. now: what holds all the same.
    void backTo(const SettingTexts& now);

    // What to go to; none where there is nothing. The settings are to be so when they are observed next.
    std::optional<SettingTexts> undo();
    std::optional<SettingTexts> redo();

private:
    void keep();

    std::vector<SettingTexts> mSteps;  // mSteps[mAt] is what holds, or held before what is pending
    std::size_t mAt = 0;
    std::optional<SettingTexts> mPending;
    double mRest = 0;  // seconds that the pending ones stay as they are
};

}  // namespace stereonav
