// The second study beside the one that is flown: opening it, and swapping the two.
#pragma once

#include <memory>
#include <string>

#include "app/view/scene_changes.h"
#include "app/view/second_study.h"

namespace stereonav {

class SecondSide {
public:
    // The arguments must outlive this object.
    SecondSide(std::optional<ViewSession>& session, SceneSettings& settings, Notices& notices,
               SceneChanges& changes, const ViewDisplay& display);

    SecondStudy& study() { return mSecond; }
    // Opens a study in place of the present second one. Failures become notices.
    void open(const std::string& study);
    // Begins a session: after a swap with the study of the last one, otherwise with the one that its settings
    // name.
    void begin();
    // Takes a loaded study; to be called each turn.
    void follow();
    // Returns the settings that open both studies again.
    SettingTexts settingsToOpen() const;
    // Goes on in the second study at the matching place; the flown one becomes the second.
    void swap();

private:
    std::optional<ViewSession>& mSession;
    SceneSettings& mSettings;
    Notices& mNotices;
    SceneChanges& mChanges;
    const ViewDisplay& mDisplay;
    SecondStudy mSecond;
    SceneMade mMade;                            // what it is made of, or is being made of
    std::shared_ptr<const SliceStudy> mSlices;  // slices of the second study, once read
};

}  // namespace stereonav
