// The instruments of colons as plain options and one function each, as commands.h has the other commands.
#pragma once

#include <string>

#include "app/command/commands.h"

namespace stereonav {

struct CoverageOptions {
    SceneOptions scene;  // its field of view is that of the picture
    Telling telling;
    SizeOption size{512, 512};  // of which the shape alone counts
    std::string path;           // a recorded flight; "": along the centreline
    double step_mm = 2;         // between poses, > 0
    double within_mm = 100;     // from the eye, > 0
    double angle_deg = 85;      // off the wall's normal, in (0, 90]
    double patch_mm2 = 300;     // the smallest patch that is listed, >= 0
    std::string out;            // .csv of the patches, or -; "": not written
};
int runCoverage(const CoverageOptions& options);

}  // namespace stereonav
