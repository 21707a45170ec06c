// The instruments of colons as plain options and one function each, as commands.h has the other commands.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

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

struct FindingsOptions {
    SceneOptions scene;
    Telling telling;
    bool atTruth = false;                                    // of the built-in colon: where its polyps are
    std::vector<glm::dvec3> at;                              // LPS, metres
    std::vector<std::pair<glm::dvec3, glm::dvec3>> between;  // LPS, metres: places whose distance is asked
    bool candidates = false;                                 // places that look like polyps, too
    std::string comment;                                     // of the one place in `at`
    std::string file;                                        // .json that findings are kept in; "": none
    std::string csv, page, sr;                               // .csv, .html, .dcm, or -; "": not written
};
int runFindings(const FindingsOptions& options);

struct RegisterOptions {
    SceneOptions scene;
    Telling telling;
    std::string with;            // the other study, or colon
    double bend_mm = 0;          // of the other one where it is the built-in colon
    double inflate = 1;          //
    std::vector<glm::dvec3> at;  // LPS, metres, in the first study
    bool force = false;          // though both do not match
    std::string out;             // .csv, or -; "": not written
};
int runRegister(const RegisterOptions& options);

struct UnfoldOptions {
    SceneOptions scene;
    Telling telling;
    std::string out, distortion, panorama;  // pictures; but for `out` "": not written
    double pixel_mm = 0.5;                  // of the wall, > 0
    std::vector<glm::dvec3> at;             // LPS, metres
    std::vector<std::pair<int, int>> pick;  // pixels
    std::string findings;                   // .json of `findings`, marked; "": none
    bool candidates = false, truth = false;
};
int runUnfold(const UnfoldOptions& options);

}  // namespace stereonav
