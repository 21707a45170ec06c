// Sizes of studies against what this machine holds, before memory is taken.
#include <fmt/format.h>
#include <unistd.h>

#include <limits>

#include "colon/study_parts.h"

namespace stereonav {
namespace {

std::string bytesText(double bytes) {
    const char* units[] = {"bytes", "KB", "MB", "GB", "TB", "PB", "EB"};
    int unit = 0;
    for (; bytes >= 1000 && unit < 6; ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
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

void checkSize(const std::string& file, const std::vector<std::uint64_t>& size, int bytesPerVoxel) {
    // In floating point, so that no product overflows.
    double voxels = 1;
    for (const std::uint64_t n : size) voxels *= static_cast<double>(n);
    for (const std::uint64_t n : size)
        if (n < 2)
            throw Error(file, "",
                        fmt::format("expected a volume with 2 or more voxels along each axis, found {}",
                                    sizeText(size)),
                        "a single slice has no depth: give the whole series");
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE);
    bool tooLong = false;
    for (const std::uint64_t n : size) tooLong |= n > std::numeric_limits<int>::max();
    if (tooLong || voxels * bytesPerVoxel > memory)
        throw Error(file, "",
                    fmt::format("{} voxels need {}, this machine has {}", sizeText(size),
                                bytesText(voxels * bytesPerVoxel), bytesText(memory)),
                    "crop the volume or make it coarser");
}

}  // namespace stereonav
