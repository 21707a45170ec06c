// From a study to a scene: what finding gives (or the cache kept) becomes a wall, a line to fly along, a lens
// and a pair of eyes. Volumes in which no colon is looked for become a surface seen from outside.
#include "colon/scene/colon_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "colon/flight/colon_flight.h"
#include "colon/scene/colon_cache.h"
#include "colon/scene/isosurface_scene.h"
#include "colon/scene/saved_lumen.h"
#include "colon/scene/transfer_presets.h"
#include "colon/segmentation/lumen_pieces.h"
#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/camera/default_eyes.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr double kFov = 80 * std::numbers::pi / 180;  // vertical: 80 to 90 degrees are usual in colonography
constexpr double kTranslucentMargin = 0.004;          // metres of flesh kept behind the wall
constexpr double kFlesh = 150, kSolid = 100;          // HU before and behind the wall's isovalue

std::string nameOf(const ColonOptions& options) {
    return options.study.empty() ? "colon" : options.study.filename().string();
}

GreyVolume greyOf(const MaskVolume& mask) {
    GreyVolume grey(mask.frame);
    for (std::size_t n = 0; n < mask.frame.count(); ++n)
        if (mask.values[n]) grey.values[n] = 100;
    return grey;
}

// The lumen that was kept for this study and setting; found anew, and kept, where there is none.
LumenField lumenOfGrey(Study& study, const ColonOptions& options, std::vector<std::string>& notes,
                       Progress& progress) {
    const bool keeps = options.cache && !options.study.empty();
    const std::uint64_t key = savedLumenKey(study.key, options.segmentation);
    const double found = keeps ? 0.2 : 0;  // share of the progress: none is looked for where none is kept
    if (keeps) {
        Progress reading(progress, 0, found);
        SavedLumen saved = readSavedLumen(options.study, study.grey, options.segmentation, key, reading);
        notes.insert(notes.end(), saved.notes.begin(), saved.notes.end());
        if (saved.lumen) return std::move(*saved.lumen);
    }
    Progress finding(progress, found, 1);
    LumenField lumen =
        options.keepsStudy
            ? segmentColon(study.grey, options.segmentation, finding, std::move(study.air))
            : segmentColon(std::move(study.grey), options.segmentation, finding, std::move(study.air));
    if (keeps) notes.push_back(saveLumen(lumen, key, options.study));
    return lumen;
}

// What is said of a colon is of its study.
template <typename Work>
auto inTheNameOf(const ColonOptions& options, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(options.study.empty() ? "colon" : options.study.string(), "", error.what(),
                    "render, play and view show any volume from outside with --isosurface");
    }
}

// The colon in a study that was read, whose values go as soon as nobody asks for them.
FoundColon findColon(Study& study, const ColonOptions& options, Progress& progress) {
    FoundColon found;
    found.format = study.format;
    found.ofMask = study.isMask;
    found.studyFrame = study.isMask ? study.mask.frame : study.grey.frame;
    found.notes = study.notes;
    Progress findingLumen(progress, 0, 0.7), findingLine(progress, 0.7, 1);
    found.lumen = study.isMask ? lumenFromMask(study.mask, options.segmentation, findingLumen)
                               : lumenOfGrey(study, options, found.notes, findingLumen);
    study.mask = {};
    if (!options.keepsStudy) study.grey = {};
    found.values = wholeRangeOf(found.lumen.field);
    dropFarValues(found.lumen);
    const DistanceVolume distance = distanceToOutside(found.lumen.lumen);
    found.centreline = findCentreline(found.lumen, distance, options.centreline, findingLine);
    return found;
}

TransferFunction wallTransfer(const ColonOptions& options, double wall, const glm::vec3& color) {
    if (!options.transfer.empty()) return findTransferFunction(options.transfer);
    if (!options.opacity) return {};
    return TransferFunction({{wall - kFlesh, color, 0.0}, {wall + kSolid, color, *options.opacity}}, 0.001,
                            "--opacity");
}

// The lumen and all within some voxels of it along each axis.
MaskVolume grown(const MaskVolume& lumen, const glm::ivec3& margin) {
    MaskVolume result(lumen.frame);
    const glm::ivec3 size = lumen.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j) {
            const std::uint8_t* row = &lumen.values[lumen.frame.index(0, j, k)];
            const glm::ivec3 low = glm::max(glm::ivec3(0, j, k) - margin, 0);
            const glm::ivec3 high = glm::min(glm::ivec3(0, j, k) + margin, size - 1);
            for (int i = 0, end = 0; i < size.x; i = end + 1) {
                end = i;
                while (end < size.x && row[end]) ++end;
                if (end == i) continue;
                const int from = std::max(i - margin.x, 0), to = std::min(end + margin.x, size.x);
                for (int z = low.z; z <= high.z; ++z)
                    for (int y = low.y; y <= high.y; ++y)
                        std::fill_n(&result.at(from, y, z), to - from, std::uint8_t{1});
            }
        }
    return result;
}

