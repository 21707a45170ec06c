// Air is taken in components; each is judged by what it touches, how far it lies under tissue, how dense it
// is and how long it is for its width.
#include "colon/segmentation/segmentation_air.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kSmallPiece = 2e-6;     // cubic metres: less is bowel gas, unless fluid ties it to the colon
constexpr double kLargePiece = 100e-6;   // lungs are larger
constexpr double kLungDensity = -930;    // HU: the median of lungs lies above, that of gas below
constexpr double kTissueAround = 0.006;  // metres of tissue on all sides of what lies in a body
constexpr double kTubeLength = 2.5;      // diameters
constexpr double kUpper = 0.6;           // share of the height: round pieces above are a stomach's
constexpr std::size_t kSamples = 64;

// Runs of one piece, at most `most`, evenly picked.
struct PlacedRun {
    VoxelRun run;
    int j = 0, k = 0;
};
std::vector<PlacedRun> sampledRuns(const Pieces& pieces, int piece, std::size_t most) {
    std::vector<PlacedRun> all;
    const Component& part = pieces.parts.list[static_cast<std::size_t>(piece)];
    for (int k = part.first.z; k <= part.last.z; ++k)
        for (int j = part.first.y; j <= part.last.y; ++j) {
            const std::size_t row = pieces.runs.rowNumber(j, k);
            for (std::uint32_t n = pieces.runs.rowStart[row]; n < pieces.runs.rowStart[row + 1]; ++n)
                if (pieces.parts.ofRun[n] == static_cast<std::uint32_t>(piece))
                    all.push_back({pieces.runs.runs[n], j, k});
        }
    if (all.size() <= most) return all;
    std::vector<PlacedRun> some;
    for (std::size_t n = 0; n < most; ++n) some.push_back(all[n * all.size() / most]);
    return some;
}

glm::ivec3 middleOf(const PlacedRun& r) {
    return {(r.run.first + r.run.end) / 2, r.j, r.k};
}

// Metres of tissue from a voxel to the volume's face.
double tissueAlong(const GreyVolume& study, glm::ivec3 voxel, int axis, int step) {
    int count = 0;
    for (; study.frame.contains(voxel); voxel[axis] += step) {
        const double hu = huAt(study, voxel);
        count += hu > -300 && hu < 2000;
    }
    return count * study.frame.spacing[axis];
}

class AirJudge {
public:
    AirJudge(const GreyVolume& study, AirPieces& air) : mStudy(study), mAir(air) {}

    AirKind kindOf(int piece) const {
        const Component& part = mAir.pieces.parts.list[static_cast<std::size_t>(piece)];
        const double volume = volumeOf(part);
        if (touchesSides(part)) return AirKind::Outside;
        if (volume < 0.02e-6) return AirKind::Small;
        const auto runs = sampledRuns(mAir.pieces, piece, kSamples);
        if (tissueAround(runs) < kTissueAround) return AirKind::Outside;
        if (volume > kLargePiece && medianOf(piece) > kLungDensity) return AirKind::Lung;
        return volume < kSmallPiece ? AirKind::Small : AirKind::Colon;
    }

    double volumeOf(const Component& part) const {
        const glm::dvec3& s = mStudy.frame.spacing;
        return static_cast<double>(part.voxels) * s.x * s.y * s.z;
    }

    // Length over diameter.
    double slenderness(int piece) const {
        const PieceWay way = wayThrough(mAir.pieces, piece, mStudy.frame);
        const double volume = volumeOf(mAir.pieces.parts.list[static_cast<std::size_t>(piece)]);
        if (!(way.length > 0)) return 0;
        return way.length / (2 * std::sqrt(volume / (std::numbers::pi * way.length)));
    }

private:
    bool touchesSides(const Component& part) const {
        const int upright = voxelAxisOf(mStudy.frame, 2);
        for (int a = 0; a < 3; ++a)
            if (a != upright && (part.first[a] == 0 || part.last[a] == mStudy.frame.size[a] - 1)) return true;
        return false;
    }

    // The least over four directions, of the samples' medians.
    double tissueAround(const std::vector<PlacedRun>& runs) const {
        const int upright = voxelAxisOf(mStudy.frame, 2);
        double least = 1e9;
        for (int axis = 0; axis < 3; ++axis)
            for (int step = -1; axis != upright && step <= 1; step += 2) {
                std::vector<double> lengths;
                for (const PlacedRun& r : runs)
                    lengths.push_back(tissueAlong(mStudy, middleOf(r), axis, step));
                std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
                least = std::min(least, lengths[lengths.size() / 2]);
            }
        return least;
    }

    // Of voxels away from the border, which is partly tissue.
    double medianOf(int piece) const {
        std::vector<double> values;
        for (const PlacedRun& r : sampledRuns(mAir.pieces, piece, 4096))
            if (r.run.end - r.run.first > 8) values.push_back(huAt(mStudy, middleOf(r)));
        if (values.empty()) return -1000;
        std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
        return values[values.size() / 2];
    }

