#include "app/scene/volume/line_match.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "colon/instruments/registration.h"
#include "engine/base/error.h"
#include "engine/nav/flight_to.h"

namespace stereonav {
namespace {

constexpr double kLookAlong = 0.02;  // metres of the line that give its direction

class ColonMatch final : public LineMatch {
public:
    ColonMatch(const Centreline& here, const Centreline& there) : mLines(here, there) {}
    double toOther(double along) const override { return mLines.toSecond(along); }
    double fromOther(double along) const override { return mLines.toFirst(along); }
    double cost() const override { return mLines.cost(); }
    bool matches() const override { return mLines.matches(); }

private:
    LineRegistration mLines;
};

}  // namespace

std::shared_ptr<const LineMatch> VolumeLine::matchWith(const Scene& other) const {
    const auto* const colon = other.offered<const ColonScene>();
    if (!colon || !colon->isColon())
        throw Error(other.name, "", "no colon was found", "give a study that is one");
    return std::make_shared<const ColonMatch>(mColon.centreline, colon->centreline);
}

Pose VolumeLine::poseOnLine(double along, bool back) const {
    const Centreline& line = mColon.centreline;
    const double length = line.length(), at = std::clamp(along, 0.0, length),
                 from = std::clamp(at, 0.0, std::max(length - kLookAlong, 0.0));
    const glm::dvec3 here = placeAlong(line, at),
                     way = placeAlong(line, std::min(from + kLookAlong, length)) - placeAlong(line, from);
    Pose pose = mColon.startPose;
    pose.position = here;
    if (!(glm::length(way) > 0)) return pose;
    const glm::dvec3 ahead = (back ? -1.0 : 1.0) * glm::normalize(way);
    return poseLookingAt(here + kLookAlong * ahead, kLookAlong, pose);
}

}  // namespace stereonav
