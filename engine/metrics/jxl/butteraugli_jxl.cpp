// Butteraugli, through libjxl.
#include <jxl/butteraugli.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/base/parallel.h"
#include "engine/metrics/butteraugli_module.h"

namespace stereonav {
namespace {

constexpr float kAsymmetry = 1;      // what is lost counts as what is added
constexpr std::uint32_t kLeast = 8;  // pixels a side: it knows no smaller pictures

// libjxl's loops on the program's threads: a run of values each, under a number that is its own.
JxlParallelRetCode runLoop(void*, void* job, JxlParallelRunInit init, JxlParallelRunFunction function,
                           std::uint32_t begin, std::uint32_t end) {
    if (begin >= end) return 0;
    const std::uint32_t count = end - begin,
                        parts = std::min(count, static_cast<std::uint32_t>(threadCount()));
    if (const JxlParallelRetCode failed = init(job, parts)) return failed;
    parallelFor(static_cast<int>(parts), [&](int part) {
        const auto bound = [&](std::uint64_t n) {
            return begin + static_cast<std::uint32_t>(n * count / parts);
        };
        const auto own = static_cast<std::uint32_t>(part);
        for (std::uint32_t value = bound(own); value < bound(own + 1); ++value) function(job, value, own);
    });
    return 0;
}

// Three bytes a pixel, the last row and column repeated up to the least size.
std::vector<std::uint8_t> bytesOf(const Plane<PackedColor>& picture, std::uint32_t width,
                                  std::uint32_t height) {
    const auto& byte = srgbByteFromPacked();
    std::vector<std::uint8_t> bytes;
    bytes.reserve(std::size_t{3} * width * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const PackedColor color = picture.at(std::min(static_cast<int>(x), picture.width() - 1),
                                                 std::min(static_cast<int>(y), picture.height() - 1));
            for (int shift = 0; shift < 30; shift += 10) bytes.push_back(byte[color >> shift & 1023]);
        }
    return bytes;
}

[[noreturn]] void refuse() {
    throw Error("", "Butteraugli", "libjxl could not compare the pictures", "try smaller pictures");
}

}  // namespace

ButteraugliMap butteraugliOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image) {
    const std::unique_ptr<JxlButteraugliApi, void (*)(JxlButteraugliApi*)> api(
        JxlButteraugliApiCreate(nullptr), JxlButteraugliApiDestroy);
    if (!api) refuse();
    JxlButteraugliApiSetParallelRunner(api.get(), runLoop, nullptr);
    JxlButteraugliApiSetHFAsymmetry(api.get(), kAsymmetry);
    JxlButteraugliApiSetIntensityTarget(api.get(), kButteraugliWhite_nits);
    const std::uint32_t width = std::max(kLeast, static_cast<std::uint32_t>(truth.width())),
                        height = std::max(kLeast, static_cast<std::uint32_t>(truth.height()));
    const std::vector<std::uint8_t> a = bytesOf(truth, width, height), b = bytesOf(image, width, height);
    const JxlPixelFormat format{3, JXL_TYPE_UINT8, JXL_NATIVE_ENDIAN, 0};
    const std::unique_ptr<JxlButteraugliResult, void (*)(JxlButteraugliResult*)> result(
        JxlButteraugliCompute(api.get(), width, height, &format, a.data(), a.size(), &format, b.data(),
                              b.size()),
        JxlButteraugliResultDestroy);
    if (!result) refuse();
    ButteraugliMap map;
    map.norm3 = JxlButteraugliResultGetDistance(result.get(), 3);
    map.max = JxlButteraugliResultGetMaxDistance(result.get());
    const float* distances = nullptr;
    std::uint32_t stride = 0;
    JxlButteraugliResultGetDistmap(result.get(), &distances, &stride);
    map.distances.resize(truth.width(), truth.height());
    for (int y = 0; y < truth.height(); ++y)
        std::copy_n(distances + std::size_t{stride} * static_cast<std::size_t>(y), truth.width(),
                    map.distances.row(y));
    return map;
}

namespace {
constexpr ButteraugliFunctions kFunctions = {butteraugliOf};
}

const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
