#include "terrain/cast/ring_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/base/lone_loops.h"
#include "engine/base/memory.h"
#include "engine/base/thread_priority.h"
#include "terrain/cast/caster_scene.h"

namespace stereonav {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMaxima = 4.0 / 3;       // all levels of maxima, or of a texture, over the finest one
constexpr int kMargin = 8;                // samples around a part that are coloured with it
constexpr double kColored = 4 * kMaxima;  // bytes per texel
constexpr double kOfFree = 0.6;           // share of the available memory that rings may take

double bytesBeside(const Heightfield& ground) {
    constexpr double kLevels = 4.0 / 3, kBoxes = 4 * (1 + kMaxima) * 4.0 / 3;  // bytes per sample
    return (kLevels + 2 * kBoxes) * ground.width() * ground.height();
}

double samplesOf(const RingBox& box) {
    return double(box.size.x) * box.size.y;
}

// Returns the bytes that rings hold while they replace others of the same size, which are kept until then.
double bytesOf(const std::vector<RingBox>& boxes, const PartColors& colors) {
    double samples = 0, texels = 0, most = 0;
    for (const RingBox& box : boxes) {
        samples += samplesOf(box);
        if (!colors) continue;
        const double own = colors.texels(samplesOf(box), box.level);
        texels += own;
        most = std::max(most, own);
    }
    return 2 * (4 * (1 + kMaxima) * samples + kColored * texels) + colors.bytesMeanwhile * most;
}

}  // namespace

// Memory is checked for all levels, and for boxes of the finest ones with their maxima: twice, since old
// boxes are held until the new ones are ready.
RingScenes::RingScenes(const Heightfield& ground, double share)
    : mLevels((checkMemory("--level-of-detail", bytesBeside(ground), "leave it out"),
               std::make_shared<GroundLevels>(ground))),
      mShare(share),
      mShareNow(share) {}

RingScenes::RingScenes(std::shared_ptr<const GroundLevels> levels, int whole, double share)
    : mLevels(std::move(levels)),
      mWhole(whole),
      mBudget(kOfFree * availableMemory()),
      mShare(share),
      mShareNow(share) {}

RingScenes::~RingScenes() = default;

void RingScenes::colorParts(PartColors colors) {
    mColors = std::move(colors);
    ++mColorVersion;
}

void RingScenes::mayBeLate(bool may) {
    if (mMayBeLate && !may) {
        if (mWork.valid()) mWork.wait();
        mWork = {};
        mBoxes.clear();  // what is shown may be a part of the set, so that boxes are chosen again
        mLate = false;
    }
    mMayBeLate = may;
}

// Plans the rings. Stored levels take coarser rings where the wished ones would not fit into the budget.
std::vector<RingBox> RingScenes::plan(const Looking& from, const glm::dvec3& way) {
    const EyeView& view = from.view;
    RingWish wish{view.eye,  std::max(view.pixelWidth(), view.pixelHeight()), mShare, way, view.fall > 0,
                  from.other};
    std::vector<RingBox> boxes = planRings(*mLevels, wish);
    if (mLevels->stored()) {
        constexpr double kCoarser = 1.25, kMostShare = 1e6;
        while (bytesOf(boxes, mColors) > mBudget && wish.share < kMostShare) {
            wish.share *= kCoarser;
            boxes = planRings(*mLevels, wish);
        }
    }
    mShareNow = wish.share;
    return boxes;
}

void RingScenes::lookFrom(const EyeView& left, const EyeView& right) {
    const Looking from{left, right.eye};
    mMayBeLate&& any() ? lookLater(from) : lookNow(from);
}

void RingScenes::lookNow(const Looking& from) {
    std::vector<RingBox> boxes = plan(from, glm::dvec3(0.0));
    if (boxes == mBoxes && mSetColors == mColorVersion) return;
    const bool itself = !mLevels->stored() && boxes.size() == 1 && boxes.front().level == 0;
    Set set = itself ? Set() : make(boxes, mSet, mColors, mColorVersion);
    mSetColors = mColorVersion;
    show(std::move(set), std::move(boxes));
    mShown = mSet;
}

// Makes rings for the place where the eye will be in some seconds, and makes them anew when they no longer
// cover the near future.
void RingScenes::lookLater(const Looking& from) {
    constexpr double kSoon = 2, kAhead = 6;  // seconds
    if (mWork.valid() && mWork.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        Set set = mWork.get();
        mSetColors = mComingColors;
        show(std::move(set), std::exchange(mComing, {}));
    }
    const glm::dvec3 soon = wayOf(from.view.eye, kSoon);
    const bool covered = coverRings(mBoxes, plan(from, soon)) && mSetColors == mColorVersion;
    mLate = !coverRings(mBoxes, plan(from, glm::dvec3(0.0)));
    if (!covered && !mWork.valid()) begin(plan(from, soon * (kAhead / kSoon)));
    showAround(from);
}

// Returns the way that the eye will go in `seconds` at its mean velocity; 0 after a pause, since the eye may
// have jumped.
glm::dvec3 RingScenes::wayOf(const glm::dvec3& eye, double seconds) {
    constexpr double kJump = 1, kSmooth = 0.8;  // seconds without pictures; weight of the earlier velocity
    const Clock::time_point now = Clock::now();
    if (mSeen) {
        const double passed = std::chrono::duration<double>(now - mSeen->when).count();
        const glm::dvec3 velocity = (eye - mSeen->eye) / std::max(passed, 1e-3);
        mVelocity = passed > kJump ? glm::dvec3(0.0) : glm::mix(velocity, mVelocity, kSmooth);
    }
    mSeen = Seen{eye, now};
    return seconds * mVelocity;
}

