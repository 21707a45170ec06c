#include "app/scene/colon_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/options/option_numbers.h"
#include "app/options/refusals.h"
#include "app/scene/volume_ambient.h"
#include "app/scene/volume_light.h"
#include "colon/colon_flight.h"
#include "colon/transfer_presets.h"
#include "engine/base/error.h"
#include "engine/frame/cast_frames.h"
#include "engine/math/constants.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

// Seconds at normal speed to cross a colon's box, or what is seen from outside.
constexpr double kColonSeconds = 20.0, kOutsideSeconds = 10.0;
constexpr double kAirSeen = -500;                   // a study with smaller values is taken for CT in HU
constexpr double kCtWidth = 1500, kCtLevel = -200;  // a window that shows air, fat, tissue and bone
constexpr double kIsovalueSteps = 100;              // from the smallest value to the largest
constexpr std::size_t kRangeSamples = 4'000'000;    // values looked at for the range

glm::dvec3 seedFromText(const std::string& text) {
    const std::vector<double> n = numbersIn("--seed", seedNumbers(), text).numbers;
    return glm::dvec3(n[0], n[1], n[2]) / 1000.0;
}

std::optional<UpAxis> upFromText(const std::optional<std::string>& text) {
    if (!text) return std::nullopt;
    if (const std::optional<UpAxis> up = upAxisFromText(*text)) return up;
    throw Error("--up", "", "expected x, -x, y, -y, z or -z, got \"" + *text + "\"",
                "-z stands a volume on its head");
}

bool castsShadows(const std::string& shading) {
    return shading.ends_with("-shadows");
}

// A lamp outside lights nothing of a closed wall that casts shadows.
void checkShading(const VolumeOptions& volume, const ColonScene& scene) {
    if (scene.isColon() && castsShadows(volume.shading))
        throw Error("--shading", "",
                    volume.shading + " expects a volume seen from outside, this one is a colon",
                    "add --isosurface, or use lambert or phong");
}

FreeDistance freeDistanceOf(const ColonScene& colon) {
    return [&colon](const glm::dvec3& world, double upTo) { return colon.freeDistanceAt(world, upTo); };
}

// Limits of the eyes' distance: such as suit the scene; in a lumen no more than its flight is to keep clear
// of the wall.
SeparationControl::Setting separationOf(const LoadedScene& scene) {
    SeparationControl::Setting setting;
    const StereoSetting& own = scene.colon->stereo;
    const double most = scene.colon->isColon() ? setting.largest : std::numeric_limits<double>::infinity();
    setting.largest = std::max(std::min(2 * own.separation, most), scene.stereo.separation);
    setting.largest = std::max(setting.largest, 1e-6);
    setting.smallest = std::min(setting.smallest, 0.1 * setting.largest);
    if (own.separation > 0) setting.share = own.separation / own.zeroParallax;
    return setting;
}

bool followsRoom(const SceneOptions& options) {
    return !options.separation_m && !options.zeroParallax_m;
}

std::unique_ptr<Flight> flightThrough(const ColonScene& colon, double largestSeparation) {
    ColonFlightSetting setting;
    setting.clearance = colon.clearance;
    setting.speed = colon.extent / (colon.isColon() ? kColonSeconds : kOutsideSeconds);
    setting.largestSeparation = largestSeparation;
    try {
        return std::make_unique<ColonFlight>(freeDistanceOf(colon), colon.centreline, colon.startPose,
                                             setting);
    } catch (const Error&) {
        if (largestSeparation <= 2 * colon.stereo.separation) throw;
        throw Error("--separation", "",
                    fmt::format("eyes {:g} m apart find no room around the start", largestSeparation),
                    "give less, or leave it out");
    }
}

struct Range {
    double lowest = 0, highest = 0;
};

