// A flight along a line of the plan, such as a walker's track.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// A comfortable look down to the ground ahead, radians.
constexpr double kFollowPitch = -0.25;
// No flight takes longer, seconds; shorter ones go their height each second.
constexpr double kLongestFollow = 900;

// Returns the metres at most, at a place, that the real ground may lie above a coarser one.
using GroundRises = std::function<double(const glm::dvec2& place)>;
// Makes a flight at even speed over the plan, looking along the line as it goes within two seconds before and
// behind, twice averaged, so that corners and the jitter of receivers become turns. Above the ground by
// `height` metres and more, at its samples and between them: over the highest ground within a second's way,
// averaged. Holes are passed at the height beside them. places: two or more that differ, world metres, on the
// ground. rises: null where `ground` is not a coarser one. Throws Error that names `source` where places do
// not differ.
RecordedPath followTrack(const Heightfield& ground, const std::vector<glm::dvec2>& places, double height,
                         const std::string& source, const GroundRises& rises = {});

// Returns the eyes for such a flight at `height` metres: level ground in the middle of the picture lies in
// the screen.
StereoSetting followedEyes(double height);

}  // namespace stereonav
