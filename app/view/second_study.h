// Another study beside the one that is flown: loaded beside the window, its line matched with the flown
// one's, and a picture of one eye at the matching place, drawn by one thread of low priority. Nothing is
// loaded before open(), and no thread draws before look(). Functions are called by the window's thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/view/beside_work.h"
#include "app/view/view_frame.h"
#include "engine/scene/line_match.h"

namespace stereonav {

// A place on the other study's line.
struct SecondPlace {
    double along = 0, length = 0;  // metres
    bool back = false;             // whether it looks towards the line's start
    bool operator==(const SecondPlace&) const = default;
};

struct SecondPicture {
    SecondPlace of;
    Plane<PackedColor> color;
};

class SecondStudy {
public:
    // wake: called from other threads when there is something new.
    explicit SecondStudy(std::function<void()> wake) : mWake(std::move(wake)) {}
    ~SecondStudy() { close(); }  // stops loading and drawing, and waits for their end

    using Load = std::function<OpenScene(Progress&)>;
    // Opens a study in place of the present one. first: the flown scene, which has a line to match.
    void open(std::shared_ptr<const OpenScene> first, Load load);
    void close();
    bool loading() const { return mLoading.busy() || mNext; }
    double fraction() const { return mLoading.fraction(); }
    // Cancels loading: poll() then throws Cancelled soon; a study that waits to be loaded is dropped.
    void cancel() {
        mLoading.cancel();
        mNext = nullptr;
    }
    // Takes a loaded study; returns true once when it is there. Throws the exceptions of loading and
    // matching.
    bool poll();

    // Returns the other scene; null until it is there.
    const std::shared_ptr<const OpenScene>& other() const { return mOther; }
    double cost() const { return mMatch ? mMatch->cost() : 0; }         // see LineMatch::cost
    bool matches() const { return mMatch ? mMatch->matches() : true; }  // see LineMatch::matches
    // Returns the other study's place that matches an eye in the flown one. Requires the study, and a line of
    // the flown scene.
    std::optional<SecondPlace> matching(const Scene& flown, const Pose& eye) const;
    Pose poseAt(const SecondPlace& place) const;

    // Asks for a picture of this size: the newest wish replaces one that is not begun.
    void look(const SecondPlace& place, const glm::ivec2& size);
    // Returns the newest picture; null before the first.
    std::shared_ptr<const SecondPicture> picture() const;
    bool drawing() const { return mDrawer.joinable(); }  // whether there is a thread

    // Makes the flown scene the other one, and returns the one to fly in.
    std::shared_ptr<const OpenScene> swap(std::shared_ptr<const OpenScene> flown);

private:
    struct Opened {
        std::shared_ptr<const OpenScene> scene;
        std::shared_ptr<const LineMatch> match;  // from the flown scene's line to its own
    };
    struct Wish {
        SecondPlace place;
        glm::ivec2 size{0};
        bool operator==(const Wish&) const = default;
    };
    void begin(std::shared_ptr<const OpenScene> first, Load load);
    void stopDrawing();
    void draw();
    std::shared_ptr<const SecondPicture> drawn(const Scene& scene, const Wish& wish) const;

    std::function<void()> mWake;
    BesideWork<Opened> mLoading;
    bool mDropped = false;        // the study being loaded is no longer wanted
    std::function<void()> mNext;  // begins the study to load after that
    std::shared_ptr<const OpenScene> mOther;
    std::shared_ptr<const LineMatch> mMatch;
    bool mFlipped = false;  // the match leads from the other study's line to the flown one's

    mutable std::mutex mMutex;  // guards the members below
    std::condition_variable mAsked;
    std::optional<Wish> mWish, mLast;  // not begun; begun last
    std::shared_ptr<const SecondPicture> mPicture;
    bool mStop = false;
    std::thread mDrawer;
};

}  // namespace stereonav