void RingScenes::begin(std::vector<RingBox> boxes) {
    if (boxes == mBoxes && mSetColors == mColorVersion) return;
    mComing = std::move(boxes);
    mComingColors = mColorVersion;
    mWork = std::async(std::launch::async, [this, boxes = mComing, before = mSet, colors = mColors,
                                            version = mColorVersion, arrivals = mArrivals] {
        loopOnThisThreadAlone();
        stepBehindTheWindow();
        Set set = make(boxes, before, colors, version);
        ++*arrivals;
        return set;
    });
}

void RingScenes::show(Set set, std::vector<RingBox> boxes) {
    mSet = std::move(set);
    mBoxes = std::move(boxes);
}

// Shows only the rings that both eyes are in: rays start in the finest of these.
void RingScenes::showAround(const Looking& from) {
    std::vector<RingBox> held;
    for (const auto& ring : mSet.rings->rings) held.push_back(ring->box);
    const std::vector<RingBox> around =
        ringsAround(*mLevels, ringsAround(*mLevels, held, from.view.eye), from.other);
    if (around.size() == held.size()) {
        mShown = mSet;
        return;
    }
    auto rings = std::make_shared<GroundRings>();
    Set shown;
    for (std::size_t n = 0; n < held.size(); ++n) {
        if (std::find(around.begin(), around.end(), held[n]) == around.end()) continue;
        rings->rings.push_back(mSet.rings->rings[n]);
        shown.colors.push_back(mSet.colors[n]);
    }
    rings->steepest = mSet.rings->steepest;
    rings->errorBound = mSet.rings->errorBound;
    shown.rings = std::move(rings);
    mShown = std::move(shown);
}

RingScenes::Set RingScenes::make(const std::vector<RingBox>& boxes, const Set& before,
                                 const PartColors& colors, int version) const {
    Set set;
    set.rings = makeRings(*mLevels, boxes, before.rings.get());
    for (const auto& ring : set.rings->rings) {
        std::shared_ptr<const Color> color;
        if (colors && ring->box.level < mWhole) {
            for (std::size_t n = 0; before.rings && n < before.colors.size(); ++n)
                if (before.rings->rings[n]->box == ring->box && before.colors[n] &&
                    before.colors[n]->version == version)
                    color = before.colors[n];
            if (!color) color = colorOf(ring->box, colors, version);
        }
        set.colors.push_back(std::move(color));
    }
    return set;
}

std::shared_ptr<const RingScenes::Color> RingScenes::colorOf(const RingBox& box, const PartColors& colors,
                                                             int version) const {
    const glm::ivec2 low = glm::max(box.low - kMargin, glm::ivec2(0)),
                     end = glm::min(box.low + box.size + kMargin, mLevels->size(box.level));
    const std::optional<Heightfield> part = mLevels->part(box.level, low, end - low);
    auto made = std::make_shared<Color>();
    made->first = glm::dvec2(box.low - low);
    made->texture = colors.make(part.value());  // a ring has a cell at least
    made->version = version;
    return made;
}

void RingScenes::dress(const CasterScene& foggy, const CasterScene& clear, const GroundFilter& filter) {
    if (!any()) return;
    mFoggy = dressed(foggy, filter);
    mClear = dressed(clear, filter);
}

std::vector<CasterScene> RingScenes::dressed(const CasterScene& whole, const GroundFilter& filter) const {
    const auto& rings = mShown.rings->rings;
    std::vector<CasterScene> scenes(rings.size(), whole);
    const auto steepest = static_cast<float>(mShown.rings->steepest * (1 + 1e-6));
    for (std::size_t n = 0; n < rings.size(); ++n) {
        const RingBox& box = rings[n]->box;
        CasterScene& scene = scenes[n];
        scene.ground = groundData(rings[n]->ground, rings[n]->maxima);
        // Beams and neighbouring rays, which prove a ray's start free, may have gone over any of the rings.
        scene.ground.maxSlope = steepest;
        TextureData& texture = scene.texture;
        glm::vec2 first, step(1.0f);
        if (mShown.colors[n]) {
            texture = textureData(mShown.colors[n]->texture, rings[n]->ground.spacing(), filter);
            first = mShown.colors[n]->first;
        } else {
            step = glm::vec2(std::ldexp(1.0f, box.level - mWhole));
            first = glm::vec2(box.low) * step;
        }
        texture.shiftX += first.x * texture.scaleX;
        texture.shiftY += first.y * texture.scaleY;
        texture.scaleX *= step.x;
        texture.scaleY *= step.y;
        if (box.level > 0)
            scene.detail = {};
        else if (scene.detail.octaves > 0)
            scene.detail.rough +=
                static_cast<std::ptrdiff_t>(box.low.y) * scene.detail.roughPitch + box.low.x;
        if (n + 1 == rings.size()) continue;
        const RingBox& next = rings[n + 1]->box;
        const int ratio = 1 << (next.level - box.level);
        scene.beyond = {&scenes[n + 1], double(next.low.x) * ratio - box.low.x,
                        double(next.low.y) * ratio - box.low.y, 1.0 / ratio};
    }
    return scenes;
}

std::size_t RingScenes::byteCount() const {
    std::size_t bytes = mLevels->byteCount();
    if (!mSet.rings) return bytes;
    for (const auto& ring : mSet.rings->rings)
        bytes += ring->maxima.byteCount() +
                 sizeof(float) * static_cast<std::size_t>(ring->box.size.x) * ring->box.size.y;
    for (const auto& color : mSet.colors) bytes += color ? color->texture.byteCount() : 0;
    return bytes;
}

}  // namespace stereonav
