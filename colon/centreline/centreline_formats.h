// The file forms of a centreline, for centreline_file.cpp: millimetres in the text.
#pragma once

#include <string>
#include <vector>

#include "colon/centreline/centreline.h"

namespace stereonav {

// Returns where runs of one segment begin, and, last, the number of points.
std::vector<std::size_t> segmentStarts(const Centreline& line);

constexpr const char* kRadiusArray = "MaximumInscribedSphereRadius";
constexpr const char* kSegmentArray = "Segment";

std::string vtkText(const Centreline& line);  // legacy poly data
std::string vtpText(const Centreline& line);  // XML poly data

}  // namespace stereonav
