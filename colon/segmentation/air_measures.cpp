#include "colon/segmentation/air_measures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "colon/segmentation/segmentation_air.h"

namespace stereonav {
namespace {

constexpr double kLeastTissue = -300, kMostTissue = 2000;  // HU
constexpr std::size_t kTissueSamples = 64, kDensitySamples = 4096;
constexpr std::size_t kFewestDeep = 8, kFewestInner = 3;  // voxels that a density is taken from

struct PlacedRun {
    VoxelRun run;
    int j = 0, k = 0;

    glm::ivec3 middle() const { return {(run.first + run.end) / 2, j, k}; }
};

template <typename Use>
void forRuns(const Pieces& pieces, int piece, const Use& use) {
    const Component& part = pieces.parts.list[static_cast<std::size_t>(piece)];
    for (int k = part.first.z; k <= part.last.z; ++k)
        for (int j = part.first.y; j <= part.last.y; ++j) {
            const std::size_t row = pieces.runs.rowNumber(j, k);
            for (std::uint32_t n = pieces.runs.rowStart[row]; n < pieces.runs.rowStart[row + 1]; ++n)
                if (pieces.parts.ofRun[n] == static_cast<std::uint32_t>(piece))
                    use(PlacedRun{pieces.runs.runs[n], j, k});
        }
}

// Runs of one piece, at most `most`, evenly picked.
std::vector<PlacedRun> sampledRuns(const Pieces& pieces, int piece, std::size_t most) {
    std::vector<PlacedRun> all;
    forRuns(pieces, piece, [&](const PlacedRun& run) { all.push_back(run); });
    if (all.size() <= most) return all;
    std::vector<PlacedRun> some;
    for (std::size_t n = 0; n < most; ++n) some.push_back(all[n * all.size() / most]);
    return some;
}

// Metres of tissue from a voxel to the volume's face.
double tissueAlong(const GreyVolume& study, glm::ivec3 voxel, int axis, int step) {
    int count = 0;
    for (; study.frame.contains(voxel); voxel[axis] += step) {
        const double hu = huAt(study, voxel);
        count += hu > kLeastTissue && hu < kMostTissue;
    }
    return count * study.frame.spacing[axis];
}

// values is not empty.
double quantile(std::vector<double>& values, double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

double AirMeasures::Tissue::least() const {
    return std::min({right, left, front, back});
}

double AirMeasures::Tissue::fromSide() const {
    const double both = right + left;
    return both > 0 ? std::min(right, left) / both : 0;
}

double AirMeasures::volume(int piece) const {
    const glm::dvec3& s = mStudy.frame.spacing;
    return static_cast<double>(part(piece).voxels) * s.x * s.y * s.z;
}

bool AirMeasures::touchesSides(int piece) const {
    const int upright = voxelAxisOf(mStudy.frame, 2);
    for (int a = 0; a < 3; ++a)
        if (a != upright && (part(piece).first[a] == 0 || part(piece).last[a] == mStudy.frame.size[a] - 1))
            return true;
    return false;
}

bool AirMeasures::touchesFirst(int piece) const {
    return part(piece).first[voxelAxisOf(mStudy.frame, 2)] == 0;
}

bool AirMeasures::touchesLast(int piece) const {
    const int upright = voxelAxisOf(mStudy.frame, 2);
    return part(piece).last[upright] == mStudy.frame.size[upright] - 1;
}

AirMeasures::Tissue AirMeasures::tissueAround(int piece) const {
    const std::vector<PlacedRun> runs = sampledRuns(mAir, piece, kTissueSamples);
    const int upright = voxelAxisOf(mStudy.frame, 2);
    const int one = (upright + 1) % 3, other = (upright + 2) % 3;
    const auto& axes = mStudy.frame.axes;
    const int lateral = std::abs(axes[one].x) >= std::abs(axes[other].x) ? one : other;
    const int deep = 3 - upright - lateral;  // from front to back
    const auto along = [&](int axis, bool growing) {
        std::vector<double> lengths;
        lengths.reserve(runs.size());
        for (const PlacedRun& run : runs)
            lengths.push_back(tissueAlong(mStudy, run.middle(), axis, growing ? 1 : -1));
        return quantile(lengths, 0.5);
    };
    const bool leftGrows = axes[lateral].x >= 0, backGrows = axes[deep].y >= 0;
    return {along(lateral, !leftGrows), along(lateral, leftGrows), along(deep, !backGrows),
            along(deep, backGrows)};
}

bool AirMeasures::holds(int piece, const glm::ivec3& voxel) const {
    return !mStudy.frame.contains(voxel) || mAir.parts.at(mAir.runs, voxel) == piece;
}

// Returns whether all voxels as far as `depth` along each axis are the piece's, where the scan reaches them.
bool AirMeasures::within(int piece, const glm::ivec3& voxel, int depth) const {
    for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-depth, depth}) {
            glm::ivec3 to = voxel;
            to[axis] += step;
            if (!holds(piece, to)) return false;
        }
    return true;
}

std::optional<AirMeasures::Density> AirMeasures::density(int piece) const {
    std::vector<double> inner, deep;
    for (const PlacedRun& run : sampledRuns(mAir, piece, kDensitySamples)) {
        const glm::ivec3 voxel = run.middle();
        if (!within(piece, voxel, 1)) continue;
        inner.push_back(huAt(mStudy, voxel));
        if (within(piece, voxel, 2)) deep.push_back(inner.back());
    }
    std::vector<double>& values = deep.size() >= kFewestDeep ? deep : inner;
    if (values.size() < kFewestInner) return std::nullopt;
    return Density{quantile(values, 0.5), quantile(values, 0.9)};
}

AirMeasures::Tube AirMeasures::tube(int piece) const {
    const PieceWay way = wayThrough(mAir, piece, mStudy.frame);
    if (!(way.length > 0)) return {};
    const double diameter = 2 * std::sqrt(volume(piece) / (std::numbers::pi * way.length));
    return {diameter, way.length / diameter};
}

glm::dvec3 AirMeasures::middle(int piece) const {
    return mStudy.frame.worldFromVoxel(glm::dvec3(part(piece).first + part(piece).last) * 0.5);
}

glm::dvec3 AirMeasures::placeIn(int piece) const {
    const glm::dvec3 middle = glm::dvec3(part(piece).first + part(piece).last) * 0.5;
    glm::ivec3 best(0);
    double least = std::numeric_limits<double>::infinity();
    forRuns(mAir, piece, [&](const PlacedRun& run) {
        const double away = glm::length((glm::dvec3(run.middle()) - middle) * mStudy.frame.spacing);
        if (away < least) {
            least = away;
            best = run.middle();
        }
    });
    return mStudy.frame.worldFromVoxel(glm::dvec3(best));
}

}  // namespace stereonav