// Stored numbers between which a translucent wall is not transparent.
struct ShownNumbers {
    float lowest, highest;
    bool operator==(const ShownNumbers&) const = default;
};
ShownNumbers shownNumbers(const GreyVolume& field, const TransferFunction& transfer) {
    const TransferFunction::Range range = transfer.visibleRange();
    return {static_cast<float>(std::max((range.lowest - field.offset) / field.scale, -32768.0)),
            static_cast<float>(std::min((range.highest - field.offset) / field.scale, 32767.0))};
}

SurfaceCells wallCells(const ColonScene& scene, Progress& progress) {
    const GreyVolume& field = scene.volume.field;
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = static_cast<float>(scene.lumen.isovalue);
    setting.region = &scene.lumen.lumen;
    const TransferFunction& transfer = scene.volume.look.transfer;
    if (transfer.empty()) return findSurfaceCells(field, setting, progress);
    const ShownNumbers shown = shownNumbers(field, transfer);
    setting.lowest = shown.lowest;
    setting.highest = shown.highest;
    const glm::ivec3 margin = glm::min(glm::ivec3(glm::ceil(kTranslucentMargin / field.frame.spacing)),
                                       glm::ivec3(kKeptMargin - 2));
    const MaskVolume region = grown(scene.lumen.lumen, margin);
    setting.region = &region;
    return findSurfaceCells(field, setting, progress);
}

// What is said of a wall of which nothing is seen; "" of others.
std::string warningOf(const ColonScene& scene, const ColonOptions& options) {
    if (options.transfer.empty()) return "";
    Progress quiet;
    const GreyVolume& field = scene.volume.field;
    const ValueCounts counts = countValues(field, 0, &scene.lumen.lumen, quiet);
    if (counts.empty()) return "";
    return warningOfEmpty(options.transfer, scene.volume.look.transfer, counts,
                          kindsOf(counts, true, field.frame));
}

