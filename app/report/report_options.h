// What `stereonav report` measures, and where it goes.
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
    std::vector<std::string> scenes;  // beside the built-in ones
    std::optional<UpAxis> up;         // as VolumeOptions, of those that are studies
    bool curvature = false;           // as SceneOptions, of those that are ground
    std::optional<double> refraction;
    std::string compare;             // an earlier run's report.json; "": none
    std::string stability;           // rows that the stability tests wrote; "": those of this build, if any
    int threads = 0;                 // 0: all
    std::uint64_t seed = 1;          // of everything random
    std::optional<double> minutes;   // for all of it
    std::vector<std::string> parts;  // sections by id; empty: all
    bool papers = false;             // the papers' tables beside ours, in the place of the charts
    std::string data;                // folder with real data for them; "": where tests find it
};

}  // namespace stereonav
