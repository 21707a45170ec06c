// Coverage during the flight: the wall is looked at from the views of the pictures that were shown, on a
// thread with lower priority than all others, which exists only while coverage is on. Functions are called by
// the window's thread.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/view/kept_coverage.h"
#include "engine/base/progress.h"
#include "engine/camera/eye_view.h"
#include "engine/scene/scene.h"
#include "engine/scene/wall_to_see.h"

namespace stereonav {

// The coverage so far.
struct CoverageSoFar {
    bool any = false;  // whether the wall was looked at
    double percent = 0;
    std::vector<UnseenPart> unseen;             // largest first
    std::shared_ptr<const EyePainter> painter;  // null: nothing yet
    std::size_t looked = 0;                     // number of views that it is based on
};

class LiveCoverage {
public:
    // wake: called from the thread when there is a new result.
    explicit LiveCoverage(std::function<void()> wake) : mWake(std::move(wake)) {}
    ~LiveCoverage() { switchOn(false); }  // the flight is kept

    // Begins a scene, switched off, with the flight kept in `file`; "" keeps nothing.
    void open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file);
    // Goes on in another scene of the same file: coverage of the flight is computed again in it.
    void replaceScene(std::shared_ptr<const Scene> scene);
    bool can() const { return mScene && mScene->offered<WallToSee>(); }
    bool on() const { return mOn; }
    void switchOn(bool on);

    // Notes that a picture was shown, by its left eye. seconds: of the window's clock. rests: nothing moves.
    void show(const EyeView& left, double seconds, bool rests);
    void addOwnFlight(bool bothWays);  // with the last picture's field of view and shape
    void startAgain();                 // forgets the flight
    const WallLooking& looking() const { return mLooking; }
    void judgeBy(const WallLooking& looking);  // for the whole flight

    // Takes new results of the thread. Returns true where there is something new.
    bool poll();
    const CoverageSoFar& soFar() const { return mSoFar; }
    bool busy() const;            // not all of the flight was looked at
    double metres() const;        // distance flown by hand and automatically
    double seconds() const;       // duration of that
    std::string problem() const;  // "" for none

    // Returns the next smaller unseen part that has a view, or the next larger one (step -1), cyclically;
    // null where there is none. It becomes the chosen one.
    const UnseenPart* step(int step);
    void choose(const UnseenPart& part) { mChosen = part; }
    const std::optional<UnseenPart>& chosen() const { return mChosen; }

private:
    struct Work;  // data of both threads

    void begin(const Work* before);
    void end();

    std::function<void()> mWake;
    std::shared_ptr<const Scene> mScene;
    std::filesystem::path mFile;
    bool mOn = false;
    WallLooking mLooking;
    CoverageSoFar mSoFar;
    std::optional<UnseenPart> mChosen;
    std::optional<EyeView> mLast;  // last view that was used
    glm::dvec3 mLastShown{0.0};    // place of the last picture, and its time
    double mLastSeconds = 0;
    std::shared_ptr<Work> mWork;  // set while on and can()
    std::thread mThread;
};

}  // namespace stereonav
