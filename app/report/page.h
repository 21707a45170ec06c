// The page of a report: one self-contained HTML file, charts as inline SVG, pictures inline; for desktop,
// phone and paper, light and dark.
#pragma once

#include <string>

#include "app/report/model.h"

namespace stereonav {

std::string pageOf(const Report& report);

}  // namespace stereonav
