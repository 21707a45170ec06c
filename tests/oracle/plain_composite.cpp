// See the header.
#include "tests/oracle/plain_composite.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/math/constants.h"
#include "engine/volume/baked_data.h"

namespace stereonav {
namespace {

constexpr double kLeastLeftOfRay = 1.0 / 1024;

// 0..1 for bytes 0..255.
double plainShare(const Volume<std::uint8_t>& bytes, const glm::dvec3& voxel) {
    const glm::dvec3 last(glm::max(bytes.frame.size - 2, 0));
    const glm::ivec3 cell(glm::clamp(glm::floor(voxel), glm::dvec3(0.0), last));
    const glm::dvec3 p = voxel - glm::dvec3(cell);
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 o(n & 1, n >> 1 & 1, n >> 2);
        const double weight = (o.x ? p.x : 1 - p.x) * (o.y ? p.y : 1 - p.y) * (o.z ? p.z : 1 - p.z);
        sum += weight * bytes.at(cell + o);
    }
    return sum / 255;
}

// The first and the last t of a ray within [0, size - 1]; the first is the larger where it misses the volume.
glm::dvec2 rangeWithin(const glm::ivec3& size, const glm::dvec3& origin, const glm::dvec3& direction,
                       double near) {
    glm::dvec2 range(near, glm::dot(direction, direction) == 0 ? -kInfinity : kInfinity);
    for (int axis = 0; axis < 3; ++axis) {
        const double last = size[axis] - 1;
        if (direction[axis] == 0) {
            if (!(origin[axis] >= 0 && origin[axis] <= last)) range.y = -kInfinity;
            continue;
        }
        const double a = -origin[axis] / direction[axis], b = (last - origin[axis]) / direction[axis];
        range = {std::max(range.x, std::min(a, b)), std::min(range.y, std::max(a, b))};
    }
    return range;
}

}  // namespace

glm::dvec3 shadeBakedPlain(const VolumeLook& look, const glm::dvec3& position, const glm::dvec3& normal,
                           const glm::dvec3& head, const glm::dvec3& eye, const glm::dvec3& albedo) {
    const IlluminationVolume::Light known = bakedLightAt(look.baked, position);
    const glm::dvec3 lamp = shadePlain(look, position, normal, head, eye, albedo);
    if (!(known.weight > 0)) return lamp;
    if (look.baked.use == BakedLook::Use::Openness) return lamp * static_cast<double>(known.value.x);
    const auto exposure = static_cast<double>(shownExposure(look.baked));
    return albedo * glm::dvec3(known.value) * exposure + static_cast<double>(look.baked.lampShare) * lamp;
}

glm::dvec3 lightPlain(const VolumeLook& look, const VolumeFrame& frame, const glm::dvec3& voxel,
                      const glm::dvec3& normal, const glm::dvec3& head, const glm::dvec3& eye,
                      const glm::dvec3& albedo) {
    const glm::dvec3 position = frame.worldFromVoxel(voxel);
    VolumeLook unlit = look;
    unlit.ambient = 0;
    if (look.showsStudio()) {
        const SkySeen seen = skySeenAt(*look.studio.seen, frame, voxel, normal);
        return albedo * studioLight(look.studio, seen, normal, 0) +
               studioLampShare(look.studio, seen) * shadePlain(unlit, position, normal, head, eye, albedo);
    }
    if (!look.showsOpenness()) return shadeBakedPlain(look, position, normal, head, eye, albedo);
    const double open = plainShare(*look.occlusion.openness, voxel);
    return look.occlusion.strength * open * albedo +
           static_cast<double>(look.occlusion.lampShare) *
               shadePlain(unlit, position, normal, head, eye, albedo);
}

PlainComposite compositePlain(const GreyVolume& volume, const VolumeLook& look, const PlainRay& worldRay,
                              const glm::dvec3& head, double stepVoxels) {
    PlainComposite result;
    const VolumeFrame& frame = volume.frame;
    if (frame.size.x < 2 || frame.size.y < 2 || frame.size.z < 2 || look.transfer.empty()) return result;
    const glm::dvec3 origin = frame.voxelFromWorld(worldRay.eye),
                     way = frame.voxelDirection(worldRay.direction);
    const glm::dvec2 range = rangeWithin(frame.size, origin, way, worldRay.nearDepth);
    if (!(range.x <= range.y)) return result;
    const double step = stepVoxels * std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    const double dt = step / glm::length(worldRay.direction);
    const auto tAt = [&](double k) { return worldRay.nearDepth + k * dt; };
    double square = 0;
    double k = std::ceil((range.x - worldRay.nearDepth) / dt);
    for (; result.left >= kLeastLeftOfRay && tAt(k) <= range.y; ++k) {
        const glm::dvec3 voxel =
            glm::clamp(origin + tAt(k) * way, glm::dvec3(0.0), glm::dvec3(frame.size - 1));
        const double value = plainValue(volume, voxel) * volume.scale + volume.offset;
        ++result.samples;
        double extinction = look.transfer.extinction(value);
        if (look.modulation) extinction *= plainShare(*look.modulation, voxel);
        const double opacity = -std::expm1(-extinction * step);
        if (!(opacity > 0)) continue;
        if (result.firstDepth == kInfinity) result.firstDepth = tAt(k);
        const glm::dvec3 albedo(look.transfer.at(value).color);
        result.color +=
            result.left * opacity *
            lightPlain(look, frame, voxel, plainNormal(volume, voxel), head, worldRay.eye, albedo);
        const double behind = tAt(k) - result.firstDepth;
        square += result.left * opacity * behind * behind;
        result.left *= 1 - opacity;
    }
    if (result.left < 1) result.spread = std::sqrt(square / (1 - result.left));
    return result;
}

