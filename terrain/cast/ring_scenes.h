// Ground in rings as the casting kernels read it: the level of detail of a renderer, chosen for each frame.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/color_texture.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/ground_rings.h"
#include "terrain/scene/part_colors.h"

namespace stereonav {

struct GroundFilter;  // terrain_renderer.h

class RingScenes {
public:
    // Makes the levels of a ground, which must outlive this. share: RingWish::share, above 0. Throws Error
    // where there is not enough memory.
    RingScenes(const Heightfield& ground, double share);
    // Makes rings of stored levels. The scenes that are given to dress() have the samples of one of these
    // levels, `whole`, and only rings are cast. Where rings need more memory than can be had the share is
    // made larger.
    RingScenes(std::shared_ptr<const GroundLevels> levels, int whole, double share);
    ~RingScenes();

    // Sets what colours rings finer than the whole ground's samples, for rings that are chosen from now on;
    // null: the whole ground's colours.
    void colorParts(PartColors colors);
    // Lets rings come later than the first picture they are for, from a thread of their own: what is there is
    // cast meanwhile, from further and further away. Else lookFrom() waits for them.
    void mayBeLate(bool may);

    // Chooses the rings for pictures of these views, which differ in the eyes' places alone. Throws Error
    // where levels are stored and can not be read.
    void lookFrom(const EyeView& left, const EyeView& right);
    // Returns whether what was chosen differs from the ground itself.
    bool any() const { return mShown.rings != nullptr; }
    const GroundRings& rings() const { return *mShown.rings; }                         // where any()
    const Heightfield& ground() const { return mShown.rings->rings.front()->ground; }  // the finest
    // Share of a pixel that the ground of the next picture may be off: the wish's, or more.
    double share() const { return mShareNow; }
    // Returns whether finer rings are on their way.
    bool late() const { return mLate; }
    // Counts up, from any thread, when rings that were late are there.
    std::uint64_t arrivals() const { return *mArrivals; }

    // Makes the rings' scenes like those of the ground itself, with and without fog, in all but the ground.
    // The given scenes, and what they point to, must outlive this or be replaced by others.
    void dress(const CasterScene& foggy, const CasterScene& clear, const GroundFilter& filter);
    // The scene of the finest ring, which leads to the others; where any().
    const CasterScene& first(bool withoutFog) const { return (withoutFog ? mClear : mFoggy).front(); }

    // Bytes of levels, rings and their colours.
    std::size_t byteCount() const;

private:
    struct Color {
        glm::dvec2 first{0.0};  // the ring's sample (0, 0), in the grid of what was coloured
        ColorTexture texture;
        int version = 0;
    };
    // Rings, and the colours of each; null: the whole ground's.
    struct Set {
        std::shared_ptr<const GroundRings> rings;
        std::vector<std::shared_ptr<const Color>> colors;
    };

    // Two eyes, and what of their pictures chooses rings.
    struct Looking {
        const EyeView& view;
        glm::dvec3 other;  // the second eye: world
    };
    std::vector<RingBox> plan(const Looking& from, const glm::dvec3& way);
    Set make(const std::vector<RingBox>& boxes, const Set& before, const PartColors& colors,
             int version) const;
    std::shared_ptr<const Color> colorOf(const RingBox& box, const PartColors& colors, int version) const;
    void lookNow(const Looking& from);
    void lookLater(const Looking& from);
    void begin(std::vector<RingBox> boxes);
    void show(Set set, std::vector<RingBox> boxes);
    void showAround(const Looking& from);
    glm::dvec3 wayOf(const glm::dvec3& eye, double seconds);
    std::vector<CasterScene> dressed(const CasterScene& whole, const GroundFilter& filter) const;

    std::shared_ptr<const GroundLevels> mLevels;
    int mWhole = 0;            // level of the scenes that are dressed
    double mBudget = 0;        // bytes of rings of stored levels
    double mShare, mShareNow;  // shares of a pixel: the wished one, the one kept to
    PartColors mColors;
    int mColorVersion = 0;
    bool mMayBeLate = false, mLate = false;

    std::vector<RingBox> mBoxes;  // the boxes of mSet
    Set mSet, mShown;    // all that is there; what of it is cast from here. null rings: the ground itself
    int mSetColors = 0;  // version of the set's colours
    std::vector<CasterScene> mFoggy, mClear;  // finest first

    // State of rings that may be late.
    std::shared_ptr<std::atomic<std::uint64_t>> mArrivals = std::make_shared<std::atomic<std::uint64_t>>(0);
    std::vector<RingBox> mComing;
    int mComingColors = 0;
    std::future<Set> mWork;
    struct Seen {
        glm::dvec3 eye;  // world, metres
        std::chrono::steady_clock::time_point when;
    };
    std::optional<Seen> mSeen;
    glm::dvec3 mVelocity{0.0};  // metres a second
};

}  // namespace stereonav
