// The viewer's part of a second study beside the one that is flown.
#include "app/scene/shown_as.h"
#include "app/view/viewer.h"
#include "engine/base/error.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_match.h"

namespace stereonav {

// What was chosen in the flown study is not of the other one.
void Viewer::openOther(const std::string& study) {
    if (!mSession) return;
    mNotices.forgetFailure();
    mNotices.tryTo([&] {
        const Scene& flown = *mScene->scene;
        if (!flown.offered<const MatchingLine>() || !flown.offered<RayCast>())
            throw Error(study, "", "what is open has no line to match it with", "open a colon first");
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
        options.mode = mMode;
        checkMethod(options.scene, options.method);
        checkSize(windowSize(), options.scene, kViewBytes);
        mSecondMade = {options, settingTextsOf(options.scene.given), fileTextsOf(options.scene.given)};
        mSecondSlices.reset();
        mSecond.open(mScene, [options, size = windowSize()](Progress& progress) {
            return openScene(options, false, size, nullptr, progress);
        });
    });
}

// What the scene that begins says of another one; after a swap that is there.
void Viewer::beginSecond() {
    if (mSwapTo) {
        if (mSwapSlices) mSession->keepStudy(std::exchange(mSwapSlices, nullptr));
        return mSession->goTo(*std::exchange(mSwapTo, std::nullopt));
    }
    mSecond.close();
    mSecondSlices.reset();
    if (const auto with = mSettings.given().find("with");
        with != mSettings.given().end() && !with->second.empty())
        openOther(std::string(with->second.back()));
}

SettingTexts Viewer::settingsToOpen() const {
    SettingTexts texts = mSettings.now();
    if (mSecond.other()) texts["with"] = {mSecondMade.options.scene.scene};
    return texts;
}

void Viewer::followSecond() {
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

void Viewer::swapStudies() {
    if (!mSession || !mSecond.other() || mWorker->loading().busy) return;
    const auto place = mSecond.matching(*mScene->scene, mSession->pose());
    if (!place) return;
    const Pose pose = mSecond.poseAt(*place);
    const std::shared_ptr<const OpenScene> next = mSecond.swap(mScene);
    SceneMade flown{mSettings.options(), mSettings.now(), mSettings.made().said};
    mMode = mSession->mode();
    mAnother = true;
    mSettings.begin(std::exchange(mSecondMade, flown), flown);
    mSwapTo = pose;
    mSwapSlices = std::exchange(mSecondSlices, mSession->study());
    mWorker->reload([next](Progress&) { return *next; });
}

}  // namespace stereonav
