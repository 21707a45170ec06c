// From grey values to the lumen: air is judged, fluid is added and turned into air in a copy of the values
// around the colon, and every voxel under the wall's value goes to the air it is nearest to.
#include "colon/segmentation/segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "colon/segmentation/lumen_pieces.h"
#include "colon/segmentation/segmentation_air.h"
#include "colon/segmentation/segmentation_fluid.h"
#include "engine/base/error.h"
#include "engine/base/pages.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr std::int16_t kBodyTissue = 40;
constexpr int kGrowth = 8;                 // voxels that the lumen may reach beyond what was sure
constexpr double kSmallestPiece = 0.5e-6;  // cubic metres
constexpr std::uint8_t kColon = 1, kElse = 2;

const glm::ivec3 kNeighbours[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

void checkSetting(const SegmentationSetting& s) {
    if (!(s.air < s.wall && s.wall < kBodyTissue && s.tagged > kBodyTissue && std::isfinite(s.air) &&
          std::isfinite(s.tagged)))
        throw Error("", "thresholds",
                    fmt::format("expected air < wall < {} < tagged, got {:g}, {:g}, {:g}", kBodyTissue, s.air,
                                s.wall, s.tagged),
                    "give them in Hounsfield units");
}

LumenCrop cropOf(const GreyVolume& study, const AirPieces& air, const FluidPools& fluid) {
    glm::ivec3 first = study.frame.size, last(-1);
    const auto add = [&](const Component& part) {
        first = glm::min(first, part.first);
        last = glm::max(last, part.last);
    };
    for (std::size_t n = 0; n < air.kinds.size(); ++n)
        if (air.kinds[n] == AirKind::Colon) add(air.pieces.parts.list[n]);
    for (const Pool& pool : fluid.pools) add(fluid.cores.parts.list[pool.core]);
    if (last.x < 0)
        throw Error("", "", "found air but nothing like a colon in it: " + leftOut(air),
                    "give a place inside the lumen with --seed x,y,z");
    return cropAround(first, last, kLumenMargin + kGrowth, study.frame);
}

using SliceDone = std::function<void(int k)>;  // slice k of the study is not read any more

// Returns HU in the crop's frame; tissue beyond the study and on the outermost voxels, which closes the
// lumen.
GreyVolume cutField(const GreyVolume& study, const LumenCrop& crop, const SliceDone& done) {
    checkLumenMemory(crop);
    GreyVolume field(crop.frame);
    const glm::ivec3 size = crop.frame.size;
    const bool asStored = study.scale == 1 && study.offset == 0;
    const int first = std::max(1, -crop.first.x),
              end = std::min(size.x - 1, study.frame.size.x - crop.first.x);
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j) {
            std::int16_t* row = &field.at(0, j, k);
            std::fill_n(row, size.x, kBodyTissue);
            const glm::ivec3 at = glm::ivec3(first, j, k) + crop.first;
            const bool face = j == 0 || k == 0 || j == size.y - 1 || k == size.z - 1;
            if (face || first >= end || !study.frame.contains(at)) continue;
            const std::int16_t* from = &study.values[study.frame.index(at)];
            if (asStored)
                std::copy_n(from, end - first, row + first);
            else
                for (int i = 0; i < end - first; ++i)
                    row[first + i] = static_cast<std::int16_t>(
                        std::lround(std::clamp(from[i] * study.scale + study.offset, -32768.0, 32767.0)));
        }
        done(k + crop.first.z);
    });
    return field;
}

// Marks pieces of air in the crop: the colon's, and all others.
void markAir(const AirPieces& air, const LumenCrop& crop, MaskVolume& marks) {
    const glm::ivec3 size = crop.frame.size;
    const VoxelRuns& runs = air.pieces.runs;
    parallelFor(size.z - 2, [&](int slice) {
        const int k = slice + 1;
        for (int j = 1; j < size.y - 1; ++j) {
            const glm::ivec3 at = glm::ivec3(0, j, k) + crop.first;
            if (at.y < 0 || at.z < 0 || at.y >= runs.size.y || at.z >= runs.size.z) continue;
            const std::size_t row = runs.rowNumber(at.y, at.z);
            for (std::uint32_t n = runs.rowStart[row]; n < runs.rowStart[row + 1]; ++n) {
                const AirKind kind = air.kinds[air.pieces.parts.ofRun[n]];
                if (kind == AirKind::Small) continue;  // not worth a wall of its own
                const int first = std::max(1, runs.runs[n].first - at.x);
                const int end = std::min(size.x - 1, runs.runs[n].end - at.x);
                for (int i = first; i < end; ++i) marks.at(i, j, k) = kind == AirKind::Colon ? kColon : kElse;
            }
        }
    });
}

