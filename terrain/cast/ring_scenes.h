// Ground in rings as the casting kernels read it: the level of detail of a renderer, chosen for each frame.
#pragma once

#include <memory>
#include <vector>

#include "engine/camera/eye_view.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/ground_rings.h"

namespace stereonav {

class RingScenes {
public:
    // ground must outlive this. share: RingWish::share, above 0. Throws Error where there is not enough
    // memory.
    RingScenes(const Heightfield& ground, double share);

    // Chooses the rings for pictures of this view.
    void lookFrom(const EyeView& view);
    // Whether what was chosen differs from the ground itself.
    bool any() const { return mRings != nullptr; }
    const GroundRings& rings() const { return *mRings; }                         // where any()
    const Heightfield& ground() const { return mRings->rings.front()->ground; }  // the finest

    // As the scenes of the ground itself are, with and without fog, in all but the ground. Those must outlive
    // this, or others be given; what they point to, too.
    void dress(const CasterScene& foggy, const CasterScene& clear);
    const CasterScene& first(bool withoutFog) const { return (withoutFog ? mClear : mFoggy).front(); }

    std::size_t byteCount() const;

private:
    std::vector<CasterScene> dressed(const CasterScene& whole) const;

    GroundLevels mLevels;
    double mShare;
    std::vector<RingBox> mBoxes;
    std::shared_ptr<const GroundRings> mRings;  // null: the ground itself
    std::vector<CasterScene> mFoggy, mClear;    // finest first
};

}  // namespace stereonav
