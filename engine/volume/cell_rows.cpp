#include "engine/volume/cell_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

namespace stereonav {
namespace {

// The four rows of voxels around a row of cells.
template <typename T>
struct FourRows {
    const T* rows[4];
    FourRows(const Volume<T>& volume, int j, int k) {
        for (int n = 0; n < 4; ++n)
            rows[n] = volume.values.data() + volume.frame.index(0, j + (n & 1), k + (n >> 1));
    }
};

// Values of a cell along a ray are off by less than this in single precision: some roundings of 2^-24 of the
// 65,535 that two 16-bit numbers may lie apart.
constexpr float kValueRounding = 0x1p-4f;

// Returns whether any voxel of the cell or of those around it is at most `value`.
bool anyAround(const GreyVolume& volume, int i, int j, int k, int value) {
    const glm::ivec3 first = glm::max(glm::ivec3(i, j, k) - 1, 0),
                     last = glm::min(glm::ivec3(i, j, k) + 2, volume.frame.size - 1);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                if (volume.at(x, y, z) <= value) return true;
    return false;
}

}  // namespace

VolumeFrame cellFrameOf(const VolumeFrame& voxels) {
    VolumeFrame cells = voxels;
    cells.size = voxels.size - 1;
    cells.origin = voxels.worldFromVoxel(glm::dvec3(0.5));
    return cells;
}

bool anySet(const std::uint8_t* row, int count) {
    int i = 0;
    for (; i + 8 <= count; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, row + i, 8);
        if (eight != 0) return true;
    }
    for (; i < count; ++i)
        if (row[i]) return true;
    return false;
}

bool flagRegion(const MaskVolume& mask, int j, int k, int cells, std::uint8_t* region) {
    const FourRows<std::uint8_t> m(mask, j, k);
    if (std::none_of(std::begin(m.rows), std::end(m.rows),
                     [&](const std::uint8_t* row) { return anySet(row, cells + 1); }))
        return false;
    for (int i = 0; i < cells; ++i) {
        const int any = m.rows[0][i] | m.rows[0][i + 1] | m.rows[1][i] | m.rows[1][i + 1] | m.rows[2][i] |
                        m.rows[2][i + 1] | m.rows[3][i] | m.rows[3][i + 1];
        region[i] = any != 0;
    }
    return true;
}

void flagActive(const GreyVolume& volume, const SurfaceSetting& setting, int j, int k, int cells,
                const std::uint8_t* region, std::uint8_t* active) {
    const FourRows<std::int16_t> v(volume, j, k);
    const bool surfaceAlone = setting.lowest == setting.highest;
    // The limits as 16-bit numbers: maximum >= lowest, minimum <= highest (< for the surface alone, where a
    // cell at or above it throughout holds none).
    const int lowest = static_cast<int>(std::clamp(std::ceil(setting.lowest), -32768.0f, 32767.0f));
    const float top = surfaceAlone ? std::ceil(setting.highest) - 1.0f : std::floor(setting.highest);
    const int highest = static_cast<int>(std::clamp(top, -32769.0f, 32767.0f));
    const auto lowOf = [&](int i) {
        const auto least = [&](int n) { return std::min(v.rows[n][i], v.rows[n][i + 1]); };
        return static_cast<int>(std::min(std::min(least(0), least(1)), std::min(least(2), least(3))));
    };
    unsigned touching = 0;
    for (int i = 0; i < cells; ++i) {
        const auto most = [&](int n) { return std::max(v.rows[n][i], v.rows[n][i + 1]); };
        const int low = lowOf(i);
        const int high = std::max(std::max(most(0), most(1)), std::max(most(2), most(3)));
        active[i] = (region[i] != 0) & (high >= lowest) & (low <= highest);
        touching |= (region[i] != 0) & (low == highest + 1);
    }
    // A cell of such values that begins at the surface itself, where it lies beside lower ones: rounding may
    // carry a ray past the crossing on the face between the two, and it must not go on through what is solid.
    const bool mayBePassed = surfaceAlone && std::ceil(setting.highest) - setting.highest < kValueRounding;
    if (!touching || !mayBePassed) return;
    for (int i = 0; i < cells; ++i)
        if (region[i] && lowOf(i) == highest + 1 && anyAround(volume, i, j, k, highest)) active[i] = 1;
}

}  // namespace stereonav
