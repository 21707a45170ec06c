// How far a picture is from its truth: PSNR and SSIM through OpenCV's quality module, and the
// Euclidean distance in RGB that Wan et al. 2004 measure with. All on the 8-bit sRGB bytes that a
// file or a display would get, so that the figures are those of the pictures as seen.
#pragma once

#include <cstdint>

#include "engine/image/eye_image.h"

namespace stereonav {

// The PSNR of identical pictures, and the largest value given: the true one is infinite.
constexpr double kIdenticalPsnr_db = 100.0;

struct ImageDifference {
    double psnr_db = kIdenticalPsnr_db;             // over the three channels together
    double ssim = 1.0;                              // -1 to 1: mean of the channels, 11 x 11 Gaussian window
    double rgb_mean = 0, rgb_p99 = 0, rgb_max = 0;  // Euclidean distance in RGB, 0..441.7
    double edge_psnr_db = kIdenticalPsnr_db;        // inside the mask only; an empty mask: identical
};

// Compares three planes of one size, at least 1 x 1; the mask is set where it is not 0. Throws Error
// otherwise.
ImageDifference differenceOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                             const Plane<std::uint8_t>& edgeMask);

// Returns ImageDifference::psnr_db alone. Throws Error where sizes differ.
double psnrOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image);

// Returns 255 where a warp can go wrong, else 0: the holes, and both sides of every depth edge (neighbours
// whose parallax, parallaxScale / viewDepth, differs by more than a pixel), all grown by `radius` pixels.
Plane<std::uint8_t> edgeMask(const Plane<std::uint8_t>& holeMask, const Plane<float>& viewDepth,
                             double parallaxScale, int radius);

}  // namespace stereonav
