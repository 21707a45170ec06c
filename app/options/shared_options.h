// What several commands take beside a scene.
#pragma once

#include <optional>

namespace stereonav {

// How a command tells what it has done: in words, as one JSON document, or not at all.
struct Telling {
    bool json = false;
    bool quiet = false;  // neither progress nor notes: only what was asked for, and errors
};

struct SizeOption {
    int width = 1280, height = 720;  // pixels of one eye
};

// How many rays each pixel of a whole picture gets.
struct RayOptions {
    int rays = 1;                    // a pixel
    std::optional<double> until_db;  // rays until this PSNR against very many is expected; none: `rays`

    bool many() const { return rays > 1 || until_db; }
};

}  // namespace stereonav
