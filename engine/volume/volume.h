// A grid of samples in space. Voxel space: voxel (i, j, k) is the point (i, j, k), its centre; i runs
// fastest in memory. World: metres; for CT the patient's axes (x to the left, y to the back, z to the
// head: DICOM's LPS), so that z is up as everywhere in the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "engine/base/lazy_array.h"

namespace stereonav {

// Where a grid's voxels lie.
struct VolumeFrame {
    glm::ivec3 size{0};       // voxels
    glm::dvec3 spacing{1.0};  // metres between neighbours along i, j, k; > 0
    glm::dvec3 origin{0.0};   // world position of voxel (0, 0, 0)
    glm::dmat3 axes{1.0};     // columns: unit world directions of i, j, k; orthogonal, either handedness

    std::size_t count() const { return static_cast<std::size_t>(size.x) * size.y * size.z; }
    std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size.y + j) * size.x + i;
    }
    std::size_t index(const glm::ivec3& v) const { return index(v.x, v.y, v.z); }
    bool contains(const glm::ivec3& v) const {
        return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
    }

    glm::dvec3 worldFromVoxel(const glm::dvec3& voxel) const { return origin + axes * (spacing * voxel); }
    glm::dvec3 voxelFromWorld(const glm::dvec3& world) const {
        return (glm::transpose(axes) * (world - origin)) / spacing;
    }
    // Turns directions into voxels: no origin; a metre becomes 1 / spacing.
    glm::dvec3 voxelDirection(const glm::dvec3& world) const {
        return (glm::transpose(axes) * world) / spacing;
    }
    // Returns the same grid from voxel `first` on, `extent` voxels large.
    VolumeFrame cropped(const glm::ivec3& first, const glm::ivec3& extent) const {
        VolumeFrame part = *this;
        part.origin = worldFromVoxel(glm::dvec3(first));
        part.size = extent;
        return part;
    }
};

template <typename T>
struct Volume {
    VolumeFrame frame;
    LazyArray<T> values;  // frame.count() of them

    Volume() = default;
    explicit Volume(const VolumeFrame& f) : frame(f), values(f.count()) {}
    bool empty() const { return values.empty(); }
    T at(int i, int j, int k) const { return values[frame.index(i, j, k)]; }
    T& at(int i, int j, int k) { return values[frame.index(i, j, k)]; }
    T at(const glm::ivec3& v) const { return values[frame.index(v)]; }
    T& at(const glm::ivec3& v) { return values[frame.index(v)]; }
    // Returns the same voxels in the same memory (LazyArray::share).
    Volume share() const {
        Volume same;
        same.frame = frame;
        same.values = values.share();
        return same;
    }
};

// Grey values. For CT: Hounsfield units. Data of other kinds keep their numbers where these fit into 16
// bits, else value = stored * scale + offset.
struct GreyVolume : Volume<std::int16_t> {
    using Volume::Volume;
    double scale = 1, offset = 0;

    GreyVolume share() const {
        GreyVolume same;
        static_cast<Volume&>(same) = Volume::share();
        same.scale = scale;
        same.offset = offset;
        return same;
    }
};

using MaskVolume = Volume<std::uint8_t>;  // 0 outside, 1 inside

}  // namespace stereonav
