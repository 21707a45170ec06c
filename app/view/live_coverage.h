// Coverage while one flies: the wall is looked at from the pictures that were shown, on a thread of its own
// behind all others, which there is only while it is switched on. Calls are the window's thread's.
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

// What is known so far.
struct CoverageSoFar {
    bool any = false;  // the wall was looked at
    double percent = 0;
    std::vector<UnseenPart> unseen;             // largest first
    std::shared_ptr<const EyePainter> painter;  // null: nothing yet
    std::size_t looked = 0;                     // eyes that it is of
};

class LiveCoverage {
public:
    // wake: called from the thread when there is something new.
    explicit LiveCoverage(std::function<void()> wake) : mWake(std::move(wake)) {}
    ~LiveCoverage() { switchOn(false); }  // what was flown is kept

    // Off, of that scene, with what was flown in it before in `file`; "" keeps nothing.
    void open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file);
    // The same file, shown by another scene: what was flown is looked at again in it.
    void replaceScene(std::shared_ptr<const Scene> scene);
    bool can() const { return mScene && mScene->offered<WallToSee>(); }
    bool on() const { return mOn; }
    void switchOn(bool on);

    // A picture was shown: its left eye. seconds: of the window's clock. Rests: nothing moves.
    void show(const EyeView& left, double seconds, bool rests);
    void addOwnFlight(bool bothWays);  // by the last picture's field of view and shape
    void startAgain();                 // nothing was flown
    const WallLooking& looking() const { return mLooking; }
    void judgeBy(const WallLooking& looking);  // all that was flown

    // Takes what the thread has. True: there is something new.
    bool poll();
    const CoverageSoFar& soFar() const { return mSoFar; }
    bool busy() const;            // not all that was flown was looked at
    double metres() const;        // flown by hand or by itself, and
    double seconds() const;       // how long that took
    std::string problem() const;  // "" for none

    // The next smaller unseen part that has a view, or the next larger one (step -1), round at the ends; null
    // where there is none. It is the chosen one from then on.
    const UnseenPart* step(int step);
    void choose(const UnseenPart& part) { mChosen = part; }
    const std::optional<UnseenPart>& chosen() const { return mChosen; }

private:
    struct Work;  // what both threads know

    void begin(const Work* before);
    void end();

    std::function<void()> mWake;
    std::shared_ptr<const Scene> mScene;
    std::filesystem::path mFile;
    bool mOn = false;
    WallLooking mLooking;
    CoverageSoFar mSoFar;
    std::optional<UnseenPart> mChosen;
    std::optional<EyeView> mLast;  // that was looked from, and
    glm::dvec3 mLastShown{0.0};    // where the last picture was, and when
    double mLastSeconds = 0;
    std::shared_ptr<Work> mWork;  // while on and can()
    std::thread mThread;
};

}  // namespace stereonav
