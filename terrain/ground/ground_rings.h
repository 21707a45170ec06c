// Ground around an eye: the finest samples near it, coarser ones in rings around them, chosen so that the
// error is at most a share of what a pixel covers.
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
    glm::ivec2 low{0}, size{0};  // samples of the level: first one; number
    bool operator==(const RingBox&) const = default;
};

// The eyes and the accuracy for which rings are chosen.
struct RingWish {
    glm::dvec3 eye{0.0};    // world, metres
    double pixelAngle = 0;  // metres that a pixel covers, per metre of distance
    double share = 0.5;     // largest error, as a share of a pixel; 0: the ground itself
    glm::dvec3 way{0.0};    // metres; the rings are also for eyes on this way from `eye`
    bool sinks = false;     // the ground appears lower than it is, on a round Earth
    std::optional<glm::dvec3> other = std::nullopt;  // a second eye, which moves the same way
};

// Returns the boxes of the rings, the finest first. All but the last contain the places below the eyes, and
// each lies within the next, except for cells that the next one lacks in the north and east of the ground;
// the last contains all of its level. Where an eye is not over the ground there is one box. A level is used
// for a block where its bound there is at most the share of what a pixel covers at the block's nearest place;
// between boxes the surface has steps of that size.
std::vector<RingBox> planRings(const GroundLevels& levels, const RingWish& wish);

// Returns whether `boxes` are at least as fine as `needed` everywhere that those cover. Both come from
// planRings() for the same ground.
bool coverRings(const std::vector<RingBox>& boxes, const std::vector<RingBox>& needed);

// A box with its samples.
struct GroundRing {
    RingBox box;
    Heightfield ground;
    HeightPyramid maxima;
};

// The rings of some boxes, the finest first. Immutable.
struct GroundRings {
    std::vector<std::shared_ptr<const GroundRing>> rings;
    double steepest = 0;   // metres per metre, the largest of all rings
    float errorBound = 0;  // metres: largest distance to the ground itself
};

// Returns those boxes that contain the place below the eye, and the last one: the boxes to cast when the eye
// has left some of them.
std::vector<RingBox> ringsAround(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                 const glm::dvec3& eye);

// Reads the boxes. before: earlier rings, of which equal ones are reused; null for none. Throws Error where
// stored levels can not be read.
std::shared_ptr<const GroundRings> makeRings(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                             const GroundRings* before);

}  // namespace stereonav
