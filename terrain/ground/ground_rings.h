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
    glm::ivec2 low{0}, size{0};  // samples of the level: the first; how many
    bool operator==(const RingBox&) const = default;
};

// Eyes and accuracy by which rings are chosen.
struct RingWish {
    glm::dvec3 eye{0.0};    // world, metres
    double pixelAngle = 0;  // metres that a pixel covers, for a metre of distance
    double share = 0.5;     // share of a pixel that a level may be off; 0: the ground itself
    glm::dvec3 way{0.0};    // metres; also for eyes along this way, from `eye`
    bool sinks = false;     // the ground is seen lower than it lies, over a round Earth
    std::optional<glm::dvec3> other = std::nullopt;  // a second eye, which goes the same way
};

// Returns the boxes of the rings, the finest first. All but the last hold the places below the eyes, and each
// lies within the next, but for what the next one lacks at the ground's north and east; the last is all of
// its level. Where an eye is not over the ground there is one box. A level is taken for a block where its
// bound there is at most the share of what a pixel covers at the block's nearest place; between boxes the
// surface has steps of that size.
std::vector<RingBox> planRings(const GroundLevels& levels, const RingWish& wish);

// Returns whether `boxes` are at least as fine as `needed`, wherever those are. Both are of one ground, as
// planRings() gives them.
bool coverRings(const std::vector<RingBox>& boxes, const std::vector<RingBox>& needed);

// A box with its samples.
struct GroundRing {
    RingBox box;
    Heightfield ground;
    HeightPyramid maxima;
};

// The rings of some boxes, the finest first. Does not change.
struct GroundRings {
    std::vector<std::shared_ptr<const GroundRing>> rings;
    double steepest = 0;   // metres a metre, the most of all
    float errorBound = 0;  // metres: the ground itself is nowhere further away
};

// Returns the boxes that hold the place below the eye, and the last: what is to be cast where the eye has
// left some.
std::vector<RingBox> ringsAround(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                 const glm::dvec3& eye);

// Reads the boxes. before: rings of it that are there already are taken over; null for none. Throws Error
// where levels are stored and can not be read.
std::shared_ptr<const GroundRings> makeRings(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                             const GroundRings* before);

}  // namespace stereonav
