// Steps of settings for undo and redo. A step is everything that was changed until things came to rest: a
// drag, or a key that was held.
#pragma once

#include <optional>
#include <vector>

#include "app/view/setting_texts.h"

namespace stereonav {

class SettingsHistory {
public:
    // Begins with the settings that a scene was opened with.
    void start(SettingTexts now);
    // Observes the settings. dt: seconds since the last call; changing: a control is held.
    void observe(const SettingTexts& now, bool changing, double dt);

    bool canUndo() const { return mAt > 0 || mPending; }
    bool canRedo() const { return mAt + 1 < mSteps.size() && !mPending; }
    // Removes a step that failed. now: the settings in effect.
    void backTo(const SettingTexts& now);

    // Return the settings to go to; empty where there are none. They have to be in effect at the next
    // observe().
    std::optional<SettingTexts> undo();
    std::optional<SettingTexts> redo();

private:
    void keep();

    std::vector<SettingTexts> mSteps;  // mSteps[mAt] is in effect, or was before the pending changes
    std::size_t mAt = 0;
    std::optional<SettingTexts> mPending;
    double mRest = 0;  // seconds without further changes
};

}  // namespace stereonav
