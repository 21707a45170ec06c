#include "engine/scene/line_match.h"

#include <glm/geometric.hpp>

namespace stereonav {

bool looksBack(const MatchingLine& line, double along, const Pose& eye) {
    return glm::dot(line.poseOnLine(along, false).forward(), eye.forward()) < 0;
}

}  // namespace stereonav
