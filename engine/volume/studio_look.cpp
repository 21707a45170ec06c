#include "engine/volume/studio_look.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

constexpr double kMost = 1023;

std::uint32_t channel(double share, int place) {
    return static_cast<std::uint32_t>(std::lround(kMost * std::clamp(share, 0.0, 1.0))) << 10 * place;
}
double channelOf(std::uint32_t word, int place) {
    return (word >> 10 * place & 1023) / kMost;
}

struct Cell {
    glm::dvec3 towards{0.0};  // -1..1
    glm::dvec2 shares{0.0};   // sky, key
};
Cell unpacked(const std::uint32_t* words) {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell.towards[k] = 2 * channelOf(words[0], k) - 1;
    cell.shares = {channelOf(words[1], 0), channelOf(words[1], 1)};
    return cell;
}

}  // namespace

void packSky(const glm::dvec3& towards, double share, double key, std::uint32_t* words) {
    words[0] = words[1] = 0;
    for (int k = 0; k < 3; ++k) words[0] |= channel(0.5 + 2 * towards[k], k);
    words[1] = channel(share, 0) | channel(key, 1);
}

glm::dmat3 skyNormals(const SkyGrid& grid, const VolumeFrame& frame) {
    const glm::dvec3 edges = grid.cellVoxels * frame.spacing;
    const double largest = std::max({edges.x, edges.y, edges.z});
    glm::dmat3 along = glm::transpose(frame.axes);
    for (int column = 0; column < 3; ++column) along[column] *= edges / largest;
    return along;
}

SkySeen skySeenAt(const SkyGrid& grid, const VolumeFrame& frame, const glm::dvec3& voxel,
                  const glm::dvec3& normal) {
    const glm::dvec3 face = skyNormals(grid, frame) * normal;
    const double length = glm::length(face);
    const glm::dvec3 lifted = length > 0 ? face * (kSkyLift / length) : glm::dvec3(0.0);
    const glm::dvec3 at = glm::clamp((voxel - grid.first) / grid.cellVoxels + lifted, glm::dvec3(0.0),
                                     glm::dvec3(grid.size - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(at), grid.size - 2);
    const glm::dvec3 in = at - glm::dvec3(low);
    Cell mean;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 o(n & 1, n >> 1 & 1, n >> 2);
        const glm::ivec3 c = low + o;
        const double weight = (o.x ? in.x : 1 - in.x) * (o.y ? in.y : 1 - in.y) * (o.z ? in.z : 1 - in.z);
        const std::size_t index = (static_cast<std::size_t>(c.z) * grid.size.y + c.y) * grid.size.x + c.x;
        const Cell cell = unpacked(grid.words.data() + 2 * index);
        mean.towards += weight * cell.towards;
        mean.shares += weight * cell.shares;
    }
    return {std::clamp(mean.shares.x + 0.5 * glm::dot(mean.towards, normal), 0.0, 1.0), mean.shares.y};
}

double studioLampShare(const StudioLook& look, const SkySeen& seen) {
    const auto deep = static_cast<double>(look.lampDeep);
    return static_cast<double>(look.lamp) * (deep + (1 - deep) * seen.sky);
}

glm::dvec3 studioLight(const StudioLook& look, const SkySeen& seen, const glm::dvec3& normal, double lamp) {
    const double up = 0.5 + 0.5 * glm::dot(normal, look.up);
    const double key = std::max(glm::dot(normal, look.keyFrom), 0.0) * seen.key;
    const glm::dvec3 sky = glm::mix(glm::dvec3(look.ground), glm::dvec3(look.sky), up);
    return seen.sky * sky + key * glm::dvec3(look.key) + lamp * studioLampShare(look, seen);
}

}  // namespace stereonav
