// What panels see of the viewer, and what they may ask of it. The window's thread.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/bookmarks.h"
#include "app/view/file_looks.h"
#include "app/view/finding_list.h"
#include "app/view/frame_presenter.h"
#include "app/view/live_coverage.h"
#include "app/view/measured_line.h"
#include "app/view/notices.h"
#include "app/view/recent_files.h"
#include "app/view/scene_settings.h"
#include "app/view/session.h"
#include "app/view/view_display.h"
#include "app/view/window_jobs.h"
#include "engine/display/interface_theme.h"
#include "engine/scene/flat_wall.h"

namespace stereonav {

class KeyframeEdit;
class SecondStudy;

// The screen that the window is on.
struct ScreenAnswer {
    std::string words;    // how large it is, and who says so
    double width_mm = 0;  // in use
    bool asks = false;    // it is a guess that nobody was asked about
};

class PanelHost {
public:
    virtual ~PanelHost() = default;

    virtual ViewSession* session() = 0;          // null until the first scene is there
    virtual const ViewFrame* frame() const = 0;  // null until the first one
    virtual FramePresenter& pictures() = 0;
    // Of the place under the pointer; none while it is over no surface, or the picture moves.
    virtual Facts pointedFacts() const { return {}; }
    virtual SceneSettings& settings() = 0;
    virtual WindowJobs& jobs() = 0;
    virtual Notices& notices() = 0;
    // What opens all that is open again: with the study, too, that was opened beside the flight.
    virtual SettingTexts settingsToOpen() const = 0;
    // None where it is not known, or "" where the option is not given and has no default in the table.
    virtual std::optional<std::string> valueOf(const Option& option) const = 0;
    virtual bool live(const Option& option) const = 0;  // taken at once, while it is dragged
    virtual SizeOption pictureSize() const = 0;         // of an eye, pixels

    virtual ViewWorker::Loading loading() const = 0;
    virtual double loadingSeconds() const = 0;  // since it began
    virtual void cancelLoading() = 0;
    virtual std::optional<double> readingSlices() const = 0;  // how much of them, while they are read
    virtual void cancelSlices() = 0;

    // Places of this file; null before a scene is there.
    virtual Bookmarks* places() = 0;
    virtual void addPlace() = 0;
    virtual void goToPlace(const Bookmark& place) = 0;
    // Their names over the picture.
    virtual bool placeLabels() const = 0;
    virtual void showPlaceLabels(bool shown) = 0;
    // Of the path that Play plays, as they are moved about on the map; that path follows them.
    virtual KeyframeEdit& keyframes() = 0;
    virtual void openPath(
        const std::filesystem::path& file) = 0;  // takes the path's place; failures are told
    // What slices are of; asked for, it is read beside the frames. Null until then, or where there is none.
    virtual std::shared_ptr<const SliceStudy> study() = 0;

    virtual void act(const ViewAction& action) = 0;
    // none: as it begins. Failures are told.
    virtual void set(const std::string& key, const std::optional<std::string>& text) = 0;
    // What is asked before the window closes; "": nothing.
    virtual std::string closingQuestion() const { return ""; }
    virtual void answerClosing(bool /*close*/) {}
    virtual void open(const std::string& scene) = 0;  // a file, a folder, or a built-in scene's name
    virtual void quit() = 0;
    virtual const std::vector<RecentFile>& recentFiles() const = 0;  // newest first
    virtual void forgetRecent(const std::filesystem::path& file) = 0;
    // What a file is before it is opened: asked for again with each layout until it is there.
    virtual FileLook lookAt(const std::filesystem::path& file) = 0;
    virtual void saveScene(const std::filesystem::path& file) = 0;
    virtual void copy(const std::string& text) = 0;
    // The line that is measured; null before a scene is there. While measuring() clicks on the picture put
    // places of it on the surface.
    virtual MeasuredLine* measured() { return nullptr; }
    virtual bool measuring() const { return false; }
    virtual void measure(bool /*on*/) {}
    virtual void markWorld(const std::optional<glm::dvec3>& /*place*/) {}  // in the picture, until it is none
    // Null where the scene has no wall of which it can be followed what was seen.
    virtual LiveCoverage* coverage() { return nullptr; }
    // What is seen under the pointer, of a picture that stands still.
    virtual std::optional<glm::dvec3> pointedWorld() const { return std::nullopt; }
    // What is marked on the wall that lies flat.
    virtual std::vector<FlatMark> flatMarks() const { return {}; }
    // Another study beside this one; null where there can be none. Failures are told.
    virtual SecondStudy* secondStudy() { return nullptr; }
    virtual void openOther(const std::string& /*study*/) {}
    virtual void swapStudies() {}
    // Findings of this scene; null before a scene is there, or where it measures none.
    virtual FindingList* findings() { return nullptr; }
    virtual void addFinding(const glm::dvec3& /*place*/) {}
    virtual void writeFindingsPage(const std::filesystem::path& /*file*/) {}    // failures are told
    virtual void writeFindingsReport(const std::filesystem::path& /*file*/) {}  // the same
    // Clicks on the picture paint what is seen from there, so high above the ground; none: they do not.
    virtual std::optional<double> seesFromClicks() const { return std::nullopt; }
    virtual void seeFromClicks(const std::optional<double>& /*height*/) {}
    // Paint that is being worked out, once one waits for it.
    virtual std::optional<PaintWork> painting() const { return std::nullopt; }
    // What a coarser scene is shown for (StandIn), while it is prepared.
    virtual std::optional<PaintWork> preparing() const { return std::nullopt; }
    virtual void cancelPreparing() {}
    virtual bool canUndo() const = 0;
    virtual bool canRedo() const = 0;
    virtual void undo() = 0;
    virtual void redo() = 0;

    virtual const InterfaceLook& look() const = 0;
    virtual void setLook(const InterfaceLook& look) = 0;
    // Asks for what the scene says of itself; null until it is there.
    virtual const Facts* facts() = 0;
    // Parallax as it is on the real screen.
    virtual ScreenWords onScreen(const ViewFrame& frame) const = 0;
    virtual ScreenAnswer screen() const = 0;
    virtual void leaveScreenUnknown() = 0;  // it is not asked again
    virtual bool fullScreen() const = 0;
    virtual bool controlsApart() const = 0;  // the panels are in a window of their own
};

}  // namespace stereonav
