// Marks of findings over both eyes' pictures: numbers, outlines and longest diameters, at their depth.
#pragma once

#include <vector>

#include "app/view/finding_list.h"
#include "app/view/view_frame.h"
#include "engine/display/eye_overlay.h"

namespace stereonav {

// Adds the visible marks. letter: height of letters in pixels. guard: see markOf().
void addFindingMarks(const FindingList& findings, const FrameRequest& request, const Plane<float>& viewDepth,
                     const glm::ivec2& guard, float letter, std::vector<OverlayMark>& marks);

}  // namespace stereonav