    const GreyVolume& mStudy;
    AirPieces& mAir;
};

double worldHeight(const Component& part, const VolumeFrame& frame) {
    return frame.worldFromVoxel(glm::dvec3(part.first + part.last) * 0.5).z;
}

// Round pieces high up are the stomach's.
void dropRoundPieces(const GreyVolume& study, const AirJudge& judge, AirPieces& air) {
    double low = 1e9, high = -1e9;
    const auto& list = air.pieces.parts.list;
    for (std::size_t n = 0; n < list.size(); ++n)
        if (air.kinds[n] == AirKind::Colon)
            for (const glm::ivec3& corner : {list[n].first, list[n].last}) {
                const double z = study.frame.worldFromVoxel(glm::dvec3(corner)).z;
                low = std::min(low, z);
                high = std::max(high, z);
            }
    for (std::size_t n = 0; n < list.size(); ++n) {
        if (air.kinds[n] != AirKind::Colon) continue;
        if (worldHeight(list[n], study.frame) < low + kUpper * (high - low)) continue;
        if (judge.slenderness(static_cast<int>(n)) >= kTubeLength) continue;
        air.kinds[n] = AirKind::Other;
        const glm::dvec3 at = study.frame.worldFromVoxel(glm::dvec3(list[n].first + list[n].last) * 0.5);
        air.notes.push_back(fmt::format(
            "left out {:.1f} ml of gas around {:.0f},{:.0f},{:.0f} mm: round and high up, like a stomach",
            judge.volumeOf(list[n]) * 1e6, 1e3 * at.x, 1e3 * at.y, 1e3 * at.z));
    }
}

void noteCutPieces(const GreyVolume& study, AirPieces& air) {
    const int upright = voxelAxisOf(study.frame, 2);
    for (std::size_t n = 0; n < air.kinds.size(); ++n) {
        const Component& part = air.pieces.parts.list[n];
        if (air.kinds[n] != AirKind::Colon) continue;
        if (part.first[upright] == 0 || part.last[upright] == study.frame.size[upright] - 1)
            air.notes.push_back("a piece of the colon is cut off at the scan's first or last slice");
    }
}

std::string counted(std::ptrdiff_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::string leftOut(const AirPieces& air) {
    constexpr struct {
        AirKind kind;
        const char *one, *many;
    } kNames[] = {{AirKind::Outside, "piece outside a body", "pieces outside a body"},
                  {AirKind::Lung, "piece of lung", "pieces of lung"},
                  {AirKind::Other, "round piece high up", "round pieces high up"},
                  {AirKind::Small, "small piece", "small pieces"}};
    std::string text;
    for (const auto& name : kNames)
        if (const auto count = std::count(air.kinds.begin(), air.kinds.end(), name.kind))
            text += (text.empty() ? "" : ", ") + counted(count, name.one, name.many);
    return text;
}

double huAt(const GreyVolume& study, const glm::ivec3& voxel) {
    return study.at(voxel) * study.scale + study.offset;
}

double storedOf(const GreyVolume& study, double hu) {
    return (hu - study.offset) / study.scale;
}

int voxelAxisOf(const VolumeFrame& frame, int worldAxis) {
    int best = 0;
    for (int a = 1; a < 3; ++a)
        if (std::abs(frame.axes[a][worldAxis]) > std::abs(frame.axes[best][worldAxis])) best = a;
    return best;
}

AirPieces findAir(const GreyVolume& study, const SegmentationSetting& setting, std::optional<VoxelRuns> known,
                  Progress& progress) {
    progress.report(0, "looking for air");
    AirPieces air;
    air.pieces.runs = known ? std::move(*known) : runsBelow(study, storedOf(study, setting.air));
    const std::size_t voxels = air.pieces.runs.voxelCount();
    if (voxels == 0)
        throw Error("", "study", fmt::format("no air: no voxel lies below {:g} HU", setting.air),
                    "give a CT in Hounsfield units");
    if (voxels == study.frame.count())
        throw Error("", "study", fmt::format("nothing but air: all voxels lie below {:g} HU", setting.air),
                    "give a CT in Hounsfield units");
    progress.report(0.5, "telling pieces of air apart");
    air.pieces.parts = connectedComponents(air.pieces.runs);
    const AirJudge judge(study, air);
    for (std::size_t n = 0; n < air.pieces.parts.list.size(); ++n)
        air.kinds.push_back(judge.kindOf(static_cast<int>(n)));
    if (setting.seeds.empty()) {
        dropRoundPieces(study, judge, air);
        noteCutPieces(study, air);
    }
    progress.report(1, "telling pieces of air apart");
    return air;
}

}  // namespace stereonav
