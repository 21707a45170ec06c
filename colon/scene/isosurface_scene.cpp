// Volumes seen from outside.
#include "colon/scene/isosurface_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "colon/scene/guessed_up.h"
#include "colon/scene/transfer_presets.h"
#include "colon/segmentation/lumen_surface.h"
#include "colon/segmentation/mask_smoothing.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/camera/default_eyes.h"
#include "engine/camera/first_view.h"
#include "engine/camera/orbit.h"
#include "engine/math/constants.h"
#include "engine/volume/seen_blocks.h"

namespace stereonav {
namespace {
constexpr double kAirSeen = -500, kBone = 300, kSkin = -300;  // HU
constexpr double kBoneShare = 0.002;  // share of the voxels: less is a contrast agent or a calcification

double valueOf(const GreyVolume& grey, double stored) {
    return stored * grey.scale + grey.offset;
}
float storedIsovalue(const GreyVolume& grey, double value) {
    return static_cast<float>((value - grey.offset) / grey.scale);
}

// Calls use(k, its values, how many) for every slice, on all threads.
template <typename Use>
void forSlices(const GreyVolume& grey, const Use& use) {
    const std::size_t perSlice = static_cast<std::size_t>(grey.frame.size.x) * grey.frame.size.y;
    parallelFor(grey.frame.size.z, [&](int k) { use(k, grey.values.data() + perSlice * k, perSlice); });
}

struct Range16 {
    std::int16_t lowest = 0, highest = 0;  // stored numbers
};
Range16 storedRangeOf(const GreyVolume& grey) {
    std::vector<Range16> parts(static_cast<std::size_t>(grey.frame.size.z));
    forSlices(grey, [&](int k, const std::int16_t* values, std::size_t count) {
        Range16 part{values[0], values[0]};
        for (std::size_t n = 0; n < count; ++n) {
            part.lowest = std::min(part.lowest, values[n]);
            part.highest = std::max(part.highest, values[n]);
        }
        parts[k] = part;
    });
    Range16 range = parts.at(0);
    for (const Range16& part : parts) {
        range.lowest = std::min(range.lowest, part.lowest);
        range.highest = std::max(range.highest, part.highest);
    }
    return range;
}

struct Histogram {
    std::array<std::uint64_t, 65536> counts{};
    int lowest = 0, highest = 0;  // stored numbers that occur
};
Histogram histogramOf(const GreyVolume& grey) {
    Histogram histogram;
    std::mutex adding;
    forSlices(grey, [&](int, const std::int16_t* values, std::size_t count) {
        std::vector<std::uint32_t> counts(histogram.counts.size());
        for (std::size_t n = 0; n < count; ++n) ++counts[values[n] + 32768];
        const std::lock_guard lock(adding);
        for (std::size_t n = 0; n < counts.size(); ++n) histogram.counts[n] += counts[n];
    });
    const auto some = [](std::uint64_t count) { return count > 0; };
    const auto& counts = histogram.counts;
    histogram.lowest = static_cast<int>(std::ranges::find_if(counts, some) - counts.begin()) - 32768;
    histogram.highest =
        32767 - static_cast<int>(std::find_if(counts.rbegin(), counts.rend(), some) - counts.rbegin());
    return histogram;
}

// The threshold with the largest variance between the classes on its two sides.
double otsu(const Histogram& histogram) {
    double count = 0, sum = 0;
    for (int v = histogram.lowest; v <= histogram.highest; ++v) {
        const double n = static_cast<double>(histogram.counts[v + 32768]);
        count += n;
        sum += n * v;
    }
    double below = 0, sumBelow = 0, best = -1, threshold = histogram.lowest;
    for (int v = histogram.lowest; v < histogram.highest; ++v) {
        const double n = static_cast<double>(histogram.counts[v + 32768]);
        below += n;
        sumBelow += n * v;
        if (below <= 0 || below >= count) continue;
        const double apart = sumBelow / below - (sum - sumBelow) / (count - below);
        const double variance = below * (count - below) * apart * apart;
        if (variance > best) {
            best = variance;
            threshold = v + 0.5;
        }
    }
    return threshold;
}

// One layer of the smallest value around, so that surfaces are closed where they leave the study. Slices of
// the study go as they are copied.
GreyVolume padded(GreyVolume grey) {
    VolumeFrame frame = grey.frame;
    frame.origin = grey.frame.worldFromVoxel(glm::dvec3(-1));
    frame.size += 2;
    GreyVolume out(frame);
    out.scale = grey.scale;
    out.offset = grey.offset;
    const std::int16_t smallest = storedRangeOf(grey).lowest;
    const glm::ivec3 size = grey.frame.size;
    const std::size_t perSlice = static_cast<std::size_t>(size.x) * size.y;
    parallelFor(frame.size.z, [&](int slice) {
        const int k = slice - 1;
        std::fill_n(&out.at(0, 0, slice), static_cast<std::size_t>(frame.size.x) * frame.size.y, smallest);
        if (k < 0 || k >= size.z) return;
        for (int j = 0; j < size.y; ++j)
            std::copy_n(&grey.values[grey.frame.index(0, j, k)], size.x, &out.at(1, j + 1, slice));
        grey.values.release(perSlice * k, perSlice);
    });
    return out;
}

// The mask with such a layer of its smaller value, and its wall without stairs: values rise towards the
// inside.
GreyVolume smoothedMask(GreyVolume grey, double length, Progress& progress) {
    VolumeFrame frame = grey.frame;
    frame.origin = grey.frame.worldFromVoxel(glm::dvec3(-1));
    frame.size += 2;
    const Range16 range = storedRangeOf(grey);
    const VoxelRuns inside = collectRuns(frame.size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        const glm::ivec3 size = grey.frame.size;
        if (j == 0 || k == 0 || j > size.y || k > size.z) return;
        const std::int16_t* row = &grey.values[grey.frame.index(0, j - 1, k - 1)];
        for (int i = 0, end = 0; i < size.x; i = end + 1) {
            end = i;
            while (end < size.x && row[end] > range.lowest) ++end;
            if (end > i) runs.push_back({i + 1, end + 1});
        }
    });
    const double lowest = valueOf(grey, range.lowest), highest = valueOf(grey, range.highest);
    grey = {};
    GreyVolume out(frame);
    smoothWall(inside, length, out, progress);
    const std::size_t perSlice = static_cast<std::size_t>(frame.size.x) * frame.size.y;
    parallelFor(frame.size.z, [&](int k) {
        std::int16_t* values = &out.at(0, 0, k);
        for (std::size_t n = 0; n < perSlice; ++n)  // memory that was never written stays so
            if (values[n] != kMaskOutside) values[n] = static_cast<std::int16_t>(kMaskOutside - values[n]);
    });
    out.scale = (highest - lowest) / (kMaskOutside - kMaskInside);
    out.offset = lowest;
    return out;
}

// The isovalue of a mask's wall.
IsovalueChoice middleOfMask(const GreyVolume& grey) {
    const Range16 range = storedRangeOf(grey);
    return {0.5 * (valueOf(grey, range.lowest) + valueOf(grey, range.highest)),
            "half way between the two values of a mask"};
}

struct Ball {
    glm::dvec3 middle{0.0};  // world
    double radius = 0;
};
// Returns a ball around the box of the voxels that reach the isovalue; where that is one voxel, a ball around
// the voxel.
Ball ballAround(const GreyVolume& field, float isovalue) {
    glm::ivec3 low = field.frame.size, high(-1);
    const glm::ivec3 size = field.frame.size;
    std::mutex joining;
    forSlices(field, [&](int k, const std::int16_t* values, std::size_t) {
        glm::ivec3 first = size, last(-1);
        for (int j = 0; j < size.y; ++j, values += size.x)
            for (int i = 0; i < size.x; ++i)
                if (static_cast<float>(values[i]) >= isovalue) {
                    first = glm::min(first, glm::ivec3(i, j, k));
                    last = glm::max(last, glm::ivec3(i, j, k));
                }
        const std::lock_guard lock(joining);
        low = glm::min(low, first);
        high = glm::max(high, last);
    });
    const glm::dvec3 a = field.frame.worldFromVoxel(glm::dvec3(low)),
                     b = field.frame.worldFromVoxel(glm::dvec3(high));
    const glm::dvec3& spacing = field.frame.spacing;
    const double least = 0.5 * std::min({spacing.x, spacing.y, spacing.z});
    return {0.5 * (a + b), std::max(0.5 * glm::length(b - a), least)};
}

void placeViewer(ColonScene& scene) {
    const Ball ball = ballAround(scene.volume.field, scene.volume.cells.isovalue);
    scene.lens.verticalFov = 40 * kPi / 180;
    const double distance = 1.1 * ball.radius / std::sin(0.5 * scene.lens.verticalFov);
    scene.lens.nearDepth = 0.005 * ball.radius;
    scene.stereo = defaultEyes(SeenAs::Outside, distance);
    const Orbit orbit{ball.middle, distance, -0.2};  // from a little above
    scene.startPose = poseOn(orbit, 0);
    scene.path = flightAround(orbit, "the flight around the volume");
    scene.extent = 2 * ball.radius;
}

// The stored numbers of which something is seen.
SeenNumbers seenIn(const VolumeScene& volume, double spacing) {
    const GreyVolume& field = volume.field;
    const TransferFunction& transfer = volume.look.transfer;
    SeenNumbers seen = seenFrom(volume.cells.isovalue);
    if (transfer.empty()) return seen;
    constexpr double kLeast = 0.005;  // share of light that a voxel takes
    bool some = false;
    SeenNumbers through(seen.size());
    for (std::size_t n = 0; n < seen.size(); ++n) {
        const double value = valueOf(field, static_cast<double>(n) - 32768);
        through[n] = -std::expm1(-transfer.extinction(value) * spacing) >= kLeast;
        some |= through[n] != 0;
    }
    return some ? through : seen;
}

// Places the viewer by what is seen; false where nothing of that is found.
bool placeByView(ColonScene& scene, const ChosenForVolume& chosen) {
    constexpr double kFront = 0.12;
    const VolumeFrame& frame = scene.volume.field.frame;
    const glm::dvec3& spacing = frame.spacing;
    const double edge = std::cbrt(spacing.x * spacing.y * spacing.z);
    SeenBlocks blocks = seenBlocks(scene.volume.field, seenIn(scene.volume, edge));
    dropCrumbs(blocks);
    const double fov = 40 * kRadians;
    ViewWanted wanted{chosen.fov.value_or(fov), chosen.aspect, kFront,
                      0.5 * std::min({spacing.x, spacing.y, spacing.z})};
    const std::optional<FirstView> view = firstViewOf(surfaceOf(blocks), wanted);
    if (!view) return false;
    scene.lens.verticalFov = fov;
    scene.lens.nearDepth = 0.005 * view->radius;
    scene.stereo = defaultEyes(SeenAs::Outside, view->orbit.distance);
    scene.startPose = view->pose();
    scene.path = flightAround(view->flight, "the flight around the volume", view->turn);
    scene.extent = 2 * view->radius;
    return true;
}

// The function of --transfer or, around the isovalue, of --opacity; empty: opaque. scene: whose values it is
// for; counts may be null.
TransferFunction transferOf(const ColonOptions& options, const ColonScene& scene, double isovalue) {
    if (!options.transfer.empty())
        return scene.counts ? fittedTransfer(options.transfer, scene.kinds)
                            : findTransferFunction(options.transfer);
    if (!options.opacity) return {};
    const glm::vec3& color = scene.volume.look.surface;
    return TransferFunction({{isovalue - 1, color, 0.0}, {isovalue + 1, color, *options.opacity}}, 0.001,
                            "--opacity");
}

// What is said of a function that shows nothing; "" of others.
std::string warningOf(const ColonOptions& options, const ColonScene& scene,
                      const TransferFunction& transfer) {
    if (!scene.counts || options.transfer.empty()) return "";
    return warningOfEmpty(options.transfer, transfer, *scene.counts, scene.kinds);
}

// The cells that hold the surface or, of a translucent volume, anything that is not transparent.
SurfaceSetting cellsShown(const GreyVolume& field, double isovalue, const TransferFunction& transfer) {
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = storedIsovalue(field, isovalue);
    const TransferFunction::Range range = transfer.visibleRange();
    if (range.lowest > range.highest) return setting;  // opaque, or all transparent
    setting.lowest = std::max(storedIsovalue(field, range.lowest), -32768.0f);
    setting.highest = std::min(storedIsovalue(field, range.highest), 32767.0f);
    if (setting.lowest > setting.highest) std::swap(setting.lowest, setting.highest);
    return setting;
}

bool sameCells(const SurfaceSetting& a, const SurfaceSetting& b) {
    return a.isovalue == b.isovalue && a.lowest == b.lowest && a.highest == b.highest;
}

SurfaceCells cellsAt(const GreyVolume& field, double isovalue, const TransferFunction& transfer,
                     Progress& progress) {
    if (!std::isfinite(isovalue))
        throw Error("--isovalue", "", fmt::format("expected a number, got {}", isovalue),
                    "300 shows bone in CT");
    Progress first(progress, 0, transfer.empty() ? 1 : 0.5), second(progress, 0.5, 1);
    SurfaceCells cells = findSurfaceCells(field, cellsShown(field, isovalue, transfer), first);
    // A function that shows none of the values that there are shows the background.
    if (cells.active == 0 && !transfer.empty())
        cells = findSurfaceCells(field, cellsShown(field, isovalue, {}), second);
    progress.report(1, "storing what rays need");
    if (cells.active > 0) return cells;
    const Range16 range = storedRangeOf(field);
    throw Error("--isovalue", "", fmt::format("expected a value inside the volume's, got {:g}", isovalue),
                fmt::format("values go from {:g} to {:g}", valueOf(field, range.lowest),
                            valueOf(field, range.highest)));
}
}  // namespace

