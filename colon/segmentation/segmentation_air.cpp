// Air is taken in components; each is judged by what it touches, how far it lies under tissue, how dense it
// is, how wide it is and how long for its width, and where in the body it lies.
#include "colon/segmentation/segmentation_air.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "colon/segmentation/air_measures.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kSpeck = 0.02e-6;       // cubic metres: not worth a look
constexpr double kSmallPiece = 2e-6;     // cubic metres: less is bowel gas, unless fluid ties it to the colon
constexpr double kTissueAround = 0.006;  // metres of tissue on all sides of what lies in a body
// HU. The medians of lungs lie above kLungMedian, those of gas below, and vessels lift a tenth of a lung's
// voxels above kLungVessels. Emphysema is told from the scan's cleanest gas, which it is denser than by so
// much: by its median, and by its densest tenth, as noise alone lifts that of both.
constexpr double kLungMedian = -930, kLungVessels = -860, kDenser = 40, kDenserHigh = 55;
// A stomach's gas is in the upper part, left of the middle or in it, away from the flanks where the colon's
// flexures lie, and round; where it lies in front it may be longer.
constexpr double kUpper = 0.6, kFlank = 0.2, kFront = 0.4, kRightOfMiddle = 1.3;
constexpr double kRound = 2.5, kLongStomach = 8, kStomachShare = 0.25;  // diameters; share of the largest
// Pieces that may as well be a stomach's, a duodenum's or small bowel's.
constexpr double kAlone = 5e-6, kAloneShare = 0.1;  // cubic metres; share of the largest
constexpr double kNarrow = 0.022, kMiddle = 0.25, kNarrowVolume = 30e-6;  // metres, share, cubic metres
constexpr double kPelvis = 0.3;  // share of the gas's height: below, what is narrow may be a sigmoid

class AirJudge {
public:
    AirJudge(const GreyVolume& study, AirPieces& air)
        : mStudy(study), mAir(air), mMeasures(study, air.pieces) {}

    // Judges each piece by itself.
    void judgeEach() {
        const std::size_t count = mAir.pieces.parts.list.size();
        mAir.kinds.resize(count);
        mAir.reasons.resize(count);
        mDensities.resize(count);
        for (std::size_t n = 0; n < count; ++n) mAir.kinds[n] = kindOf(static_cast<int>(n));
    }

    // Judges pieces by the others.
    void compare() {
        leaveDense();
        measureColon();
        for (std::size_t n = 0; n < mAir.kinds.size(); ++n)
            if (mAir.kinds[n] == AirKind::Colon) compareOne(static_cast<int>(n));
    }

private:
    AirKind kindOf(int piece) {
        if (mMeasures.touchesSides(piece)) return AirKind::Outside;
        const double volume = mMeasures.volume(piece);
        if (volume < kSpeck) return AirKind::Small;
        if (mMeasures.tissueAround(piece).least() < kTissueAround) return AirKind::Outside;
        if (volume < kSmallPiece) return AirKind::Small;
        auto& density = mDensities[static_cast<std::size_t>(piece)];
        density = mMeasures.density(piece);
        return density && (density->median > kLungMedian || density->high > kLungVessels) ? lung(piece)
                                                                                          : AirKind::Colon;
    }

    AirKind lung(int piece) {
        reason(piece) = {fmt::format("denser than gas, like a lung (median {:.0f} HU)",
                                     mDensities[static_cast<std::size_t>(piece)]->median)};
        return AirKind::Lung;
    }

    void leaveDense() {
        std::optional<AirMeasures::Density> clean;
        for (std::size_t n = 0; n < mAir.kinds.size(); ++n)
            if (mAir.kinds[n] == AirKind::Colon && mDensities[n] &&
                (!clean || mDensities[n]->median < clean->median))
                clean = mDensities[n];
        if (!clean) return;
        for (std::size_t n = 0; n < mAir.kinds.size(); ++n)
            if (mAir.kinds[n] == AirKind::Colon && mDensities[n] &&
                mDensities[n]->median > clean->median + kDenser &&
                mDensities[n]->high > clean->high + kDenserHigh)
                mAir.kinds[n] = lung(static_cast<int>(n));
    }

