#include "app/view/second_side.h"

#include <utility>

#include "app/scene/shown_as.h"
#include "engine/base/error.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_match.h"

namespace stereonav {

SecondSide::SecondSide(std::optional<ViewSession>& session, SceneSettings& settings, Notices& notices,
                       SceneChanges& changes, const ViewDisplay& display)
    : mSession(session),
      mSettings(settings),
      mNotices(notices),
      mChanges(changes),
      mDisplay(display),
      mSecond([] { Window::wake(); }) {}

// Choices in the flown study do not apply to the other one.
void SecondSide::open(const std::string& study) {
    if (!mSession) return;
    mNotices.forgetFailure();
    mNotices.tryTo([&] {
        const Scene& flown = *mSession->open().scene;
        if (!flown.offered<const MatchingLine>() || !flown.offered<RayCast>())
            throw Error(study, "", "the scene that is open has no centreline to match", "open a colon first");
        SettingTexts settings = mSettings.now();
        const std::string name = mSettings.options().scene.scene;
        for (const char* key : {"series", "label", "seed", "include", "exclude", "path", "pose", "paint"})
            settings.erase(key);
        settings["SCENE"] = {study};
        settings["with"] = {name};
        ViewOptions options = viewOptionsOf(settings);
        if (shownAs(options.scene).swept)
            throw Error(study, "", "expected a study that is shown as a surface", "name a CT study");
        options.scene.skyTurns = true;
        const SizeOption size = mDisplay.windowSize();
        checkMethod(options.scene, options.method);
        checkSize(size, options.scene, kViewBytes);
        mMade = {options, settingTextsOf(options.scene.given), fileTextsOf(options.scene.given)};
        mSlices.reset();
        mSecond.open(mSession->openShared(), [options, size](Progress& progress) {
            return openScene(options, false, size, nullptr, progress);
        });
    });
}

void SecondSide::begin() {
    if (const auto arrival = mChanges.takeArrival()) {
        if (arrival->study) mSession->slices().keepStudy(arrival->study);
        return mSession->goTo(arrival->pose);
    }
    mSecond.close();
    mSlices.reset();
    const SettingTexts& given = mSettings.given();
    if (const auto with = given.find("with"); with != given.end() && !with->second.empty())
        open(std::string(with->second.back()));
}

void SecondSide::follow() {
    try {
        if (mSecond.poll())
            mSession->notify(mSecond.matches() ? "the other study is there: F3"
                                               : "the other study is not of the same colon: F3");
    } catch (const Cancelled&) {
        mSession->notify("the other study was not opened");
    } catch (const std::exception& error) {
        mNotices.fail(error.what());
    }
}

SettingTexts SecondSide::settingsToOpen() const {
    SettingTexts texts = mSettings.now();
    if (mSecond.other()) texts["with"] = {mMade.options.scene.scene};
    return texts;
}

void SecondSide::swap() {
    if (!mSession || !mSecond.other() || mChanges.loading().busy) return;
    const auto place = mSecond.matching(*mSession->open().scene, mSession->pose());
    if (!place) return;
    const Pose pose = mSecond.poseAt(*place);
    const std::shared_ptr<const OpenScene> next = mSecond.swap(mSession->openShared());
    SceneMade flown{mSettings.options(), mSettings.now(), mSettings.made().said};
    const SceneMade second = std::exchange(mMade, flown);
    mChanges.goTo(next, second, flown, {pose, std::exchange(mSlices, mSession->slices().study())});
}

}  // namespace stereonav
