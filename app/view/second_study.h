// Another study beside the one that is flown: loaded beside the window, its line matched with the flown
// one's, and one eye's picture of its matching place, drawn by one thread of low priority. Nothing of it is
// there before open(), and no thread draws before look(). The window's thread calls it.
#pragma once

#include <condition_variable>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/view/beside_work.h"
#include "app/view/worker.h"
#include "engine/scene/line_match.h"

namespace stereonav {

// A place of the other study's line.
struct SecondPlace {
    double along = 0, length = 0;  // metres
    bool back = false;             // looking towards the line's start
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
    ~SecondStudy() { close(); }  // stops loading and drawing, and waits for their ends

    using Load = std::function<OpenScene(Progress&)>;
    // In the place of the one that is there. first: that is flown, with a line to match.
    void open(std::shared_ptr<const OpenScene> first, Load load);
    void close();
    bool loading() const { return mLoading.busy() || mNext; }
    double fraction() const { return mLoading.fraction(); }
    // poll() throws Cancelled soon; what was only to be loaded after that is not begun.
    void cancel() {
        mLoading.cancel();
        mNext = nullptr;
    }
    // Takes what was loaded; true once when it is there. Throws what loading and matching threw.
    bool poll();

    // Null until it is there.
    const std::shared_ptr<const OpenScene>& other() const { return mOther; }
    double cost() const { return mMatch ? mMatch->cost() : 0; }         // LineMatch::cost
    bool matches() const { return mMatch ? mMatch->matches() : true; }  // LineMatch::matches
    // Which of its places is that of an eye in the flown one; there, and the flown scene has a line.
    std::optional<SecondPlace> matching(const Scene& flown, const Pose& eye) const;
    Pose poseAt(const SecondPlace& place) const;

    // Wants a picture of it of so many pixels: the newest wish replaces one that is not begun.
    void look(const SecondPlace& place, const glm::ivec2& size);
    // The newest one; null before the first.
    std::shared_ptr<const SecondPicture> picture() const;
    bool drawing() const { return mDrawer.joinable(); }  // whether there is a thread

    // The flown one becomes the other, and this is what is to be flown.
    std::shared_ptr<const OpenScene> swap(std::shared_ptr<const OpenScene> flown);

private:
    struct Opened {
        std::shared_ptr<const OpenScene> scene;
        std::shared_ptr<const LineMatch> match;  // from the flown one's line to its own
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
    bool mDropped = false;        // what is loaded is not wanted any more
    std::function<void()> mNext;  // begins what is to be loaded after that
    std::shared_ptr<const OpenScene> mOther;
    std::shared_ptr<const LineMatch> mMatch;
    bool mFlipped = false;  // the match goes from the other one's line to the flown one's

    mutable std::mutex mMutex;  // guards what follows
    std::condition_variable mAsked;
    std::optional<Wish> mWish, mLast;  // not begun; begun last
    std::shared_ptr<const SecondPicture> mPicture;
    bool mStop = false;
    std::thread mDrawer;
};

}  // namespace stereonav
