// The wall of a scene as a picture along the line through it, either unfolded or as seen from both ends of
// the line; places on the wall can be found in it, and back.
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

// A place on the wall, and the point of the line to which it belongs or from which it is seen.
struct FlatPlace {
    glm::dvec3 wall{0.0}, line{0.0};  // world, metres
    double along = 0;                 // metres from the line's start
};

// A marked place in the picture, with a few letters.
struct FlatMark {
    glm::dvec3 world{0.0};
    std::string label;
};

// Returns the painted colour, linear RGB, of wall with this colour at a place. From many threads.
using FlatTint = std::function<glm::vec3(const glm::dvec3& world, const glm::vec3& color)>;

// A picture of the wall. From any thread. Pixels count from the top left corner of the wall; columns follow
// the line.
class FlatPicture {
public:
    virtual ~FlatPicture() = default;
    virtual int width() const = 0;     // pixels
    virtual int height() const = 0;    // pixels of the wall, without the scale below it
    virtual double pixel() const = 0;  // side of a pixel, metres on the wall
    // Returns the lit wall, and its scale. tint: null where nothing is painted.
    virtual Plane<PackedColor> picture(const FlatTint& tint) const = 0;
    // Returns the place on the wall that a pixel shows; empty where it shows no wall.
    virtual std::optional<FlatPlace> placeAt(int x, int y) const = 0;
    // Returns the pixels that show the wall next to a place: one, several, or none; none if that wall is
    // farther away than `within` metres.
    virtual std::vector<glm::dvec2> pixelsOf(const glm::dvec3& world, double within) const = 0;
    virtual double columnAt(double along) const = 0;
};

// A capability (capabilities.h).
class FlatWall {
public:
    virtual ~FlatWall() = default;
    // Unfolds the wall. Takes seconds; on any thread, while frames are made. The result must not outlive the
    // scene. Throws Error, Cancelled.
    virtual std::shared_ptr<const FlatPicture> makeFlat(Progress& progress) const = 0;
    // Makes a picture of the wall as seen along the line, twice: above looking ahead from its start, below
    // looking back from its end.
    virtual std::shared_ptr<const FlatPicture> makePanorama(Progress& progress) const = 0;
};

}  // namespace stereonav