double middleRadius(const Centreline& line) {
    std::vector<double> radii;
    for (const CentrelinePoint& point : line.points) radii.push_back(point.radius);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

void placeViewer(ColonScene& scene, const ColonOptions& options) {
    const double radius = std::max(middleRadius(scene.centreline), 1e-4);
    scene.clearance = options.clearance > 0 ? options.clearance : std::min(0.002, 0.25 * radius);
    // Looking along a tube, the middle of the picture is some two and a half radii away.
    scene.stereo = defaultEyes(SeenAs::Lumen, 2.5 * radius);
    scene.lens.verticalFov = kFov;
    // The nearest thing in the corner of a wide picture is the clearance away along its ray.
    scene.lens.nearDepth = 0.2 * scene.clearance;
    const VolumeFrame& frame = scene.lumen.lumen.frame;
    scene.extent = glm::length(frame.spacing * glm::dvec3(frame.size));
    ColonFlightSetting flight;
    flight.clearance = scene.clearance;
    flight.largestSeparation = scene.stereo.separation;
    const auto freeDistance = [&scene](const glm::dvec3& p, double upTo) {
        return scene.freeDistanceAt(p, upTo);
    };
    scene.path =
        inTheNameOf(options, [&] { return centrelineFlight(freeDistance, scene.centreline, flight); });
    scene.startPose = scene.path.samples().front().pose;
}

// Sets the look of moist mucosa under an endoscope's lamp: light falls off within a few centimetres, which
// shows depth, and highlights are narrow.
void lookWet(VolumeLook& look) {
    look.surface = {0.78f, 0.33f, 0.25f};
    look.ambient = 0.10f;
    look.diffuse = 1.05f;
    look.specular = 0.30f;
    look.shininess = 48;
    look.falloff = 0.035f;
}

ColonScene sceneOf(FoundColon found, const ColonOptions& options, Progress& progress) {
    ColonScene scene;
    scene.format = std::move(found.format);
    scene.studyFrame = found.studyFrame;
    scene.notes = std::move(found.notes);
    if (found.ofMask)
        scene.maskSmoothed = smoothedLength(options.segmentation.maskSmoothing, found.studyFrame);
    scene.lumen = std::move(found.lumen);
    scene.valuesFound = found.values;
    scene.notes.insert(scene.notes.end(), scene.lumen.notes.begin(), scene.lumen.notes.end());
    scene.volume.field = std::move(scene.lumen.field);
    scene.centreline = std::move(found.centreline);
    scene.polyps = std::move(found.polyps);
    if (options.wetWall) lookWet(scene.volume.look);
    const GreyVolume& field = scene.volume.field;
    const double wall = scene.lumen.isovalue * field.scale + field.offset;
    scene.volume.look.transfer = wallTransfer(options, wall, scene.volume.look.surface);
    progress.report(0, "preparing the wall");
    scene.volume.cells = wallCells(scene, progress);
    scene.warning = warningOf(scene, options);
    if (!scene.warning.empty()) scene.notes.push_back(scene.warning);
    placeViewer(scene, options);
    return scene;
}

ColonScene surfaceOf(Study study, const ColonOptions& options, const std::string& note, Progress& progress) {
    GreyVolume grey = study.isMask ? greyOf(study.mask) : std::move(study.grey);
    study.mask = {};
    const VolumeFrame whole = grey.frame;
    if (options.up) turnUp(grey.frame, *options.up);
    ColonScene scene = isosurfaceScene(std::move(grey), options, progress, {study.directed, study.isMask});
    if (options.up) scene.up = options.up;
    if (options.up) scene.notes.push_back("turned: what points to " + nameOf(*options.up) + " is up");
    scene.format = study.format;
    scene.studyFrame = whole;
    scene.notes.insert(scene.notes.begin(), study.notes.begin(), study.notes.end());
    if (!note.empty()) scene.notes.insert(scene.notes.begin(), note);
    return scene;
}

void refuseTurned(const ColonOptions& options) {
    if (options.up)
        throw Error("--up", "", "needs a volume seen from outside, in this one a colon is looked for",
                    "leave it out: a colon follows the patient's axes; or add --isosurface");
}

// Refuses options that only the search for a colon takes, for a volume in which there is nothing to search.
void refuseOfColons(const ColonOptions& options) {
    const auto refuse = [](bool given, const char* option) {
        if (given)
            throw Error(
                option, "",
                "needs a colon, this volume has no values near those of air and is shown from outside",
                "leave it out");
    };
    refuse(!options.segmentation.seeds.empty(), kSeedOption);
    refuse(!options.segmentation.choices.include.empty(), kIncludeOption);
    refuse(!options.segmentation.choices.exclude.empty(), kExcludeOption);
    refuse(options.centreline.reversed, "--backwards");
}

// The same lumen without its field, which is the volume's.
LumenField sharing(const LumenField& lumen) {
    LumenField same;
    same.isovalue = lumen.isovalue;
    same.lumen = lumen.lumen.share();
    same.segments = lumen.segments;
    same.notes = lumen.notes;
    return same;
}

ColonScene sharing(const ColonScene& scene) {
    ColonScene same;
    same.name = scene.name;
    same.format = scene.format;
    same.studyFrame = scene.studyFrame;
    same.notes = scene.notes;
    same.valuesFound = scene.valuesFound;
    same.volume = {scene.volume.field.share(), scene.volume.cells.share(), scene.volume.look};
    same.lumen = sharing(scene.lumen);
    same.centreline = scene.centreline;
    same.polyps = scene.polyps;
    same.counts = scene.counts;
    same.kinds = scene.kinds;
    same.maskSmoothed = scene.maskSmoothed;
    same.up = scene.up;
    same.startPose = scene.startPose;
    same.path = scene.path;
    same.lens = scene.lens;
    same.stereo = scene.stereo;
    same.clearance = scene.clearance;
    same.extent = scene.extent;
    return same;
}

void changeWall(ColonScene& scene, const ColonOptions& options, Progress& progress) {
    constexpr const char* kChanging = "changing the wall";
    progress.report(0, kChanging);
    VolumeLook& look = scene.volume.look;
    const GreyVolume& field = scene.volume.field;
    const double wall = scene.lumen.isovalue * field.scale + field.offset;
    TransferFunction transfer = wallTransfer(options, wall, look.surface);
    // Colours, and opacities that stay above 0, change no cell.
    const bool same =
        transfer == look.transfer || (!transfer.empty() && !look.transfer.empty() &&
                                      shownNumbers(field, transfer) == shownNumbers(field, look.transfer));
    look.transfer = std::move(transfer);
    if (!same) scene.volume.cells = wallCells(scene, progress);
    scene.warning = warningOf(scene, options);
    progress.report(1, kChanging);
}

// Keys of what may be kept of a study. What is found in grey values does not depend on how masks are
// smoothed, and only what was kept tells which of both a study is.
struct ColonKeys {
    std::uint64_t grey = 0, mask = 0;
    std::uint64_t of(const FoundColon& found) const { return found.ofMask ? mask : grey; }
};
ColonKeys keysOf(std::uint64_t study, const ColonOptions& options) {
    ColonOptions ofGrey = options;
    ofGrey.segmentation.maskSmoothing = 0;
    return {colonCacheKey(study, ofGrey), colonCacheKey(study, options)};
}

// damaged: whether an entry was found that is.
std::optional<FoundColon> keptColon(const ColonKeys& keys, bool& damaged) {
    std::optional<FoundColon> kept = readColonCache(keys.mask, damaged);
    if (kept || keys.grey == keys.mask) return kept;
    bool greyDamaged = false;
    kept = readColonCache(keys.grey, greyDamaged);
    damaged |= greyDamaged;
    return kept && kept->ofMask ? std::nullopt : std::move(kept);
}

// key: the study's, as far as it is asked for.
Study readOrMake(const ColonOptions& options, std::uint64_t key, std::vector<Polyp>& polyps,
                 Progress& progress) {
    if (!options.study.empty()) {
        StudyOptions reading = options.reading;
        reading.key = key;
        if (options.isosurface)
            reading.working = surfaceWorking;
        else
            reading.airBelow = options.segmentation.air;
        return readStudy(options.study, reading, progress);
    }
    BuiltInColon colon = builtInColon(options.builtIn, progress);
    polyps = std::move(colon.polyps);
    Study study;
    study.format = "built in";
    study.grey = std::move(colon.grey);
    study.key = key;
    return study;
}
}  // namespace

