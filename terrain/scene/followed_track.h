// A flight along a line on the map, such as a hiking track.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Comfortable pitch for looking down to the ground ahead, radians.
constexpr double kFollowPitch = -0.25;
// Longest duration of a flight, seconds; shorter flights cover a distance equal to their height each second.
constexpr double kLongestFollow = 900;

// Returns the largest height in metres by which the real ground may rise above a coarser one at a place.
using GroundRises = std::function<double(const glm::dvec2& place)>;
// Makes a flight at even speed in plan. It looks in the direction of the line within two seconds before and
// behind, averaged twice, so that corners and the jitter of receivers become smooth turns. It is at least
// `height` metres above the ground everywhere, above the average of the highest ground within a second's
// flight. Holes are passed at the height beside them. places: two or more different ones, world metres, on
// the ground. rises: empty where `ground` is the finest one. Throws Error that names `source` where the
// places do not differ.
RecordedPath followTrack(const Heightfield& ground, const std::vector<glm::dvec2>& places, double height,
                         const std::string& source, const GroundRises& rises = {});

// Returns the eyes for such a flight at `height` metres: level ground in the middle of the picture lies in
// the plane of the screen.
StereoSetting followedEyes(double height);

}  // namespace stereonav
