// The wall of a scene as a picture along the line through it, in which places are found, and back: laid flat,
// or as it is seen from both ends of the line.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// A place of the wall, and the place of the line that it lies at or is seen from.
struct FlatPlace {
    glm::dvec3 wall{0.0}, line{0.0};  // world, metres
    double along = 0;                 // metres from the line's start
};

// A place that is marked in it, with a few letters.
struct FlatMark {
    glm::dvec3 world{0.0};
    std::string label;
};

// Returns the painted colour of wall that has this colour, linear RGB, at a place. From many threads.
using FlatTint = std::function<glm::vec3(const glm::dvec3& world, const glm::vec3& color)>;

// From any thread. Pixels count from the top left corner of the wall; columns go along the line.
class FlatPicture {
public:
    virtual ~FlatPicture() = default;
    virtual int width() const = 0;     // pixels
    virtual int height() const = 0;    // pixels of the wall, without the scale below it
    virtual double pixel() const = 0;  // metres of the wall, the side of a pixel
    // The wall in its light, and its scale. tint: null where nothing is painted.
    virtual Plane<PackedColor> picture(const FlatTint& tint) const = 0;
    // Returns the place on the wall that a pixel shows; nothing beside the wall.
    virtual std::optional<FlatPlace> placeAt(int x, int y) const = 0;
    // Where the wall next to a place shows: once, more often, or not at all; nowhere if that wall is farther
    // than `within` metres.
    virtual std::vector<glm::dvec2> pixelsOf(const glm::dvec3& world, double within) const = 0;
    virtual double columnAt(double along) const = 0;
};

// A capability (capabilities.h).
class FlatWall {
public:
    virtual ~FlatWall() = default;
    // Takes seconds, on any thread, also while frames are made. What it makes lives no longer than the scene.
    // Throws Error, Cancelled.
    virtual std::shared_ptr<const FlatPicture> makeFlat(Progress& progress) const = 0;
    // Makes a picture of the wall as seen along the line, twice: above looking ahead from its start, below
    // looking back from its end.
    virtual std::shared_ptr<const FlatPicture> makePanorama(Progress& progress) const = 0;
};

}  // namespace stereonav