namespace {

// Means over values, a metre.
struct PlainMeans {
    double extinction = 0;
    glm::dvec3 sent{0.0};  // the extinction times the colour
};

PlainMeans meansBetween(const TransferFunction& function, double from, double to) {
    constexpr int kParts = 24;
    std::vector<double> ends{std::min(from, to), std::max(from, to)};
    const double low = ends[0], high = ends[1];
    for (const TransferPoint& point : function.points())
        if (point.value > low && point.value < high) ends.push_back(point.value);
    std::sort(ends.begin(), ends.end());
    PlainMeans means;
    const auto add = [&](double value, double share) {
        const double extinction = share * function.extinction(value);
        means.extinction += extinction;
        means.sent += extinction * glm::dvec3(function.at(value).color);
    };
    if (!(high - low > 1e-9 * std::max(1.0, std::abs(high)))) {
        add(low, 1);
        return means;
    }
    for (std::size_t n = 0; n + 1 < ends.size(); ++n)
        for (int k = 0; k < kParts; ++k)
            add(ends[n] + (k + 0.5) / kParts * (ends[n + 1] - ends[n]),
                (ends[n + 1] - ends[n]) / (high - low) / kParts);
    return means;
}

// Returns the share of a piece before which all values are clear.
double clearShare(const TransferFunction& function, double from, double to) {
    const TransferFunction::Range seen = function.visibleRange();
    const double first = std::clamp(from, seen.lowest, seen.highest);
    return from == to ? 0 : std::clamp((first - from) / (to - from), 0.0, 1.0);
}

// Returns the places at which a ray passes from cell to cell, with both ends of its way, ascending.
std::vector<double> cellBorders(const glm::dvec3& origin, const glm::dvec3& way, const glm::dvec2& range) {
    std::vector<double> borders{range.x, range.y};
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0) continue;
        const double a = origin[axis] + range.x * way[axis], b = origin[axis] + range.y * way[axis];
        for (double k = std::ceil(std::min(a, b)); k <= std::max(a, b); ++k) {
            const double t = (k - origin[axis]) / way[axis];
            if (t > range.x && t < range.y) borders.push_back(t);
        }
    }
    std::sort(borders.begin(), borders.end());
    return borders;
}

}  // namespace

PlainComposite integratePlain(const GreyVolume& volume, const VolumeLook& look, const PlainRay& worldRay,
                              const glm::dvec3& head) {
    constexpr double kFaint = 0.3;
    PlainComposite result;
    const VolumeFrame& frame = volume.frame;
    if (frame.size.x < 2 || frame.size.y < 2 || frame.size.z < 2 || look.transfer.empty()) return result;
    const glm::dvec3 origin = frame.voxelFromWorld(worldRay.eye),
                     way = frame.voxelDirection(worldRay.direction);
    const glm::dvec2 range = rangeWithin(frame.size, origin, way, worldRay.nearDepth);
    if (!(range.x <= range.y)) return result;
    const auto voxelAt = [&](double t) {
        return glm::clamp(origin + t * way, glm::dvec3(0.0), glm::dvec3(frame.size - 1));
    };
    const auto valueAt = [&](double t) {
        return plainValue(volume, voxelAt(t)) * volume.scale + volume.offset;
    };
    double square = 0;
    const auto addPiece = [&](double begin, double end) {
        const double from = valueAt(begin), to = valueAt(end);
        const PlainMeans means = meansBetween(look.transfer, from, to);
        double depth = means.extinction * (end - begin) * glm::length(worldRay.direction);
        if (look.modulation) depth *= plainShare(*look.modulation, voxelAt(0.5 * (begin + end)));
        if (!(depth > 0)) return;
        const double share = -result.left * std::expm1(-depth);
        const double first = begin + clearShare(look.transfer, from, to) * (end - begin);
        const double middle = 0.5 * (first + end);
        const glm::dvec3 voxel = voxelAt(middle);
        result.color += share * lightPlain(look, frame, voxel, plainNormal(volume, voxel), head, worldRay.eye,
                                           means.sent / means.extinction);
        result.firstDepth = std::min(result.firstDepth, first);
        square += share * (middle - result.firstDepth) * (middle - result.firstDepth);
        result.left -= share;
        ++result.samples;
    };
    const std::vector<double> borders = cellBorders(origin, way, range);
    for (std::size_t n = 0; n + 1 < borders.size() && result.left >= kLeastLeftOfRay; ++n) {
        const double begin = borders[n], end = borders[n + 1], half = 0.5 * (begin + end);
        if (!(end > begin)) continue;
        if (result.left < kFaint) {
            addPiece(begin, end);
        } else {
            addPiece(begin, half);
            addPiece(half, end);
        }
    }
    if (result.left < 1) result.spread = std::sqrt(square / (1 - result.left));
    return result;
}

}  // namespace stereonav
