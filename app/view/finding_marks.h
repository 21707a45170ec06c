// Findings over both eyes' pictures: their numbers, outlines and longest diameters, at their depth.
#pragma once

#include <vector>

#include "app/view/finding_list.h"
#include "app/view/worker.h"
#include "engine/display/eye_overlay.h"

namespace stereonav {

// What is hidden there is left out. letter: how high one is, pixels. guard: as of markOf().
void addFindingMarks(const FindingList& findings, const FrameRequest& request, const Plane<float>& viewDepth,
                     const glm::ivec2& guard, float letter, std::vector<OverlayMark>& marks);

}  // namespace stereonav
