// A host for panels that are tested by themselves: a session, keyframes, and nothing else.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "app/view/keyframe_edit.h"
#include "app/view/panel/panel_host.h"

namespace stereonav {

class FakePanelHost final : public PanelHost {
public:
    explicit FakePanelHost(ViewSession& session) : mSession(session) {}

    ViewSession* session() override { return &mSession; }
    const ViewFrame* frame() const override { return nullptr; }
    FramePresenter& pictures() override { std::abort(); }
    SceneSettings& settings() override { return mSettings; }
    SettingTexts settingsToOpen() const override { return mSettings.now(); }
    WindowJobs& jobs() override { return mJobs; }
    Notices& notices() override { return mNotices; }
    std::optional<std::string> valueOf(const Option&) const override { return std::nullopt; }
    bool live(const Option&) const override { return false; }
    SizeOption pictureSize() const override { return {320, 200}; }
    ViewWorker::Loading loading() const override { return {}; }
    double loadingSeconds() const override { return 0; }
    void cancelLoading() override {}
    std::optional<double> readingSlices() const override { return std::nullopt; }
    void cancelSlices() override {}
    Bookmarks* places() override { return nullptr; }
    void addPlace() override {}
    void goToPlace(const Bookmark&) override {}
    bool placeLabels() const override { return false; }
    void showPlaceLabels(bool) override {}
    KeyframeEdit& keyframes() override { return mKeyframes; }
    void openPath(const std::filesystem::path&) override {}
    std::shared_ptr<const SliceStudy> study() override { return slices; }
    void act(const ViewAction& action) override { mSession.act(action); }
    void set(const std::string&, const std::optional<std::string>&) override {}
    void open(const std::string&) override {}
    void quit() override {}
    const std::vector<RecentFile>& recentFiles() const override { return mRecent; }
    void saveScene(const std::filesystem::path&) override {}
    void copy(const std::string&) override {}
    bool canUndo() const override { return false; }
    bool canRedo() const override { return false; }
    void undo() override {}
    void redo() override {}
    const InterfaceLook& look() const override { return mLook; }
    void setLook(const InterfaceLook&) override {}
    const Facts* facts() override { return nullptr; }
    ScreenWords onScreen(const ViewFrame&) const override { return {}; }
    bool fullScreen() const override { return false; }
    bool controlsApart() const override { return false; }
    void forgetRecent(const std::filesystem::path&) override {}
    FileLook lookAt(const std::filesystem::path&) override { return {}; }
    ScreenAnswer screen() const override { return {}; }
    void leaveScreenUnknown() override {}
    void markWorld(const std::optional<glm::dvec3>& place) override { marked = place; }
    std::vector<FlatMark> flatMarks() const override { return flat; }

    std::optional<glm::dvec3> marked;  // in the picture
    std::vector<FlatMark> flat;
    std::shared_ptr<const SliceStudy> slices;

private:
    ViewSession& mSession;
    KeyframeEdit mKeyframes;
    std::optional<ViewSession> mNone;
    SceneSettings mSettings{ViewOptions{}, mNone};
    Notices mNotices{ViewOptions{}};
    WindowJobs mJobs{mNone, mSettings, mNotices};
    std::vector<RecentFile> mRecent;
    InterfaceLook mLook;
};

}  // namespace stereonav
