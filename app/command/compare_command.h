// `stereonav compare`, which also runs without a command.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/scene_options.h"

namespace stereonav {

struct CompareOptions {
    SceneOptions scene;
    Telling telling;  // quiet: no progress, and the table only where no other output is asked for
    SizeOption size{500, 400};
    std::string path;
    int frames = 24;
    std::vector<std::string> methods;          // empty: all methods
    std::optional<double> relativeSeparation;  // share of the zero-parallax distance; empty: the scene's
    std::string json, csv, images, plot;       // "": not written
    int repeats = 3;                           // timed runs of each frame; the fastest counts
    int truthRays = 64;                        // rays per pixel of finer truths: a square number, 1 to 256
    bool butteraugli = false;
};

int runCompare(const CompareOptions& options);

}  // namespace stereonav
