// Slices that are uneven, missing or tilted, onto an even upright grid. In-plane samples keep their spacing;
// a tilted stack is sheared back along its planes, as CT workstations do it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "colon/study/study_parts.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Shares of a voxel below this count as none, so that rounding neither blurs nor makes holes at the edges.
constexpr double kNothing = 1e-4;

struct Axis {
    int first;      // sample before the place
    double weight;  // weight of the sample behind it
};
// Returns false where `place` (in samples) lies outside of [0, count - 1].
bool locate(double place, int count, Axis& axis) {
    if (!(place > -kNothing && place < count - 1 + kNothing)) return false;
    axis.first = std::clamp(static_cast<int>(std::floor(place + kNothing)), 0, count - 1);
    axis.weight = std::max(0.0, place - axis.first);
    if (axis.weight < kNothing || axis.first == count - 1) axis.weight = 0;
    return true;
}

template <typename T>
struct Slice {
    const T* samples;
    glm::ivec2 size;
    glm::dvec2 offset;  // voxels from the grid's first corner to the slice's

    double at(int i, int j, double fill) const {
        Axis x, y;
        if (!locate(i - offset.x, size.x, x) || !locate(j - offset.y, size.y, y)) return fill;
        const T* row = samples + static_cast<std::size_t>(y.first) * size.x + x.first;
        const T* next = y.weight > 0 ? row + size.x : row;
        const int right = x.weight > 0 ? 1 : 0;
        const double above = row[0] + x.weight * (static_cast<double>(row[right]) - row[0]);
        const double below = next[0] + x.weight * (static_cast<double>(next[right]) - next[0]);
        return above + y.weight * (below - above);
    }
};

template <typename T>
T nearest(double value) {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value);
    return static_cast<T>(std::llround(value));
}

template <typename T>
double leastOf(const T* samples, std::size_t count) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < count; ++n)
        if (samples[n] < least) least = static_cast<double>(samples[n]);
    return std::isfinite(least) ? least : 0;
}

// The grid that covers every slice, and where its corner lies along the axes.
VolumeFrame coveringFrame(const SlicePlaces& places, glm::dvec3& corner) {
    glm::dvec3 low(0.0), high(0.0);
    for (const glm::dvec3& p : places.offsets) low = glm::min(low, p), high = glm::max(high, p);
    VolumeFrame frame = places.frame;
    corner = {low.x, low.y, 0.0};
    frame.origin += frame.axes * corner;
    const glm::dvec3 extent = (high - corner) / frame.spacing;
    frame.size.x += static_cast<int>(std::ceil(extent.x - kNothing));
    frame.size.y += static_cast<int>(std::ceil(extent.y - kNothing));
    frame.size.z = static_cast<int>(std::floor(extent.z + 0.01)) + 1;
    return frame;
}

template <typename T>
void resampleInto(const T* samples, const glm::ivec3& size, const SlicePlaces& places,
                  const glm::dvec3& corner, RawStudy& out) {
    const std::size_t perSlice = static_cast<std::size_t>(size.x) * size.y;
    const double fill = leastOf(samples, perSlice * size.z);
    auto* values = reinterpret_cast<T*>(out.bytes.data());
    const VolumeFrame& frame = out.frame;
    const auto slice = [&](int k) {
        const glm::dvec3 voxels = (places.offsets[k] - corner) / frame.spacing;
        return Slice<T>{samples + perSlice * k, {size.x, size.y}, {voxels.x, voxels.y}};
    };
    parallelFor(frame.size.z, [&](int m) {
        const double z = m * frame.spacing.z;
        int k = 0;
        while (k + 2 < size.z && places.offsets[k + 1].z <= z) ++k;
        const double gap = places.offsets[k + 1].z - places.offsets[k].z;
        double weight = std::clamp((z - places.offsets[k].z) / gap, 0.0, 1.0);
        if (weight < kNothing) weight = 0;
        if (weight > 1 - kNothing) weight = 1;
        const Slice<T> before = slice(k), behind = slice(k + 1);
        T* target = values + frame.index(0, 0, m);
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const double a = weight < 1 ? before.at(i, j, fill) : 0;
                const double b = weight > 0 ? behind.at(i, j, fill) : 0;
                *target++ = nearest<T>(a * (1 - weight) + b * weight);
            }
    });
}

}  // namespace

RawStudy resampleSlices(const RawStudy& raw, const SlicePlaces& places, const std::string& file) {
    RawStudy out;
    glm::dvec3 corner;
    out.type = raw.type;
    out.slope = raw.slope;
    out.intercept = raw.intercept;
    out.frame = coveringFrame(places, corner);
    const auto extent = [&](int axis) { return static_cast<std::uint64_t>(out.frame.size[axis]); };
    const double voxels =
        static_cast<double>(extent(0)) * static_cast<double>(extent(1)) * static_cast<double>(extent(2));
    checkSize(file, {extent(0), extent(1), extent(2)}, voxels * (2 * bytesOf(raw.type) + 2));
    out.bytes = LazyArray<unsigned char>(out.frame.count() * bytesOf(raw.type));
    withSamples(raw,
                [&](const auto* samples) { resampleInto(samples, raw.frame.size, places, corner, out); });
    return out;
}

}  // namespace stereonav
