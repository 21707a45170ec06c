#include "app/scene/volume/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "app/scene/type/asked_views.h"
#include "app/scene/volume/slice_pieces.h"
#include "app/scene/volume/volume_loading.h"
#include "colon/flight/colon_flight.h"
#include "engine/base/error.h"
#include "engine/volume/open_distance.h"
#include "engine/volume/value_range.h"

namespace stereonav {
namespace {

constexpr double kAirSeen = -500;                   // HU: a study with smaller values is taken for CT
constexpr double kCtWidth = 1500, kCtLevel = -200;  // window that shows air, fat, tissue and bone

FreeDistance freeDistanceOf(const ColonScene& colon) {
    return [&colon](const glm::dvec3& world, double upTo) { return colon.freeDistanceAt(world, upTo); };
}

FreeDistance openDistanceOf(const ColonScene& colon) {
    const glm::dvec3& spacing = colon.volume.field.frame.spacing;
    const double tolerance = 0.05 * std::min({spacing.x, spacing.y, spacing.z});
    return [&colon, tolerance](const glm::dvec3& world, double upTo) {
        return openDistance(colon.volume.cells, world, upTo, tolerance);
    };
}

// Returns the limits of the eyes' separation that suit the scene. most: largest automatic separation, metres.
SeparationControl::Setting limitsOf(const StereoSetting& own, double most, double asked) {
    SeparationControl::Setting setting;
    setting.largest = std::max(std::min(2 * own.separation, most), asked);
    setting.largest = std::max(setting.largest, 1e-6 * own.zeroParallax);
    setting.smallest = std::min(setting.smallest, 0.1 * setting.largest);
    if (own.separation > 0) setting.share = own.separation / own.zeroParallax;
    return setting;
}

// Returns the box around the centres of the outermost voxels.
SceneBox boxOf(const VolumeFrame& frame) {
    SceneBox box{glm::dvec3(std::numeric_limits<double>::infinity()),
                 glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 end(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 place = frame.worldFromVoxel(end * glm::dvec3(frame.size - 1));
        box.low = glm::min(box.low, place);
        box.high = glm::max(box.high, place);
    }
    return box;
}

GreyVolume greyOf(const MaskVolume& mask) {
    GreyVolume grey(mask.frame);
    for (std::size_t n = 0; n < mask.frame.count(); ++n)
        if (mask.values[n] != 0) grey.values[n] = 1;  // zeros are there already, and occupy no memory
    return grey;
}

// Returns "L 12.3  P 4.5  S 100.2 mm": towards the patient's left (or right), back (or front) and head (or
// feet).
std::string patientText(const glm::dvec3& world) {
    const auto part = [](double metres, char towards, char away) {
        return fmt::format("{} {:.1f}", metres < 0 ? away : towards, std::abs(1000 * metres));
    };
    return fmt::format("{}  {}  {} mm", part(world.x, 'L', 'R'), part(world.y, 'P', 'A'),
                       part(world.z, 'S', 'I'));
}

}  // namespace

VolumeWorld::VolumeWorld(ColonScene colon, const SceneOptions& options)
    : mColon(std::move(colon)),
      mOptions(colonOptionsOf(options)),
      mSide(sideOf(mColon)),
      mFollows(!options.separation_m && !options.zeroParallax_m),
      mBox(boxOf(mColon.volume.field.frame)),
      mOutside{mBox.low, mBox.high} {
    mOptions.up = mColon.up;
}

void VolumeWorld::setViews(const SceneOptions& options, Scene& scene) {
    scene.lens = mColon.lens;
    scene.stereo = mColon.stereo;
    adjustViews(options, scene);
    scene.startPose = mColon.startPose;
    scene.path = mColon.path;
    mLimits = limitsOf(mColon.stereo, mSide->largestSeparation(), scene.stereo.separation);
}

// From outside a flight may come into the volume's box, up to the surface.
std::unique_ptr<Flight> VolumeWorld::makeFlight() const {
    ColonFlightSetting setting;
    setting.clearance = mColon.clearance;
    setting.speed = mColon.extent / mSide->crossingSeconds();
    setting.largestSeparation = mLimits.largest;
    try {
        return std::make_unique<ColonFlight>(
            mColon.isColon() ? freeDistanceOf(mColon) : openDistanceOf(mColon), mColon.centreline,
            mColon.startPose, setting);
    } catch (const Error&) {
        if (mLimits.largest <= 2 * mColon.stereo.separation) throw;
        throw Error("--separation", "",
                    fmt::format("there is no room around the start for eyes {:g} m apart", mLimits.largest),
                    "give less, or leave it out");
    }
}

StereoFollower VolumeWorld::makeFollower(const StereoSetting& from) const {
    SeparationControl control(mLimits, from.separation, from.zeroParallax);
    return [control](double free, double depth, double dt) mutable {
        // Without a wall within the range of a flight's search nothing is known of what lies behind.
        if (free >= ColonFlight::kFarthestClearance) free = std::numeric_limits<double>::infinity();
        control.step(free, depth, dt);
        return StereoSetting{control.separation(), control.zeroParallax()};
    };
}

double VolumeWorld::clearanceAt(const Pose& head) const {
    return stereonav::clearanceAt(freeDistanceOf(mColon), head, mLimits.largest);
}

std::shared_ptr<const SliceStudy> VolumeWorld::readSlices(Progress& progress) const {
    auto slices = std::make_shared<SliceStudy>();
    Progress reading(progress, 0, 0.7), judging(progress, 0.7, 1);
    if (mOptions.study.empty()) {
        slices->grey = builtInColon(mOptions.builtIn, reading).grey;
    } else {
        StudyOptions asked = mOptions.reading;
        asked.key = 0;  // 0: not asked for
        Study study = readStudy(mOptions.study, asked, reading);
        slices->ofMask = study.isMask;
        slices->grey = study.isMask ? greyOf(study.mask) : std::move(study.grey);
    }
    if (mSide->interior()) slices->pieces = slicePieces(*slices, mOptions.segmentation, judging);
    if (mOptions.up) turnUp(slices->grey.frame, *mOptions.up);
    const ValueSpan range = rangeOf(slices->grey);
    const bool ct = range.lowest <= kAirSeen;
    slices->windowWidth = ct ? kCtWidth : std::max(range.highest - range.lowest, 1e-9);
    slices->windowLevel = ct ? kCtLevel : 0.5 * (range.highest + range.lowest);
    progress.report(1, "read the slices");
    return slices;
}

Facts VolumeWorld::readPlace(const glm::dvec3& world) const {
    FactList list;
    const glm::dvec3 mm = 1000.0 * world;
    const FactNumbers numbers{mm.x, mm.y, mm.z};
    if (mOptions.up)
        list.both("place_mm", numbers, "place in the turned volume",
                  fmt::format("{:.1f} {:.1f} {:.1f} mm", mm.x, mm.y, mm.z), "mm");
    else
        list.both("place_mm", numbers,
                  "place in the study: left or right, posterior or anterior, superior or inferior",
                  patientText(world), "mm");
    if (const ColonInterior* const interior = mSide->interior()) {
        const PlaceOnLine place = interior->placeOnLine(world);
        list.both("along_mm", 1000 * place.along, "along the line, from its start",
                  fmt::format("{:.0f} mm along", 1000 * place.along), "mm");
    }
    return std::move(list.facts());
}

}  // namespace stereonav
