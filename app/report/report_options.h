// Options of `stereonav report`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/options/shared_options.h"
#include "engine/volume/volume_up.h"

namespace stereonav {

struct ReportOptions {
    Telling telling;
    std::string out = "report";       // folder
    bool quick = false;               // within a minute, with fewer frames and repeats
    std::vector<std::string> scenes;  // scenes beside the built-in ones
    std::optional<UpAxis> up;         // see VolumeOptions; for CT studies
    bool curvature = false;           // see SceneOptions; for ground
    std::optional<double> refraction;
    std::string compare;             // report.json of an earlier run; "": none
    std::string stability;           // rows of the stability tests; "": those of this build, if any
    int threads = 0;                 // 0: all
    std::uint64_t seed = 1;          // seed of all random numbers
    std::optional<double> minutes;   // for the whole report
    std::vector<std::string> parts;  // sections by id; empty: all
    bool papers = false;             // the papers' tables beside ours, instead of the charts
    std::string data;                // folder with real data for the papers; "": the one of the tests
};

}  // namespace stereonav
