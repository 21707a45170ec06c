// Options that several commands have beside those of a scene.
#pragma once

#include <optional>

namespace stereonav {

// How a command reports its result: in words, as one JSON document, or not at all.
struct Telling {
    bool json = false;
    bool quiet = false;  // no progress and no notes: only the result, and errors
};

struct SizeOption {
    int width = 1280, height = 720;  // pixels of one eye
};

// Rays per pixel of a whole picture.
struct RayOptions {
    int rays = 1;                    // rays per pixel
    std::optional<double> until_db;  // expected PSNR against very many rays at which to stop; empty: `rays`

    bool many() const { return rays > 1 || until_db; }
};

}  // namespace stereonav
