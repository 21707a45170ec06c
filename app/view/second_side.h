// The second study beside the one that is flown: how it is opened, and how the two are swapped.
#pragma once

#include <memory>
#include <string>

#include "app/view/scene_changes.h"
#include "app/view/second_study.h"

namespace stereonav {

class SecondSide {
public:
    // All of them outlive this.
    SecondSide(std::optional<ViewSession>& session, SceneSettings& settings, Notices& notices,
               SceneChanges& changes, const PanelStage& stage);

    SecondStudy& study() { return mSecond; }
    // In the place of the one that is there. What fails is told.
    void open(const std::string& study);
    // A session begins: where the last one was swapped its study stays, else it has what its settings say.
    void begin();
    // Each turn: takes what was loaded.
    void follow();
    // What opens both again.
    SettingTexts settingsToOpen() const;
    // Flies on in the second study at the matching place; the flown one becomes the second.
    void swap();

private:
    std::optional<ViewSession>& mSession;
    SceneSettings& mSettings;
    Notices& mNotices;
    SceneChanges& mChanges;
    const PanelStage& mStage;
    SecondStudy mSecond;
    SceneMade mMade;                            // what it is, or is being, made of
    std::shared_ptr<const SliceStudy> mSlices;  // its own, once read
};

}  // namespace stereonav
