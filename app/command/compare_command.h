// `stereonav compare`, which the program without a command runs too.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/scene_options.h"

namespace stereonav {

struct CompareOptions {
    SceneOptions scene;
    Telling telling;  // quiet: no progress, and the table only where nothing else was asked for
    SizeOption size{500, 400};
    std::string path;
    int frames = 24;
    std::vector<std::string> methods;          // empty: all
    std::optional<double> relativeSeparation;  // share of the zero-parallax distance; none: the scene's
    std::string json, csv, images, plot;       // "": not written
    int repeats = 3;                           // timed runs of a frame, the fastest counts
    int truthRays = 64;                        // a pixel of the finer truths: a square number, 1 to 256
    bool butteraugli = false;
};

int runCompare(const CompareOptions& options);

}  // namespace stereonav
