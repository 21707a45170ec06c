// Problems of one entry of a transfer function, for its constructors, which name the entry, and for the
// reader of its text file, which names the line.
#pragma once

#include <string>

#include "engine/medium/model/medium_transfer.h"

namespace stereonav {

// Return "expected ..., got ..."; "" when nothing is wrong. previous: null for the first point.
std::string problemOf(const MediumPoint& point, const MediumPoint* previous);
std::string problemOf(const MediumRegion& region);
std::string problemOfReference(double metres);

}  // namespace stereonav