// Most of a slice was only read.
void releaseUnmarked(const MaskVolume& marks, int k) {
    releaseZeroPages(marks.values, marks.frame.index(0, 0, k), marks.frame.index(0, 0, 1));
}

// Returns the marked voxels that have an unmarked neighbour, in the order of the volume.
std::vector<glm::ivec3> markedBorder(const MaskVolume& marks) {
    const glm::ivec3 size = marks.frame.size;
    std::vector<std::vector<glm::ivec3>> slices(static_cast<std::size_t>(std::max(0, size.z - 2)));
    parallelFor(size.z - 2, [&](int slice) {
        for (int j = 1; j < size.y - 1; ++j)
            for (int i = 1; i < size.x - 1; ++i) {
                const glm::ivec3 voxel(i, j, slice + 1);
                if (!marks.at(voxel)) continue;
                for (const glm::ivec3& step : kNeighbours)
                    if (!marks.at(voxel + step)) {
                        slices[static_cast<std::size_t>(slice)].push_back(voxel);
                        break;
                    }
            }
        releaseUnmarked(marks, slice + 1);
    });
    std::vector<glm::ivec3> border;
    for (const std::vector<glm::ivec3>& slice : slices)
        border.insert(border.end(), slice.begin(), slice.end());
    return border;
}

// Breadth first: all voxels under the wall's value go to the mark that reaches them first.
void growMarks(const GreyVolume& field, double wall, MaskVolume& marks) {
    std::vector<glm::ivec3> front = markedBorder(marks);
    while (!front.empty()) {
        std::vector<glm::ivec3> next;
        for (const glm::ivec3& voxel : front)
            for (const glm::ivec3& step : kNeighbours) {
                const glm::ivec3 to = voxel + step;
                if (marks.frame.contains(to) && !marks.at(to) && field.at(to) < wall) {
                    marks.at(to) = marks.at(voxel);
                    next.push_back(to);
                }
            }
        front = std::move(next);
    }
}

std::int16_t walledOff(double wall) {
    return static_cast<std::int16_t>(std::ceil(wall) + 50);
}

// Other air that meets the lumen is walled off, so that the lumen ends where it is said to end.
void wallOff(const MaskVolume& marks, double wall, GreyVolume& field) {
    const glm::ivec3 size = marks.frame.size;
    const std::int16_t above = walledOff(wall);
    parallelFor(size.z - 2, [&](int slice) {
        const int k = slice + 1;
        for (int j = 1; j < size.y - 1; ++j)
            for (int i = 1; i < size.x - 1; ++i) {
                if (marks.at(i, j, k) != kElse) continue;
                for (const glm::ivec3& step : kNeighbours)
                    if (marks.at(glm::ivec3(i, j, k) + step) == kColon) field.at(i, j, k) = above;
            }
        releaseUnmarked(marks, k);
    });
}

Pieces markedPieces(const MaskVolume& marks) {
    Pieces pieces;
    pieces.runs = collectRuns(marks.frame.size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::uint8_t* row = marks.values.data() + marks.frame.index(0, j, k);
        for (int i = 0; i < marks.frame.size.x;) {
            const int first = i;
            while (i < marks.frame.size.x && row[i] == kColon) ++i;
            if (i > first) runs.push_back({first, i});
            while (i < marks.frame.size.x && row[i] != kColon) ++i;
        }
        if (j + 1 == marks.frame.size.y) releaseUnmarked(marks, k);
    });
    pieces.parts = connectedComponents(pieces.runs);
    return pieces;
}

