// From a ready mask to a lumen: its pieces are chosen and ordered, cut out with a margin, and smoothed.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "colon/segmentation/lumen_pieces.h"
#include "colon/segmentation/lumen_surface.h"
#include "colon/segmentation/mask_smoothing.h"
#include "colon/segmentation/segmentation.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kSmallestMaskPiece = 0.5e-6;  // cubic metres: less is a speck
constexpr std::size_t kMostSegments = 255;     // numbers of segments are bytes

double voxelVolume(const VolumeFrame& frame) {
    return frame.spacing.x * frame.spacing.y * frame.spacing.z;
}

Pieces piecesOf(const MaskVolume& mask) {
    Pieces pieces;
    pieces.runs = runsOf(mask);
    const std::size_t voxels = pieces.runs.voxelCount();
    if (voxels == 0) throw Error("", "mask", "expected voxels inside, found none", "choose another --label");
    if (voxels == mask.frame.count())
        throw Error("", "mask", "expected voxels outside, but all are inside", "choose another --label");
    pieces.parts = connectedComponents(pieces.runs);
    return pieces;
}

int givenPiece(const Pieces& pieces, const VolumeFrame& frame, const char* option, const glm::dvec3& place) {
    const int piece = pieces.parts.at(pieces.runs, givenVoxel(frame, option, place));
    if (piece < 0)
        throw Error(givenName(option, place), "", "lies outside the mask", "give a place inside the lumen");
    return piece;
}

void keepGiven(const Pieces& pieces, const VolumeFrame& frame, const char* option,
               const std::vector<glm::dvec3>& places, std::vector<int>& kept) {
    for (const glm::dvec3& place : places) {
        const int piece = givenPiece(pieces, frame, option, place);
        if (std::find(kept.begin(), kept.end(), piece) == kept.end()) kept.push_back(piece);
    }
}

void changeKept(const Pieces& pieces, const VolumeFrame& frame, const PieceChoices& choices,
                std::vector<int>& kept) {
    keepGiven(pieces, frame, kIncludeOption, choices.include, kept);
    for (const glm::dvec3& place : choices.exclude)
        std::erase(kept, givenPiece(pieces, frame, kExcludeOption, place));
    if (kept.empty())
        throw Error("", "", fmt::format("{} leaves nothing of the mask", kExcludeOption), "leave one out");
    std::sort(kept.begin(), kept.end());
}

// The largest piece, and all that are no specks.
std::vector<int> largePieces(const Pieces& pieces, const VolumeFrame& frame,
                             std::vector<std::string>& notes) {
    const auto& list = pieces.parts.list;
    std::vector<int> bySize(list.size());
    std::iota(bySize.begin(), bySize.end(), 0);
    std::stable_sort(bySize.begin(), bySize.end(), [&](int a, int b) {
        return list[static_cast<std::size_t>(a)].voxels > list[static_cast<std::size_t>(b)].voxels;
    });
    std::vector<int> kept;
    std::size_t dropped = 0, droppedVoxels = 0;
    for (const int piece : bySize) {
        const std::size_t voxels = list[static_cast<std::size_t>(piece)].voxels;
        const bool large = static_cast<double>(voxels) * voxelVolume(frame) >= kSmallestMaskPiece;
        if (kept.empty() || (large && kept.size() < kMostSegments)) {
            kept.push_back(piece);
        } else {
            ++dropped;
            droppedVoxels += voxels;
        }
    }
    if (dropped > 0)
        notes.push_back(fmt::format("left out {} piece(s) of the mask under {:g} ml, {} voxels in all",
                                    dropped, kSmallestMaskPiece * 1e6, droppedVoxels));
    std::sort(kept.begin(), kept.end());
    return kept;
}

// The kept pieces alone, in the frame of `crop`.
Pieces cutOut(const Pieces& pieces, const std::vector<int>& ordered, const LumenCrop& crop) {
    std::vector<std::uint8_t> chosen(pieces.parts.list.size(), 0);
    for (const int piece : ordered) chosen[static_cast<std::size_t>(piece)] = 1;
    Pieces cut;
    cut.runs = collectRuns(crop.frame.size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        const glm::ivec3 at = glm::ivec3(0, j, k) + crop.first;
        if (at.y < 0 || at.z < 0 || at.y >= pieces.runs.size.y || at.z >= pieces.runs.size.z) return;
        const std::size_t row = pieces.runs.rowNumber(at.y, at.z);
        for (std::uint32_t n = pieces.runs.rowStart[row]; n < pieces.runs.rowStart[row + 1]; ++n)
            if (chosen[pieces.parts.ofRun[n]])
                runs.push_back({pieces.runs.runs[n].first - at.x, pieces.runs.runs[n].end - at.x});
    });
    cut.parts = connectedComponents(cut.runs);
    return cut;
}

}  // namespace

LumenField lumenFromMask(const MaskVolume& mask, const SegmentationSetting& setting, Progress& progress) {
    progress.report(0, "finding the lumen's pieces");
    const Pieces pieces = piecesOf(mask);
    LumenField lumen;
    std::vector<int> kept;
    if (setting.seeds.empty()) kept = largePieces(pieces, mask.frame, lumen.notes);
    keepGiven(pieces, mask.frame, kSeedOption, setting.seeds, kept);
    changeKept(pieces, mask.frame, setting.choices, kept);
    const LumenCrop crop = cropAround(pieces, kept, mask.frame);
    const Pieces cut = cutOut(pieces, kept, crop);
    std::vector<int> all(cut.parts.list.size());
    std::iota(all.begin(), all.end(), 0);
    checkLumenMemory(crop);
    lumen.field = GreyVolume(crop.frame);
    lumen.isovalue = kMaskWall;
    setSegments(cut, orderOf(cut, all, crop.frame), lumen);
    Progress smoothing(progress, 0.3, 1);
    const double length = smoothedLength(setting.maskSmoothing, crop.frame);
    if (length > 0)
        smoothWall(cut.runs, length, lumen.field, smoothing);
    else
        smoothMask(cut.runs, WideSmoothing{}, lumen.field, smoothing);
    progress.report(1, "found the lumen");
    return lumen;
}

}  // namespace stereonav
