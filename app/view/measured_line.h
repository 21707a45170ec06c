// The line that is measured in the window: places that the user added on the surface one by one, and the
// scene's measurements, made beside the window. Kept for the scene's file.
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

    // wake: called from another thread when a measurement is done.
    explicit MeasuredLine(std::function<void()> wake) : mWake(std::move(wake)) {}

    // Begins a scene, with the line kept in `file`; "" keeps nothing.
    void open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file);
    // Goes on in another scene of the same file.
    void replaceScene(std::shared_ptr<const Scene> scene);

    const std::vector<glm::dvec3>& places() const { return mPlaces; }
    bool closed() const { return mClosed; }
    // Adds a place of the world. Returns false, without adding it, where it equals the last one, or there are
    // kMost.
    bool add(const glm::dvec3& place);
    void removeLast();
    void clear();
    void setClosed(bool closed);
    // Replaces the places by these, evenly thinned to kMost. Returns false, without a change, for fewer than
    // two different places.
    bool take(const std::vector<glm::dvec3>& places, bool closed);
    // Returns the height above the surface of both ends of a line of sight between the last two places, in
    // metres.
    double eyeHeight() const { return mEyeHeight; }
    void setEyeHeight(double height);

    // Takes a finished measurement, and begins the next. Returns true where there is something new.
    bool poll();
    bool busy() const { return mWork.busy() || mDue; }
    // Returns the progress of the measurement under way, 0 to 1. Any change cancels it and begins another.
    double fraction() const { return mWork.fraction(); }
    // Returns the measurements of the places at its beginning; null: none. problem(): the reason.
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
    BesideWork<Outcome> mWork;  // last: it is cancelled, and its end waited for, first
};

// Returns measurements that every scene has: lengths from place to place in space, and around where it is
// closed.
MeasuredSurface straightMeasure(const std::vector<glm::dvec3>& places, bool closed);

}  // namespace stereonav
