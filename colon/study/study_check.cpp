// Sizes of studies against the memory that can be had, before any is taken.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "colon/study/study_parts.h"
#include "engine/base/memory.h"

namespace stereonav {
namespace {

std::string bytesText(double bytes) {
    const char* units[] = {"bytes", "KB", "MB", "GB", "TB", "PB", "EB"};
    int unit = 0;
    for (; bytes >= 1000 && unit < 6; ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

// Multiplies in floating point, so that no product overflows.
double voxelsOf(const std::vector<std::uint64_t>& size) {
    double voxels = 1;
    for (const std::uint64_t n : size) voxels *= static_cast<double>(n);
    return voxels;
}

}  // namespace

int bytesOf(SampleType type) {
    switch (type) {
        case SampleType::UInt8:
        case SampleType::Int8:
            return 1;
        case SampleType::UInt16:
        case SampleType::Int16:
            return 2;
        case SampleType::UInt32:
        case SampleType::Int32:
        case SampleType::Float32:
            return 4;
        default:
            return 8;
    }
}

std::string sizeText(const std::vector<std::uint64_t>& size) {
    return fmt::format("{}", fmt::join(size, " x "));
}

void checkFrame(const std::string& file, const VolumeFrame& frame) {
    constexpr double kLeast = 1e-9,
                     kMost = 1e9;       // millimetres: a thousandth of an atom, a thousand kilometres
    constexpr double kMostUneven = 50;  // slices of 10 mm and pixels of 0.3 are 33
    constexpr double kFarthest = 1e10;  // spacings from the origin: doubles tell a millionth apart
    const glm::dvec3 mm = frame.spacing * 1e3;
    const double least = std::min({mm.x, mm.y, mm.z}), most = std::max({mm.x, mm.y, mm.z});
    const std::string found = fmt::format("{:.4g} x {:.4g} x {:.4g} mm", mm.x, mm.y, mm.z);
    if (!(least >= kLeast && most <= kMost))
        throw Error(file, "",
                    fmt::format("expected a spacing of {:g} to {:g} mm, found {}", kLeast, kMost, found),
                    "correct it in the header");
    if (most > kMostUneven * least)
        throw Error(file, "",
                    fmt::format("its spacing is too uneven: {}, the largest is {:.3g} times the smallest, "
                                "expected at most {:g} times",
                                found, most / least, kMostUneven),
                    "correct it in the header, or resample the volume");
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(frame.origin[axis]) <= kFarthest * 1e-3 * least))
            throw Error(file, "",
                        fmt::format("expected an origin within {:g} spacings, found {:.4g} mm", kFarthest,
                                    frame.origin[axis] * 1e3),
                        "correct it in the header");
}

double bytesHeld(const std::vector<std::uint64_t>& size, int sampleBytes, const StudyOptions& options) {
    const double voxels = voxelsOf(size), values = voxels * sizeof(std::int16_t);
    return std::max(voxels * sampleBytes, values + (options.working ? options.working(voxels) : 0.0));
}

void checkSize(const std::string& file, const std::vector<std::uint64_t>& size, double bytes) {
    for (const std::uint64_t n : size)
        if (n < 2)
            throw Error(file, "",
                        fmt::format("expected a volume with 2 or more voxels along each axis, found {}",
                                    sizeText(size)),
                        "a single slice has no depth: give the whole series");
    const double there = availableMemoryFor(bytes);
    bool tooLong = false;
    for (const std::uint64_t n : size) tooLong |= n > std::numeric_limits<int>::max();
    if (!tooLong && bytes <= there) return;
    const double share = std::cbrt(std::min(1.0, there / bytes));
    std::vector<std::uint64_t> fits;
    fits.reserve(size.size());
    for (const std::uint64_t n : size)
        fits.push_back(static_cast<std::uint64_t>(std::max(1.0, share * static_cast<double>(n))));
    throw Error(file, "",
                fmt::format("{} voxels need {} of memory, and {} is available", sizeText(size),
                            bytesText(bytes), bytesText(there)),
                fmt::format("crop the volume or make it coarser: {} would fit", sizeText(fits)));
}

}  // namespace stereonav