    void measureColon() {
        for (std::size_t n = 0; n < mAir.kinds.size(); ++n) {
            if (mAir.kinds[n] != AirKind::Colon) continue;
            const Component& part = mAir.pieces.parts.list[n];
            mLargest = std::max(mLargest, mMeasures.volume(static_cast<int>(n)));
            for (const glm::ivec3& corner : {part.first, part.last}) {
                const double z = mStudy.frame.worldFromVoxel(glm::dvec3(corner)).z;
                mLow = std::min(mLow, z);
                mHigh = std::max(mHigh, z);
            }
        }
    }

    void compareOne(int piece) {
        const double volume = mMeasures.volume(piece);
        const AirMeasures::Tissue tissue = mMeasures.tissueAround(piece);
        const double fromSide = tissue.fromSide();
        const double height = (mMeasures.middle(piece).z - mLow) / std::max(mHigh - mLow, 1e-9);
        const AirMeasures::Tube tube = mMeasures.tube(piece);
        if (height >= kUpper && fromSide > kFlank && tissue.left < kRightOfMiddle * tissue.right) {
            if (tube.slenderness < kRound) return leave(piece, "round and high up, like a stomach");
            if (tissue.front < kFront * (tissue.front + tissue.back) && tube.slenderness < kLongStomach &&
                volume < kStomachShare * mLargest)
                return leave(piece, "high up in front, like a stomach");
        }
        if (volume < kAlone && volume < kAloneShare * mLargest) return leave(piece, "small and by itself");
        if (volume < kNarrowVolume && volume < mLargest && tube.diameter < kNarrow && fromSide > kMiddle) {
            if (height >= kPelvis) return leave(piece, "narrow and in the middle, like small bowel");
            reason(piece) = {"narrow, like small bowel, but low, like a sigmoid", false};
        }
    }

    void leave(int piece, const char* why) {
        mAir.kinds[static_cast<std::size_t>(piece)] = AirKind::Other;
        reason(piece) = {why, false};
    }

    AirReason& reason(int piece) { return mAir.reasons[static_cast<std::size_t>(piece)]; }

    const GreyVolume& mStudy;
    AirPieces& mAir;
    AirMeasures mMeasures;
    std::vector<std::optional<AirMeasures::Density>> mDensities;  // by piece: those that were asked for
    double mLargest = 0, mLow = 1e9, mHigh = -1e9;                // candidates: largest volume, range of z
};

std::string counted(std::ptrdiff_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

// The piece at a place that was given, -1 where tagged fluid lies there.
int pieceAt(const GreyVolume& study, const SegmentationSetting& setting, const AirPieces& air,
            const char* option, const glm::dvec3& place) {
    const glm::ivec3 voxel = givenVoxel(study.frame, option, place);
    const int piece = air.pieces.parts.at(air.pieces.runs, voxel);
    const double hu = huAt(study, voxel);
    if (piece < 0 && hu <= setting.tagged)
        throw Error(
            givenName(option, place), "",
            fmt::format("lies in tissue: {:.0f} HU, neither air (below {:g}) nor tagged fluid (above {:g})",
                        hu, setting.air, setting.tagged),
            "give a place inside the lumen");
    return piece;
}

}  // namespace

std::string leftOut(const AirPieces& air) {
    constexpr struct {
        AirKind kind;
        const char *one, *many;
    } kNames[] = {{AirKind::Outside, "piece outside a body", "pieces outside a body"},
                  {AirKind::Lung, "piece of lung", "pieces of lung"},
                  {AirKind::Other, "piece of other gas", "pieces of other gas"},
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
    AirJudge judge(study, air);
    judge.judgeEach();
    if (setting.seeds.empty()) judge.compare();
    progress.report(1, "telling pieces of air apart");
    return air;
}

void takeGiven(const GreyVolume& study, const SegmentationSetting& setting, AirPieces& air) {
    const auto set = [&](const std::vector<glm::dvec3>& places, const char* option, AirKind kind) {
        for (const glm::dvec3& place : places) {
            const int piece = pieceAt(study, setting, air, option, place);
            if (piece < 0) continue;
            air.kinds[static_cast<std::size_t>(piece)] = kind;
            air.reasons[static_cast<std::size_t>(piece)] = {fmt::format("by {}", option)};
        }
    };
    if (!setting.seeds.empty())
        for (AirKind& kind : air.kinds)
            if (kind == AirKind::Colon) kind = AirKind::Other;
    set(setting.seeds, kSeedOption, AirKind::Colon);
    set(setting.choices.include, kIncludeOption, AirKind::Colon);
    set(setting.choices.exclude, kExcludeOption, AirKind::Other);
}

}  // namespace stereonav
