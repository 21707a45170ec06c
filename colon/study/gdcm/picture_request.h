// The messages between the program and its helper stereonav_gdcm (engine/base/helper_program.h): a
// PictureRequest, the lengths of its parts (std::uint64_t each) and the parts; then the pixels and, behind
// them, a PictureAnswer.
#pragma once

#include <array>
#include <cstdint>

namespace stereonav {

struct PictureRequest {
    std::array<char, 64> syntax{};  // the transfer syntax, a UID, ends with 0
    std::int32_t columns = 0, rows = 0;
    std::int32_t bits = 16, stored = 16, high = 15;  // PS3.5 8.1.1
    std::int32_t isSigned = 0;
    std::uint64_t parts = 0;
};
struct PictureAnswer {
    std::int32_t bits = 16;  // a pixel: 8, 16 or 32
    std::int32_t isSigned = 0;
};

}  // namespace stereonav