std::vector<int> worthKeeping(const Pieces& pieces, const VolumeFrame& frame) {
    const double voxel = frame.spacing.x * frame.spacing.y * frame.spacing.z;
    std::vector<int> bySize(pieces.parts.list.size());
    std::iota(bySize.begin(), bySize.end(), 0);
    std::stable_sort(bySize.begin(), bySize.end(), [&](int a, int b) {
        return pieces.parts.list[static_cast<std::size_t>(a)].voxels >
               pieces.parts.list[static_cast<std::size_t>(b)].voxels;
    });
    std::size_t count = 0;
    while (count < std::min<std::size_t>(bySize.size(), 255) &&
           (count == 0 ||
            static_cast<double>(pieces.parts.list[static_cast<std::size_t>(bySize[count])].voxels) * voxel >=
                kSmallestPiece))
        ++count;
    bySize.resize(count);
    std::sort(bySize.begin(), bySize.end());
    return bySize;
}

// Returns where a lumen's frame lies in the study's; nothing unless it is a part of the same grid.
std::optional<LumenCrop> placeIn(const VolumeFrame& lumen, const VolumeFrame& study) {
    const glm::dvec3 voxel = study.voxelFromWorld(lumen.origin), nearest = glm::round(voxel);
    for (int a = 0; a < 3; ++a)
        if (!(std::abs(voxel[a] - nearest[a]) < 1e-3 && std::abs(voxel[a]) < 1e6 &&
              std::abs(lumen.spacing[a] / study.spacing[a] - 1) < 1e-6 &&
              glm::length(lumen.axes[a] - study.axes[a]) < 1e-6))
            return std::nullopt;
    LumenCrop crop;
    crop.first = glm::ivec3(nearest);
    crop.frame = study.cropped(crop.first, lumen.size);
    return crop;
}

// Air of the known lumen is the colon's, all other is none of its business.
AirPieces airInside(const GreyVolume& study, const SegmentationSetting& setting,
                    const std::function<bool(const glm::ivec3&)>& inside) {
    AirPieces air;
    air.pieces.runs = runsBelow(study, storedOf(study, setting.air));
    air.pieces.parts = connectedComponents(air.pieces.runs);
    air.kinds.assign(air.pieces.parts.list.size(), AirKind::Outside);
    const VoxelRuns& runs = air.pieces.runs;
    for (int k = 0; k < runs.size.z; ++k)
        for (int j = 0; j < runs.size.y; ++j) {
            const std::size_t row = runs.rowNumber(j, k);
            for (std::uint32_t n = runs.rowStart[row]; n < runs.rowStart[row + 1]; ++n)
                if (inside({runs.runs[n].first, j, k})) air.kinds[air.pieces.parts.ofRun[n]] = AirKind::Colon;
        }
    return air;
}

bool touchesLumen(const MaskVolume& lumen, const glm::ivec3& voxel) {
    return std::any_of(std::begin(kNeighbours), std::end(kNeighbours), [&](const glm::ivec3& step) {
        return lumen.frame.contains(voxel + step) && lumen.at(voxel + step) != 0;
    });
}

// Closes off the voxels beside the lumen whose values are below the wall's. Returns false where the lumen's
// own values are not below it.
bool closeAround(const MaskVolume& lumen, double wall, GreyVolume& field) {
    const glm::ivec3 size = lumen.frame.size;
    std::atomic<bool> fits = true;
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                std::int16_t& value = field.at(i, j, k);
                if (lumen.at(i, j, k)) {
                    if (!(value < wall)) fits = false;
                } else if (value < wall && touchesLumen(lumen, {i, j, k})) {
                    value = walledOff(wall);
                }
            }
    });
    return fits;
}

// Segments from their numbers in the lumen; none where numbers are missing.
std::vector<LumenSegment> segmentsOf(const MaskVolume& lumen) {
    const glm::ivec3 size = lumen.frame.size;
    const glm::dvec3& s = lumen.frame.spacing;
    std::vector<LumenSegment> segments(255, {0, 0, size, glm::ivec3(-1)});
    std::size_t count = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                if (const std::uint8_t number = lumen.at(i, j, k)) {
                    LumenSegment& segment = segments[number - 1];
                    ++segment.voxels;
                    segment.first = glm::min(segment.first, glm::ivec3(i, j, k));
                    segment.last = glm::max(segment.last, glm::ivec3(i, j, k));
                    count = std::max<std::size_t>(count, number);
                }
    segments.resize(count);
    for (LumenSegment& segment : segments) {
        if (segment.voxels == 0) return {};
        segment.volume = static_cast<double>(segment.voxels) * s.x * s.y * s.z;
    }
    return segments;
}