double ColonScene::freeDistanceAt(const glm::dvec3& world, double upTo) const {
    const VolumeFrame& frame = volume.field.frame;
    const double tolerance = 0.05 * std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    if (!isColon()) {
        // Outside the volume's box nothing is nearer than the box.
        const glm::dvec3 voxel = frame.voxelFromWorld(world), last(frame.size - 1);
        const glm::dvec3 beyond = glm::max(glm::max(-voxel, voxel - last), glm::dvec3(0.0)) * frame.spacing;
        const double away = glm::length(beyond);
        if (away > 0) return std::min(away, upTo);
    }
    return freeDistance(volume.cells, world, upTo, tolerance);
}

ColonScene changedScene(const ColonScene& scene, const ColonOptions& options, Progress& progress) {
    ColonScene next = sharing(scene);
    if (next.isColon())
        changeWall(next, options, progress);
    else
        setSurface(next, options.isovalue, options, progress);
    return next;
}

ColonScene loadColon(const ColonOptions& options, Progress& progress) {
    const bool builtIn = options.study.empty();
    const std::string name = nameOf(options);
    bool damaged = false;
    std::uint64_t studysKey = 0;
    ColonKeys keys;
    if (!options.isosurface && builtIn) refuseTurned(options);
    if (!options.isosurface && options.cache && !options.up) {
        studysKey = builtIn ? builtInColonKey(options.builtIn) : studyKey(options.study, options.reading);
        keys = keysOf(studysKey, options);
        if (std::optional<FoundColon> kept = keptColon(keys, damaged)) {
            const bool reads = options.keepsStudy && !kept->ofMask;
            Progress making(progress, 0, reads ? 0.5 : 1), reading(progress, 0.5, 1);
            if (!builtIn) noteSource(colonCacheFile(keys.of(*kept)), options.study);
            ColonScene scene = sceneOf(std::move(*kept), options, making);
            scene.name = name;
            if (reads) scene.study = readOrMake(options, 0, scene.polyps, reading).grey;
            return scene;
        }
    }
    std::vector<Polyp> polyps;
    Progress reading(progress, 0, 0.5);
    Study study = readOrMake(options, studysKey, polyps, reading);
    const bool foreign = !study.isMask && !looksLikeHounsfield(study.grey);
    if (options.isosurface || foreign) {
        if (foreign && !options.isosurface) refuseOfColons(options);
        const std::string note = foreign && !options.isosurface
                                     ? "no values near those of air: shown from outside, as a surface"
                                     : "";
        Progress making(progress, 0.5, 1);
        ColonScene scene = surfaceOf(std::move(study), options, note, making);
        scene.name = name;
        return scene;
    }
    refuseTurned(options);
    if (study.isMask && options.segmentation.leavesFluid)
        throw Error("--fluid left", "", "a mask tells nothing of fluid",
                    "name the study that it was made from, or leave it out");
    Progress finding(progress, 0.5, 0.9), making(progress, 0.9, 1);
    FoundColon found = inTheNameOf(options, [&] { return findColon(study, options, finding); });
    found.polyps = std::move(polyps);
    if (options.cache && writeColonCache(keys.of(found), found) && !builtIn)
        noteSource(colonCacheFile(keys.of(found)), options.study);
    ColonScene scene = sceneOf(std::move(found), options, making);
    scene.name = name;
    scene.study = std::move(study.grey);  // nothing of a mask
    if (damaged) scene.notes.push_back("the cache was damaged and is made again");
    return scene;
}

}  // namespace stereonav
