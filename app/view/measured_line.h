// The line that is measured in the window: places that a person put on the surface one by one, and what the
// scene says of them, worked out beside the window. Kept for the scene's file as it is made.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/beside_work.h"
#include "engine/scene/line_measurer.h"
#include "engine/scene/scene.h"

namespace stereonav {

class MeasuredLine {
public:
    static constexpr std::size_t kMost = 1000;  // places

    // wake: called from another thread when a measuring is done.
    explicit MeasuredLine(std::function<void()> wake) : mWake(std::move(wake)) {}

    // Of that scene from now on, with what was kept in `file`; "" keeps nothing.
    void open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file);
    // The same file, shown by another scene.
    void replaceScene(std::shared_ptr<const Scene> scene);

    const std::vector<glm::dvec3>& places() const { return mPlaces; }
    bool closed() const { return mClosed; }
    // World. One that is where the last one is, or beyond kMost, is left out: false.
    bool add(const glm::dvec3& place);
    void removeLast();
    void clear();
    void setClosed(bool closed);
    // These in the place of its own, evenly thinned to kMost. False: fewer than two that differ, and nothing
    // is changed.
    bool take(const std::vector<glm::dvec3>& places, bool closed);
    // Of a line of sight between its last two places: above the surface, metres.
    double eyeHeight() const { return mEyeHeight; }
    void setEyeHeight(double height);

    // Looks whether the last measuring is done, and begins the next. True: there is something new.
    bool poll();
    bool busy() const { return mWork.busy() || mDue; }
    // Of the measuring that is under way, 0 to 1. Any change ends it, and begins another.
    double fraction() const { return mWork.fraction(); }
    // Of the places that there were when it began. Null: there is none. problem(): why.
    const MeasuredSurface* measured() const { return mMeasured ? &*mMeasured : nullptr; }
    const std::string& problem() const { return mProblem; }

private:
    struct Outcome {
        MeasuredSurface measured;
        std::string problem;
    };
    static Outcome outcomeOf(const Scene& scene, const std::vector<glm::dvec3>& places, bool closed,
                             double eyeHeight, Progress& progress);
    void measureAgain();
    bool takeMeasured();
    void changed();
    void write();

    std::function<void()> mWake;
    std::shared_ptr<const Scene> mScene;
    std::filesystem::path mFile;
    std::vector<glm::dvec3> mPlaces;
    bool mClosed = false, mDue = false;
    double mEyeHeight = 2;
    std::optional<MeasuredSurface> mMeasured;
    std::string mProblem;
    BesideWork<Outcome> mWork;  // last: it is ended, and waited for, first
};

// Where the line of a scene is kept whose places are kept in that file (Bookmarks::file()); "" for "".
std::filesystem::path measuredFile(const std::filesystem::path& places);

// What any scene says: lengths from place to place in space, and round it where it is closed.
MeasuredSurface straightMeasure(const std::vector<glm::dvec3>& places, bool closed);

}  // namespace stereonav