// Left in, it may cut the lumen where it fills a loop.
void noteFluid(std::size_t pools, const SegmentationSetting& setting, LumenField& lumen) {
    if (setting.leavesFluid && pools == 0)
        lumen.notes.emplace_back("no tagged fluid was found that could be left in");
    else if (setting.leavesFluid)
        lumen.notes.push_back(fmt::format(
            "left {} pool(s) of tagged fluid in, their surface is wall: the lumen is in {} piece(s)", pools,
            lumen.segments.size()));
    else if (pools > 0)
        lumen.notes.push_back(fmt::format("took {} pool(s) of tagged fluid for lumen", pools));
}

LumenField segmentStudy(const GreyVolume& study, const SegmentationSetting& setting,
                        std::optional<VoxelRuns> known, const SliceDone& done, Progress& progress) {
    checkSetting(setting);
    Progress findingAir(progress, 0, 0.4);
    AirPieces air = findAir(study, setting, std::move(known), findingAir);
    takeGiven(study, setting, air);
    progress.report(0.4, "looking for tagged fluid");
    FluidPools fluid = findFluid(study, setting, air);
    const std::size_t pools = fluid.pools.size();
    if (setting.leavesFluid) fluid.pools.clear();
    LumenField lumen;
    lumen.notes = pieceNotes(study, air);
    const LumenCrop crop = cropOf(study, air, fluid);
    for (int k = 0; k < study.frame.size.z; ++k)
        if (k < crop.first.z || k >= crop.first.z + crop.frame.size.z) done(k);
    lumen.field = cutField(study, crop, done);
    lumen.isovalue = setting.wall;
    Pieces pieces;
    {
        MaskVolume marks(crop.frame);
        cleanseFluid(fluid, setting, crop.first, lumen.field, marks);
        fluid = {};
        progress.report(0.7, "following the wall");
        markAir(air, crop, marks);
        air = {};
        growMarks(lumen.field, setting.wall, marks);
        wallOff(marks, setting.wall, lumen.field);
        pieces = markedPieces(marks);
    }
    setSegments(pieces, orderOf(pieces, worthKeeping(pieces, crop.frame), crop.frame), lumen);
    noteFluid(pools, setting, lumen);
    progress.report(1, "found the lumen");
    return lumen;
}

}  // namespace

std::optional<LumenField> restoreLumen(const GreyVolume& study, MaskVolume lumen,
                                       const SegmentationSetting& setting) {
    const std::optional<LumenCrop> crop = placeIn(lumen.frame, study.frame);
    if (!crop || !(setting.wall < kBodyTissue)) return std::nullopt;
    const auto inside = [&](const glm::ivec3& voxel) {
        return lumen.frame.contains(voxel - crop->first) && lumen.at(voxel - crop->first) != 0;
    };
    LumenField found;
    found.segments = segmentsOf(lumen);
    if (found.segments.empty()) return std::nullopt;
    FluidPools fluid;
    if (!setting.leavesFluid) fluid = poolsInside(study, setting, airInside(study, setting, inside), inside);
    found.field = cutField(study, *crop, [](int) {});
    found.isovalue = setting.wall;
    MaskVolume marks(crop->frame);
    cleanseFluid(fluid, setting, crop->first, found.field, marks);
    if (!closeAround(lumen, setting.wall, found.field)) return std::nullopt;
    lumen.frame = crop->frame;
    found.lumen = std::move(lumen);
    return found;
}

LumenField segmentColon(const GreyVolume& study, const SegmentationSetting& setting, Progress& progress,
                        std::optional<VoxelRuns> known) {
    return segmentStudy(
        study, setting, std::move(known), [](int) {}, progress);
}

LumenField segmentColon(GreyVolume&& study, const SegmentationSetting& setting, Progress& progress,
                        std::optional<VoxelRuns> known) {
    const std::size_t perSlice = static_cast<std::size_t>(study.frame.size.x) * study.frame.size.y;
    const auto release = [&](int k) {
        if (k >= 0 && k < study.frame.size.z) study.values.release(perSlice * k, perSlice);
    };
    return segmentStudy(study, setting, std::move(known), release, progress);
}

}  // namespace stereonav