bool looksLikeHounsfield(const GreyVolume& grey) {
    const std::size_t step = std::max<std::size_t>(1, grey.frame.count() / 1'000'003);
    for (std::size_t n = 0; n < grey.frame.count(); n += step)
        if (valueOf(grey, grey.values[n]) <= kAirSeen) return true;
    return false;
}

IsovalueChoice chooseIsovalue(const GreyVolume& grey) {
    if (!looksLikeHounsfield(grey) ||
        valueOf(grey, storedRangeOf(grey).highest) <= kSkin) {  // air alone has no skin
        const double value = valueOf(grey, otsu(histogramOf(grey)));
        return {value, "between the two kinds of values that differ most"};
    }
    std::atomic<std::size_t> bone = 0;
    forSlices(grey, [&](int, const std::int16_t* values, std::size_t count) {
        std::size_t here = 0;
        for (std::size_t n = 0; n < count; ++n) here += valueOf(grey, values[n]) >= kBone;
        bone += here;
    });
    if (static_cast<double>(bone.load()) >= kBoneShare * static_cast<double>(grey.frame.count()))
        return {kBone, "bone"};
    return {kSkin, "skin"};
}

namespace {
void lookAtValues(const GreyVolume& grey, ColonScene& scene) {
    Progress quiet;
    auto counts = std::make_shared<ValueCounts>(countValues(grey, 0, nullptr, quiet));
    scene.kinds = kindsOf(*counts, looksLikeHounsfield(grey), grey.frame);
    scene.counts = std::move(counts);
}

// Turns a volume whose file does not say how it lies.
void turnAsGuessed(GreyVolume& grey, double isovalue, ColonScene& scene) {
    const GuessedUp guess = guessUp(grey, scene.kinds, storedIsovalue(grey, isovalue));
    if (guess.up) turnUp(grey.frame, *guess.up);
    if (guess.up && *guess.up != UpAxis()) scene.up = guess.up;
    scene.notes.push_back(
        guess.up
            ? fmt::format("the file does not say which way is up, {} is guessed, as {}; --up gives another",
                          nameOf(*guess.up), guess.why)
            : "the file does not say which way is up, z is taken; --up gives another");
}
}  // namespace

