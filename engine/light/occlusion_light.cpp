// See the header. Slices of cells are looked at one by one; the texels of a slice of bricks are written by
// one thread.
#include "engine/light/occlusion_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kLightBrick = 8;  // texels along an edge

// Stored numbers [low, high] that values [lowest, highest] come from.
struct StoredRange {
    double low, high;
    StoredRange(const GreyVolume& volume, double lowest, double highest)
        : low((lowest - volume.offset) / volume.scale), high((highest - volume.offset) / volume.scale) {
        if (low > high) std::swap(low, high);
    }
    bool meets(int least, int most) const { return most >= low && least <= high; }
};

// Marks the voxels of slices k and k + 1 that belong to a cell between them whose values meet the range:
// touched[j * size.x + i].
void markCells(const GreyVolume& volume, const StoredRange& range, int k,
               std::vector<std::uint8_t>& touched) {
    const glm::ivec3 size = volume.frame.size;
    const std::int16_t* slice = volume.values.data() + volume.frame.index(0, 0, k);
    const std::ptrdiff_t row = size.x, up = static_cast<std::ptrdiff_t>(size.x) * size.y;
    for (int j = 0; j + 1 < size.y; ++j)
        for (int i = 0; i + 1 < size.x; ++i) {
            const std::ptrdiff_t at = j * row + i;
            const std::array<std::ptrdiff_t, 4> corners{at, at + 1, at + row, at + row + 1};
            int least = 32767, most = -32768;
            for (const std::ptrdiff_t c : corners)
                for (const int value : {int{slice[c]}, int{slice[c + up]}}) {
                    least = std::min(least, value);
                    most = std::max(most, value);
                }
            if (!range.meets(least, most)) continue;
            for (const std::ptrdiff_t c : corners) touched[static_cast<std::size_t>(c)] = 1;
        }
}

// What each openness becomes.
std::array<PackedTexel, 256> packAll(float k) {
    std::array<PackedTexel, 256> packed{};
    for (int n = 0; n < 256; ++n)
        packed[static_cast<std::size_t>(n)] =
            packTexel(glm::vec3(std::min(k * static_cast<float>(n) / 255.0f, 1.0f)), 1.0f);
    return packed;
}

}  // namespace

IlluminationVolume ambientLight(const GreyVolume& volume, const OpennessVolume& openness, double lowest,
                                double highest, float k) {
    const glm::ivec3 size = volume.frame.size;
    if (openness.frame.size != size)
        throw Error("", "ambient light",
                    fmt::format("expected openness of {}x{}x{} voxels, got {}x{}x{}", size.x, size.y, size.z,
                                openness.frame.size.x, openness.frame.size.y, openness.frame.size.z),
                    "estimate it from the same volume");
    if (!(k > 0 && std::isfinite(k)))
        throw Error("", "ambient light", fmt::format("expected a strength above 0, got {}", k), "use 2");
    IlluminationVolume light(volume.frame);
    if (std::min({size.x, size.y, size.z}) < 2) return light;
    const StoredRange range(volume, lowest, highest);
    const std::array<PackedTexel, 256> packed = packAll(k);
    parallelFor((size.z + kLightBrick - 1) / kLightBrick, [&](int brick) {
        std::vector<std::uint8_t> touched(static_cast<std::size_t>(size.x) * size.y);
        for (int z = brick * kLightBrick; z < std::min((brick + 1) * kLightBrick, size.z); ++z) {
            std::fill(touched.begin(), touched.end(), std::uint8_t{0});
            if (z > 0) markCells(volume, range, z - 1, touched);
            if (z + 1 < size.z) markCells(volume, range, z, touched);
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i)
                    if (touched[static_cast<std::size_t>(j) * size.x + i])
                        light.texels[light.layout.index(i, j, z)] = packed[openness.at(i, j, z)];
        }
    });
    return light;
}

}  // namespace stereonav
