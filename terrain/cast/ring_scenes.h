// Ground in rings for the casting kernels: the level of detail of a renderer, chosen for each frame.
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
    // Makes the levels of a ground, which must outlive this object. share: RingWish::share, above 0. Throws
    // Error where there is not enough memory.
    RingScenes(const Heightfield& ground, double share);
    // Makes rings of stored levels. whole: the level with the samples of the scenes that are given to
    // dress(); only rings are cast. Where rings need more memory than is available, the share is increased.
    RingScenes(std::shared_ptr<const GroundLevels> levels, int whole, double share);
    ~RingScenes();

    // Sets the function that colours rings finer than the whole ground's samples, for rings that are chosen
    // from now on; null: the whole ground's colours.
    void colorParts(PartColors colors);
    // Lets rings be made by a thread of their own: pictures do not wait for them, and meanwhile the existing
    // rings are cast, from farther and farther away. Otherwise lookFrom() waits for them.
    void mayBeLate(bool may);

    // Chooses the rings for pictures of these views, which differ only in the eyes' places. Throws Error
    // where stored levels can not be read.
    void lookFrom(const EyeView& left, const EyeView& right);
    // Returns whether rings are cast in place of the ground itself.
    bool any() const { return mShown.rings != nullptr; }
    const GroundRings& rings() const { return *mShown.rings; }                         // where any()
    const Heightfield& ground() const { return mShown.rings->rings.front()->ground; }  // the finest
    // Largest error of the ground in the next picture, as a share of a pixel: the wished one, or more.
    double share() const { return mShareNow; }
    // Returns whether finer rings are on their way.
    bool late() const { return mLate; }
    // Returns a counter of late rings that have become ready, from any thread.
    std::uint64_t arrivals() const { return *mArrivals; }

    // Makes the rings' scenes like those of the ground, with and without fog, except for the ground itself.
    // The given scenes, and what they point to, must outlive this object or be replaced by another call.
    void dress(const CasterScene& foggy, const CasterScene& clear, const GroundFilter& filter);
    // Returns the scene of the finest ring, which leads to the others; requires any().
    const CasterScene& first(bool withoutFog) const { return (withoutFog ? mClear : mFoggy).front(); }

    // Returns the bytes of levels, rings and their colours.
    std::size_t byteCount() const;

private:
    struct Color {
        glm::dvec2 first{0.0};  // sample (0, 0) of the ring, in the grid of the part that was coloured
        ColorTexture texture;
        int version = 0;
    };
    // Rings, and the colours of each; null: colours of the whole ground.
    struct Set {
        std::shared_ptr<const GroundRings> rings;
        std::vector<std::shared_ptr<const Color>> colors;
    };

    // The eyes of a picture, by which rings are chosen.
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
    int mWhole = 0;            // level with the samples of the dressed scenes
    double mBudget = 0;        // largest number of bytes for rings of stored levels
    double mShare, mShareNow;  // shares of a pixel: wished, and present
    PartColors mColors;
    int mColorVersion = 0;
    bool mMayBeLate = false, mLate = false;

    std::vector<RingBox> mBoxes;  // the boxes of mSet
    // All rings; those that are cast from the present place. null rings: the ground itself.
    Set mSet, mShown;
    int mSetColors = 0;                       // version of the set's colours
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