// Of every voxel, or of some spread evenly where there are many.
Range rangeOf(const GreyVolume& grey) {
    const std::size_t count = grey.frame.count(), step = std::max<std::size_t>(1, count / kRangeSamples);
    std::int16_t lowest = 0, highest = 0;
    for (std::size_t n = 0; n < count; n += step) {
        lowest = n == 0 ? grey.values[n] : std::min(lowest, grey.values[n]);
        highest = n == 0 ? grey.values[n] : std::max(highest, grey.values[n]);
    }
    return {lowest * grey.scale + grey.offset, highest * grey.scale + grey.offset};
}

GreyVolume greyOf(const MaskVolume& mask) {
    GreyVolume grey(mask.frame);
    for (std::size_t n = 0; n < mask.frame.count(); ++n)
        if (mask.values[n] != 0) grey.values[n] = 1;  // zeros are there already, and cost no memory
    return grey;
}

std::shared_ptr<const SliceStudy> readSlices(const ColonOptions& options, Progress& progress) {
    auto slices = std::make_shared<SliceStudy>();
    if (options.study.empty()) {
        slices->grey = builtInColon(options.builtIn, progress).grey;
    } else {
        Study study = readStudy(options.study, options.reading, progress);
        slices->grey = study.isMask ? greyOf(study.mask) : std::move(study.grey);
    }
    if (options.up) turnUp(slices->grey.frame, *options.up);
    const Range range = rangeOf(slices->grey);
    const bool ct = range.lowest <= kAirSeen;
    slices->windowWidth = ct ? kCtWidth : std::max(range.highest - range.lowest, 1e-9);
    slices->windowLevel = ct ? kCtLevel : 0.5 * (range.highest + range.lowest);
    return slices;
}

// The nearest point of the centreline, by metres from its start.
PlaceOnLine placeOn(const std::vector<CentrelinePoint>& points, const glm::dvec3& world) {
    PlaceOnLine place;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n > 0) place.length += glm::length(points[n].position - points[n - 1].position);
        const double away = glm::length(points[n].position - world);
        if (away < nearest) {
            nearest = away;
            place.along = place.length;
        }
    }
    return place;
}

}  // namespace

ColonOptions colonOptionsOf(const SceneOptions& options) {
    const VolumeOptions& volume = options.volume;
    ColonOptions colon;
    if (options.scene != "colon") colon.study = options.scene;
    colon.reading.series = volume.series;
    colon.reading.label = volume.label;
    colon.reading.resample = volume.resample;
    for (const std::string& seed : volume.seeds) colon.segmentation.seeds.push_back(seedFromText(seed));
    colon.centreline.reversed = volume.backwards;
    colon.isosurface = volume.isosurface;
    colon.isovalue = volume.isovalue;
    colon.transfer = volume.transfer;
    colon.opacity = volume.opacity;
    colon.cache = volume.cache;
    colon.up = upFromText(volume.up);
    return colon;
}