double surfaceWorking(double voxels) {
    // Flags of cells, distances and their squares; of large volumes codes and what groups of cells take, and
    // the same of one block (leap_blocks.h).
    constexpr double kAtOnce = 8.5, kByBlocks = 1.2, kBlock = 11.0 * 288 * 288 * 288;
    if (voxels <= static_cast<double>(SurfaceSetting::kCellsAtOnce)) return kAtOnce * voxels;
    return kByBlocks * voxels + kBlock;
}

ColonScene isosurfaceScene(GreyVolume grey, const ColonOptions& options, Progress& progress,
                           const VolumeOrigin& origin) {
    ColonScene scene;
    if (origin.mask) scene.maskSmoothed = smoothedLength(options.segmentation.maskSmoothing, grey.frame);
    const double smoothed = scene.maskSmoothed.value_or(0);
    if (options.chosen.values) lookAtValues(grey, scene);
    const bool chooses = scene.counts && !options.chosen.baked;
    double isovalue = 0;
    if (options.isovalue) {
        isovalue = *options.isovalue;
    } else {
        const IsovalueChoice choice = smoothed > 0 ? middleOfMask(grey)
                                      : chooses    ? isovalueFor(*scene.counts, scene.kinds)
                                                   : chooseIsovalue(grey);
        isovalue = choice.isovalue;
        scene.notes.push_back(fmt::format("isovalue {:g} chosen: {}{}", choice.isovalue, choice.why,
                                          chooses ? "; --isovalue gives another" : ""));
    }
    if (chooses && !options.up && !origin.directed) turnAsGuessed(grey, isovalue, scene);
    VolumeLook& look = scene.volume.look;
    look.falloff = 0;
    look.surface = {0.62f, 0.57f, 0.48f};
    look.ambient = 0.12f;
    look.diffuse = 0.88f;
    look.background = {0.012f, 0.014f, 0.018f};
    look.transfer = transferOf(options, scene, isovalue);
    scene.warning = warningOf(options, scene, look.transfer);
    if (!scene.warning.empty()) scene.notes.push_back(scene.warning);
    checkMemory("the surface of a volume", surfaceWorking(static_cast<double>(grey.frame.count())),
                "crop the volume or make it coarser");
    Progress smoothing(progress, 0, 0.5), casting(progress, smoothed > 0 ? 0.5 : 0, 1);
    scene.volume.field =
        smoothed > 0 ? smoothedMask(std::move(grey), smoothed, smoothing) : padded(std::move(grey));
    scene.volume.cells = cellsAt(scene.volume.field, isovalue, look.transfer, casting);
    if (!options.chosen.view || !placeByView(scene, options.chosen)) placeViewer(scene);
    scene.clearance = options.clearance > 0 ? options.clearance : 0.01 * scene.extent;
    return scene;
}

void setSurface(ColonScene& scene, const std::optional<double>& isovalue, const ColonOptions& options,
                Progress& progress) {
    constexpr const char* kChanging = "changing the surface";
    progress.report(0, kChanging);
    const GreyVolume& field = scene.volume.field;
    VolumeLook& look = scene.volume.look;
    const float now = scene.volume.cells.isovalue;
    const double value = isovalue.value_or(valueOf(field, now));
    TransferFunction transfer = transferOf(options, scene, value);
    scene.warning = warningOf(options, scene, transfer);
    const bool nothing = (!isovalue || storedIsovalue(field, value) == now) && transfer == look.transfer;
    // Colours, and opacities that stay above 0, change no cell.
    const bool same = nothing || (look.transfer.empty() == transfer.empty() && std::isfinite(value) &&
                                  sameCells(cellsShown(field, value, transfer),
                                            cellsShown(field, valueOf(field, now), look.transfer)));
    if (!same) scene.volume.cells = cellsAt(field, value, transfer, progress);
    look.transfer = std::move(transfer);
    progress.report(1, kChanging);
}

}  // namespace stereonav
