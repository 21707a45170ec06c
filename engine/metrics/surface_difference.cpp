#include "engine/metrics/surface_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "engine/base/error.h"
#include "engine/image/packed_color.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {
namespace {

constexpr double kNoPsnr = std::numeric_limits<double>::quiet_NaN();

void checkSize(const EyeImage& full, int width, int height, const char* what) {
    if (full.width() != width || full.height() != height)
        throw Error(
            "", what,
            fmt::format("expected {}x{} pixels, got {}x{}", full.width(), full.height(), width, height),
            "give planes of one size");
}

bool showsSurface(const EyeImage& full, int x, int y) {
    return full.viewDepth.at(x, y) < kMissDepth;
}

// Squared difference of the 8-bit sRGB bytes that a display would get.
double squareOf(PackedColor a, PackedColor b) {
    const auto& bytes = srgbByteFromPacked();
    double sum = 0;
    for (int shift = 0; shift < 30; shift += 10) {
        const double off = static_cast<double>(bytes[a >> shift & 1023]) - bytes[b >> shift & 1023];
        sum += off * off;
    }
    return sum;
}

}  // namespace

SurfaceDifference surfaceDifference(const EyeImage& full, const EyeImage& right,
                                    const Plane<std::uint8_t>& holeMask, bool leavesHoles) {
    checkSize(full, right.width(), right.height(), "the picture");
    checkSize(full, holeMask.width(), holeMask.height(), "the holes");
    SurfaceDifference difference;
    double squares = 0;
    long long compared = 0;
    for (int y = 0; y < full.height(); ++y)
        for (int x = 0; x < full.width(); ++x) {
            if (!showsSurface(full, x, y)) continue;
            const bool hole = holeMask.at(x, y) != 0;
            ++difference.surfacePixels;
            difference.holePixels += hole;
            if (hole && leavesHoles) continue;
            squares += squareOf(full.color.at(x, y), right.color.at(x, y));
            ++compared;
        }
    const long long warped = difference.surfacePixels - difference.holePixels;
    difference.holesOfWarped_percent =
        warped > 0 ? 100.0 * static_cast<double>(difference.holePixels) / static_cast<double>(warped)
                   : kNoPsnr;
    difference.psnr_db = kNoPsnr;
    if (compared > 0) {
        const double mean = squares / (3.0 * static_cast<double>(compared));
        difference.psnr_db =
            mean > 0 ? std::min(kIdenticalPsnr_db, 10 * std::log10(255.0 * 255.0 / mean)) : kIdenticalPsnr_db;
    }
    return difference;
}

GapPixels gapPixels(const EyeImage& full, const Plane<std::uint8_t>& holeMask) {
    checkSize(full, holeMask.width(), holeMask.height(), "the holes");
    GapPixels gaps;
    for (int y = 0; y < full.height(); ++y) {
        const std::uint8_t* const holes = holeMask.row(y);
        const std::uint8_t* const end = holes + full.width();
        const auto warped = [](std::uint8_t hole) { return hole == 0; };
        const auto first = std::find_if(holes, end, warped) - holes;
        const auto last =
            full.width() - 1 -
            (std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(holes), warped) -
             std::make_reverse_iterator(end));
        for (int x = 0; x < full.width(); ++x) {
            if (!holes[x] || !showsSurface(full, x, y)) continue;
            // a row of which nothing was warped is one gap from end to end, which the paper fills last
            ++(x < first ? gaps.leftEnd : x > last ? gaps.rightEnd : gaps.middle);
        }
    }
    return gaps;
}

}  // namespace stereonav