namespace {

// Keys turn clockwise, as the sun goes; --turn and harmonics the other way.
template <typename Sky>
void turnSky(Sky& sky, ViewScene& view) {
    view.turnsSky = true;
    view.sun = {std::remainder(-sky.turn().turn, 2 * std::numbers::pi), sky.turn().tilt};
    view.moveSun = [&sky](const SunPlace& to) { sky.turnTo({-to.azimuth, to.elevation}); };
}

template <typename Light>
void tellOf(Light& light, ViewScene& view) {
    view.seen = [&light](const EyeView& eye, const EyeImage& image) { light.seen(eye, image); };
    view.lightChanges = [&light] { return light.changes(); };
}

std::function<StereoFollower(const StereoSetting&)> followerWithin(const SeparationControl::Setting& limits) {
    return [limits](const StereoSetting& from) -> StereoFollower {
        SeparationControl control(limits, from.separation, from.zeroParallax);
        return [control](double free, double depth, double dt) mutable {
            // As far as a flight looks there is no wall: that tells nothing of what is behind it.
            if (free >= ColonFlight::kFarthestClearance) free = std::numeric_limits<double>::infinity();
            control.step(free, depth, dt);
            return StereoSetting{control.separation(), control.zeroParallax()};
        };
    };
}

// What is cast, from where, and the flight.
void setViews(const SceneOptions& options, SimdTarget simd, LoadedScene& scene) {
    const ColonScene& colon = *scene.colon;
    VolumeCasting casting;
    casting.target = simd;
    auto renderer = std::make_unique<VolumeRenderer>(colon.volume, casting);
    scene.simd = renderer->target();
    scene.renderer = std::move(renderer);
    scene.lens = colon.lens;
    scene.stereo = colon.stereo;
    adjustViews(options, scene);
    scene.startPose = colon.startPose;
    scene.path = colon.path;
    scene.frames = std::make_unique<CastFrames>(*scene.renderer);
    scene.methods = methodsFor(*scene.renderer);
    std::erase(scene.methods, RightEyeMethod::Cubic);
    const double largest = separationOf(scene).largest;
    scene.makeFlight = [&colon, largest] { return flightThrough(colon, largest); };
    scene.makeFollower = followerWithin(separationOf(scene));
    scene.clearanceAt = [free = freeDistanceOf(colon), largest](const Pose& head) {
        return clearanceAt(free, head, largest);
    };
    scene.eyesFollow = colon.isColon() && followsRoom(options);
}

}  // namespace

LoadedScene loadColonScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    checkAmbientLight(options.volume);
    LoadedScene scene;
    scene.name = options.scene;
    scene.colon = std::make_unique<ColonScene>(loadColon(colonOptionsOf(options), progress));
    checkShading(options.volume, *scene.colon);
    scene.sky = applyVolumeLight(options, *scene.colon, progress);
    applyAmbient(options.volume, nullptr, *scene.colon, progress);
    scene.modulateSigma = applyModulation(options.volume, nullptr, std::nullopt, *scene.colon, progress);
    if (scene.modulateSigma)
        scene.colon->notes.push_back(fmt::format("opacity modulated by {}, whole from {:.4g} on",
                                                 options.volume.modulate, *scene.modulateSigma));
    if (isLazyLight(options.light))
        scene.lazyLight = std::make_shared<LazyLight>(options, *scene.colon, progress);
    if (options.light == kTracedLight)
        scene.tracedLight = std::make_shared<TracedLight>(options, *scene.colon);
    if (options.volume.isovalue && scene.colon->isColon())
        throw Error("--isovalue", "", "expected with a volume seen from outside, this one is a colon",
                    "add --isosurface, or leave it out");
    setViews(options, simd, scene);
    return scene;
}

LoadedScene changedColonScene(const LoadedScene& now, const SceneOptions& made, const SceneOptions& options,
                              Progress& progress) {
    refuseWhatDoesNotApply(options);
    LoadedScene scene;
    scene.name = now.name;
    scene.colon = std::make_shared<ColonScene>(changedScene(*now.colon, colonOptionsOf(options), progress));
    scene.sky = now.sky;
    applyAmbient(options.volume, &made.volume, *scene.colon, progress);
    scene.modulateSigma =
        applyModulation(options.volume, &made.volume, now.modulateSigma, *scene.colon, progress);
    scene.lazyLight = now.lazyLight;
    setViews(options, now.simd, scene);
    scene.lens = now.lens;
    if (scene.lazyLight) scene.lazyLight->showSurface(scene.colon->volume.cells.isovalue);
    return scene;
}

void checkInLumen(const ColonScene& colon, const RecordedPath& path, const std::string& file) {
    if (!colon.isColon()) return;
    for (std::size_t n = 0; n < path.samples().size(); ++n) {
        const glm::dvec3& p = path.samples()[n].pose.position;
        if (!(colon.freeDistanceAt(p, colon.clearance) > 0))
            throw Error(file, fmt::format("pose {}", n + 1),
                        fmt::format("expected a place inside the colon, got {:.1f}, {:.1f}, {:.1f} mm",
                                    1000 * p.x, 1000 * p.y, 1000 * p.z),
                        "play flights that were recorded in this study");
    }
}

