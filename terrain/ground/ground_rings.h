// Ground around an eye: the finest samples near it, coarser ones in rings around them, chosen so that none is
// off by more than a share of what a pixel covers there.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "terrain/ground/ground_levels.h"
#include "terrain/ground/height_pyramid.h"

namespace stereonav {

// A rectangle of samples of one level, from one of its blocks to another, or to the ground's border.
struct RingBox {
    int level = 0;
    glm::ivec2 low{0}, size{0};
    bool operator==(const RingBox&) const = default;
};

struct RingWish {
    glm::dvec3 eye{0.0};    // world, metres
    double pixelAngle = 0;  // radians: metres that a pixel covers, for a metre of distance
    double share = 0.5;     // of that, which a level may be off; 0: the ground itself
    glm::dvec3 way{0.0};    // and for eyes along this way, from `eye`
    bool sinks = false;     // the ground is seen lower than it lies, over a round Earth
    std::optional<glm::dvec3> other = std::nullopt;  // a second eye, which goes the same way
};

// Finest first. All but the last hold the places below the eyes, and lie within the next, but for what that
// one lacks at the ground's north and east; the last is all of its level. Where an eye is not over the ground
// there is one. A level is taken for a block where its bound there is at most the share of what a pixel
// covers at the block's nearest place; between boxes the surface has steps of that size.
std::vector<RingBox> planRings(const GroundLevels& levels, const RingWish& wish);

// Whether the boxes are at least as fine as those that are needed, wherever those are. Of the same ground,
// both as planRings() gives them.
bool coverRings(const std::vector<RingBox>& boxes, const std::vector<RingBox>& needed);

struct GroundRing {
    RingBox box;
    Heightfield ground;
    HeightPyramid maxima;
};

// What the boxes hold. Does not change.
struct GroundRings {
    std::vector<std::shared_ptr<const GroundRing>> rings;
    double steepest = 0;   // metres a metre, of all
    float errorBound = 0;  // metres, of their levels: the ground itself is nowhere further away
};

// Those that hold the place below the eye, and the last: what is to be cast where the eye has left some.
std::vector<RingBox> ringsAround(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                 const glm::dvec3& eye);

// before: what there is of it is taken over; null for none. Throws Error where levels are stored and can not
// be read.
std::shared_ptr<const GroundRings> makeRings(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                             const GroundRings* before);

}  // namespace stereonav
