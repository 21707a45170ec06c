#include "app/view/second_study.h"

#include <chrono>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/thread_priority.h"
#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

constexpr std::chrono::milliseconds kBetween{200};  // between pictures in flight

}  // namespace

void SecondStudy::open(std::shared_ptr<const OpenScene> first, Load load) {
    close();
    if (!mLoading.busy()) return begin(std::move(first), std::move(load));
    mNext = [this, first = std::move(first), load = std::move(load)] { begin(first, load); };
}

void SecondStudy::begin(std::shared_ptr<const OpenScene> first, Load load) {
    mDropped = false;
    mLoading.start(
        [first = std::move(first), load = std::move(load)](Progress& progress) {
            auto scene = std::make_shared<const OpenScene>(load(progress));
            if (!scene->scene->offered<RayCast>() || !scene->scene->offered<const MatchingLine>())
                throw Error(scene->scene->name, "", "no colon was found", "give a study that is one");
            auto match = first->scene->offered<const MatchingLine>()->matchWith(*scene->scene);
            return Opened{std::move(scene), std::move(match)};
        },
        mWake);
}

void SecondStudy::close() {
    stopDrawing();
    mLoading.cancel();
    mDropped = true;
    mNext = nullptr;
    mOther.reset();
    mMatch.reset();
    mFlipped = false;
}

bool SecondStudy::poll() {
    std::optional<Opened> opened;
    try {
        opened = mLoading.take();
    } catch (const std::exception&) {
        if (!mDropped) throw;
    }
    if (opened && !mDropped) {
        mOther = std::move(opened->scene);
        mMatch = std::move(opened->match);
        return true;
    }
    if (mNext && !mLoading.busy()) std::exchange(mNext, nullptr)();
    return false;
}

std::optional<SecondPlace> SecondStudy::matching(const Scene& flown, const Pose& eye) const {
    const auto* const through = flown.offered<const LineThrough>();
    const auto* const line = flown.offered<const MatchingLine>();
    if (!mOther || !through || !line) return std::nullopt;
    const double along = through->placeOnLine(eye.position).along;
    const auto* const there = mOther->scene->offered<const LineThrough>();
    SecondPlace place;
    place.along = mFlipped ? mMatch->fromOther(along) : mMatch->toOther(along);
    place.length = there ? there->placeOnLine(eye.position).length : 0;
    place.back = looksBack(*line, along, eye);
    return place;
}

Pose SecondStudy::poseAt(const SecondPlace& place) const {
    return mOther->scene->offered<const MatchingLine>()->poseOnLine(place.along, place.back);
}

std::shared_ptr<const OpenScene> SecondStudy::swap(std::shared_ptr<const OpenScene> flown) {
    stopDrawing();
    mFlipped = !mFlipped;
    return std::exchange(mOther, std::move(flown));
}

void SecondStudy::look(const SecondPlace& place, const glm::ivec2& size) {
    const Wish wish{place, size};
    {
        const std::lock_guard lock(mMutex);
        if ((mWish ? mWish : mLast) == wish) return;
        mWish = wish;
    }
    if (!mDrawer.joinable()) mDrawer = std::thread([this] { draw(); });
    mAsked.notify_all();
}

std::shared_ptr<const SecondPicture> SecondStudy::picture() const {
    const std::lock_guard lock(mMutex);
    return mPicture;
}

void SecondStudy::stopDrawing() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
    }
    mAsked.notify_all();
    if (mDrawer.joinable()) mDrawer.join();
    mStop = false;
    mWish.reset();
    mLast.reset();
    mPicture.reset();
}

// Draws pictures on a thread of its own; mOther does not change while it runs.
void SecondStudy::draw() {
    stepBehindTheWindow();
    std::unique_lock lock(mMutex);
    while (true) {
        mAsked.wait(lock, [this] { return mStop || mWish; });
        if (mStop) return;
        mLast = std::exchange(mWish, std::nullopt);
        const Wish wish = *mLast;
        lock.unlock();
        auto picture = drawn(*mOther->scene, wish);
        lock.lock();
        if (picture) mPicture = std::move(picture);
        mWake();
        if (mAsked.wait_for(lock, kBetween, [this] { return mStop; })) return;
    }
}

// Draws tile by tile on this thread; returns null where it has to stop.
std::shared_ptr<const SecondPicture> SecondStudy::drawn(const Scene& scene, const Wish& wish) const {
    const EyeRenderer& renderer = rendererOf(scene);
    Lens lens = scene.lens;
    lens.width = wish.size.x;
    lens.height = wish.size.y;
    const EyeView view = makeEyeView(poseAt(wish.place), lens);
    EyeImage image;
    image.resize(lens.width, lens.height, renderer.viewDependence());
    const int tiles = renderer.tileCount(view);
    for (int tile = 0; tile < tiles; ++tile) {
        {
            const std::lock_guard lock(mMutex);
            if (mStop) return nullptr;
        }
        renderer.renderTile(view, tile, image);
    }
    return std::make_shared<const SecondPicture>(SecondPicture{wish.place, std::move(image.color)});
}

}  // namespace stereonav