namespace {

// That of the options, and those that go by names.
void addTransfers(const VolumeOptions& options, ViewScene& view) {
    view.transfers = {""};
    for (const TransferPreset& preset : transferPresets()) {
        view.transfers.emplace_back(preset.name);
        if (options.transfer == preset.name) view.transfer = preset.name;
    }
}

void addAmbient(const LoadedScene& scene, const SceneOptions& options, ViewScene& view) {
    const VolumeOptions& volume = options.volume;
    const VolumeFrame& frame = scene.colon->volume.field.frame;
    const glm::dvec3 extent = glm::dvec3(frame.size) * frame.spacing;
    view.smallestRadius = std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    view.largestRadius = std::min(largestOcclusionRadius(frame), std::max({extent.x, extent.y, extent.z}));
    ViewAmbient ambient;
    ambient.lit = volume.ambient_mm.has_value();
    ambient.method = textOf(occlusionEstimateFromText(volume.ambientMethod));
    ambient.modulateRadius = std::min(modulationRadius(volume, frame), view.largestRadius);
    ambient.radius = ambient.lit ? *volume.ambient_mm / 1000 : ambient.modulateRadius;
    ambient.modulate = modulates(volume) ? volume.modulate : "";
    ambient.sigma = volume.modulateSigma.value_or(0);
    view.ambient = ambient;
    view.chosenSigma = scene.modulateSigma.value_or(0);
    if (!options.light.empty()) return;
    for (const OcclusionMethod method : {OcclusionMethod::Gaussian, OcclusionMethod::Reconstructed,
                                         OcclusionMethod::DrawnIn, OcclusionMethod::Chebyshev})
        view.ambientMethods.push_back(textOf(method));
    if (std::find(view.ambientMethods.begin(), view.ambientMethods.end(), ambient.method) ==
        view.ambientMethods.end())
        view.ambientMethods.push_back(ambient.method);
}

}  // namespace

void addVolume(const LoadedScene& scene, const SceneOptions& options, ViewScene& view) {
    const ColonScene& colon = *scene.colon;
    const ColonOptions colonOptions = colonOptionsOf(options);
    const SeparationControl::Setting separation = separationOf(scene);
    view.largestSeparation = separation.largest;
    view.makeFollower = scene.makeFollower ? scene.makeFollower : followerWithin(separation);
    if (scene.lazyLight) tellOf(*scene.lazyLight, view);
    if (scene.lazyLight && scene.lazyLight->turns()) turnSky(*scene.lazyLight, view);
    if (scene.sky) tellOf(*scene.sky, view);
    if (scene.sky) turnSky(*scene.sky, view);
    view.followsAtStart = followsRoom(options);
    view.canBeTranslucent = true;
    view.translucent = scene.renderer && scene.renderer->translucent();
    if (scene.renderer) addTransfers(options.volume, view);
    view.seeds = colonOptions.segmentation.seeds;
    view.readSlices = [colonOptions](Progress& progress) { return readSlices(colonOptions, progress); };
    if (colon.isColon()) {
        view.placeOnLine = [&colon](const glm::dvec3& world) {
            return placeOn(colon.centreline.points, world);
        };
        view.lumen = &colon.lumen.lumen;
    } else {
        const GreyVolume& field = colon.volume.field;
        const Range range = rangeOf(field);
        view.isovalue = colon.volume.cells.isovalue * field.scale + field.offset;
        view.isovalueStep = (range.highest - range.lowest) / kIsovalueSteps;
        if (scene.renderer) {
            view.largestSigma = std::max(0.5 * (range.highest - range.lowest), 1e-9);
            addAmbient(scene, options, view);
        }
    }
}

}  // namespace stereonav
