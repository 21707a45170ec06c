// The messages between the program and its helper stereonav_picture_reader (engine/base/helper_program.h): an
// ImageRequest and the file's bytes; in answer the samples (blue, green and red of each pixel, rows from the
// top) and, behind them, an ImageAnswer.
#pragma once

#include <cstdint>

#include "engine/image/picture_format.h"

namespace stereonav {

struct ImageRequest {
    PictureFormat format = PictureFormat::Png;
    std::int32_t width = 0, height = 0;  // pixels, by the file's header
};
struct ImageAnswer {
    std::int32_t width = 0, height = 0;  // the other way round where the file says that it lies on its side
    std::int32_t sampleBytes = 1;        // 1 or 2 of whole numbers, 4 of floats
};

}  // namespace stereonav
