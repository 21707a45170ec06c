// Match of a colon's centreline with that of another study.
#pragma once

#include "colon/scene/colon_scene.h"
#include "engine/scene/line_match.h"

namespace stereonav {

class VolumeLine final : public MatchingLine {
public:
    // The colon must outlive this object.
    explicit VolumeLine(const ColonScene& colon) : mColon(colon) {}
    std::shared_ptr<const LineMatch> matchWith(const Scene& other) const override;
    Pose poseOnLine(double along, bool back) const override;

private:
    const ColonScene& mColon;
};

}  // namespace stereonav
