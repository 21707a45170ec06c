// A ColorTexture as kernels read it: plain structs and pointers only, since kernels are compiled for wider
// instruction sets and must not share inline code with the rest (see cmake/rooms.cmake).
#pragma once

#include <cstdint>

namespace stereonav {

struct TextureData {
    const std::uint32_t* texels = nullptr;                 // null: none
    std::int32_t offset[16] = {};                          // index of each level's first texel
    int levels = 0, width = 0, height = 0;                 // width and height of level 0
    float scaleX = 1, scaleY = 1, shiftX = 0, shiftY = 0;  // texel = place * scale + shift
    float texelsPerMetre = 1;                              // texels of level 0
};

}  // namespace stereonav
