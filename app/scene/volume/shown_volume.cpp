#include "app/scene/volume/shown_volume.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <system_error>
#include <utility>

#include "app/options/refusals.h"
#include "app/scene/volume/ambient.h"
#include "app/scene/volume/coverage.h"
#include "app/scene/volume/light.h"
#include "app/scene/volume/studio.h"
#include "app/scene/volume/volume_facts.h"
#include "app/scene/volume/volume_loading.h"
#include "app/scene/volume/volume_type.h"
#include "colon/scene/transfer_presets.h"
#include "engine/volume/transfer_text.h"
#include "engine/volume/value_counts.h"
#include "engine/volume/value_range.h"

namespace stereonav {
namespace {

constexpr double kIsovalueSteps = 100;  // steps from the smallest value to the largest
constexpr double kAirOfCt = -500;       // HU: a volume with values as low is taken for CT
constexpr int kAddedBorder = 1;         // voxels added around a volume seen from outside
constexpr double kUsualOpacity = 0.95;  // opacity of a translucent wall per millimetre, as in Wan et al. 2004

void setTransfer(const SurfaceChange& change, const VolumeOptions& first, VolumeOptions& volume) {
    volume.transfer.clear();
    volume.opacity.reset();
    if (!change.translucent.value_or(false)) return;
    volume.transfer = change.transfer.value_or("");
    if (!volume.transfer.empty()) return;
    volume.transfer = first.transfer;
    volume.opacity = first.opacity;
    if (volume.transfer.empty() && !volume.opacity) volume.opacity = kUsualOpacity;
}

// Sets the ambient options; those without effect are removed, since they would be refused.
void setAmbientOptions(const AmbientChoice& to, bool translucent, const VolumeOptions& first,
                       VolumeOptions& volume) {
    const bool modulated = translucent && !to.modulate.empty();
    volume.ambient_mm.reset();
    volume.ambientStrength.reset();
    volume.ambientLamp.reset();
    volume.modulateRadius_mm.reset();
    volume.modulateSigma.reset();
    const bool estimates = to.lit || (modulated && to.modulate == "gradient");
    volume.ambientMethod =
        occlusionEstimateFromText(estimates ? to.method : "").value_or(OcclusionEstimate());
    volume.modulate = modulated ? modulationFromName(to.modulate) : Modulation::None;
    if (to.lit) {
        volume.ambient_mm = 1000 * to.radius;
        volume.ambientStrength = first.ambientStrength;
        volume.ambientLamp = first.ambientLamp;
    }
    if (modulated) volume.modulateRadius_mm = 1000 * to.modulateRadius;
    if (modulated && to.sigma > 0) volume.modulateSigma = to.sigma;
}

// Notes the present options as if the command line had given them, for later checks.
void noteWhatIsShown(const VolumeOptions& volume, GivenOptions& given) {
    const auto note = [&](const char* key, bool is, const std::string& text, double number) {
        given.forget(key);
        OptionValue value;
        value.text = text;
        value.numbers = {number};
        if (is) given.add(key, value, std::string("--") + key);
    };
    const auto number = [&](const char* key, const std::optional<double>& value) {
        note(key, value.has_value(), "", value.value_or(0));
    };
    number("isovalue", volume.isovalue);
    number("opacity", volume.opacity);
    number("ambient", volume.ambient_mm);
    number("ambient-strength", volume.ambientStrength);
    number("ambient-lamp", volume.ambientLamp);
    number("modulate-radius", volume.modulateRadius_mm);
    number("modulate-sigma", volume.modulateSigma);
    note("transfer", !volume.transfer.empty(), volume.transfer, 0);
    const bool estimates = volume.ambient_mm || volume.modulate == Modulation::Gradient;
    note("ambient-method", estimates, textOf(volume.ambientMethod), 0);
    note("modulate", volume.modulate != Modulation::None, nameOf(volume.modulate), 0);
}

// Returns the study's values; for a colon only around the lumen, since the cache has nothing else.
std::shared_ptr<const StudyValues> valuesOf(const ColonScene& colon) {
    auto values = std::make_shared<StudyValues>();
    values->range = colon.isColon() ? colon.valuesFound : rangeOf(colon.volume.field);
    if (values->range.lowest <= kAirOfCt) values->unit = "HU";
    auto field = std::make_shared<const GreyVolume>(colon.volume.field.share());
    std::shared_ptr<const MaskVolume> lumen;
    if (colon.isColon()) lumen = std::make_shared<const MaskVolume>(colon.lumen.lumen.share());
    values->count = [field = std::move(field), lumen = std::move(lumen)](Progress& progress) {
        return countValues(*field, lumen ? 0 : kAddedBorder, lumen.get(), progress);
    };
    return values;
}

VolumeCasting castingFor(SimdTarget target, const SceneOptions& options, const ColonScene& scene) {
    constexpr float kLeastCosine = 0.3f;  // folds have even edges, and are still darker there
    VolumeCasting casting;
    casting.target = target;
    casting.integrated = options.chosenLook;
    const bool lampAlone = options.volume.shading == Shading::Lamp && !options.light.given();
    if (options.chosenLook && lampAlone && scene.isColon()) casting.leastCosine = kLeastCosine;
    return casting;
}

}  // namespace

void applyChange(const SurfaceChange& change, const SceneOptions& first, SceneOptions& options) {
    VolumeOptions& volume = options.volume;
    if (change.isovalue) volume.isovalue = change.isovalue;
    if (change.translucent) setTransfer(change, first.volume, volume);
    if (change.ambient)
        setAmbientOptions(*change.ambient, change.translucent.value_or(false), first.volume, volume);
    noteWhatIsShown(volume, options.given);
}

ShownVolume::ShownVolume(LitVolume volume, const SceneOptions& first, const SceneOptions& made,
                         SimdTarget target, const ShownValues* before)
    : mFirst(first),
      mMade(made),
      mWorld(std::move(volume.world)),
      mLighting(std::move(volume.light)),
      mRenderer(mWorld->colon().volume, castingFor(target, made, mWorld->colon())),
      mFrames(mRenderer, RightEyeMethod::Cubic) {
    mWorld->setViews(made, *this);
    mWorld->setWall(&mRenderer);
    simd = mRenderer.target();
    mRays = {&mRenderer};
    setValues(before);
    setChoices();
    warning = mWorld->colon().warning;
    offer(mRays);
    offer(mChoices);
    offer(std::as_const(mValues));
    setLimits();
    offer(std::as_const(mLimits));
    mWorld->offerAll([this](auto& capability) { offer(capability); });
    if (mLighting.traced) offer<PictureLight>(*mLighting.traced);
    offerLight();
    offerPaint();
}

void ShownVolume::setPaint(std::vector<std::shared_ptr<const EyePainter>> painters) {
    mPainters = std::move(painters);
    mPaint.set(mPainters);
}

// Offers paint only where the surface is opaque: a translucent volume has no single surface to paint.
void ShownVolume::offerPaint() {
    const ColonInterior* const inside = mWorld->side().interior();
    if (!inside || mRenderer.translucent()) return;
    mWall = std::make_unique<VolumeCoverage>(mWorld->colon(), *inside, mWorld->wall());
    offer(mPaint);
    offer(*mWall);
}

FrameMaker& ShownVolume::frames() const {
    return mFrames;
}

std::unique_ptr<Flight> ShownVolume::makeFlight() const {
    return mWorld->makeFlight();
}

void ShownVolume::check(const RecordedPath& flight, const std::string& file) const {
    mWorld->check(flight, file);
}

void ShownVolume::offerLight() {
    if (!mLighting.lazy && !mLighting.sky) return;
    mLight = std::make_unique<SeenVolumeLight>(mLighting.lazy, mLighting.sky);
    offer<SeenLight>(*mLight);
    if (mLight->turns()) offer<TurningLight>(*mLight);
}

void ShownVolume::setValues(const ShownValues* before) {
    const ColonScene& colon = mWorld->colon();
    mValues.function = colon.volume.look.transfer;
    if (before) {
        mValues.values = before->values;
        mValues.begun = before->begun;
        return;
    }
    mValues.values = valuesOf(colon);
    BegunSurface& begun = mValues.begun;
    begun.isovalue = mWorld->side().movableIsovalue();
    begun.isovalueChosen = !mFirst.volume.isovalue;
    begun.translucent = mRenderer.translucent();
    begun.transfer = mFirst.volume.transfer;
    begun.opacity = mFirst.volume.opacity.value_or(kUsualOpacity);
}

void ShownVolume::setChoices() {
    mChoices.translucent = mRenderer.translucent();
    mChoices.transfers = {""};  // the transfer function of the options, then those with names
    for (const TransferPreset& preset : transferPresets()) {
        mChoices.transfers.emplace_back(preset.name);
        if (mMade.volume.transfer == preset.name) mChoices.transfer = preset.name;
    }
    if (const ColonScene& colon = mWorld->colon(); colon.counts) {
        mChoices.empty = emptyPresets(*colon.counts, colon.kinds);
        mChoices.holds = colon.kinds.text();
    }
    if (isCurveText(mMade.volume.transfer)) mChoices.transfer = mMade.volume.transfer;
    mChoices.changed = [this](const SurfaceChange& change, Progress& progress) {
        return changed(change, progress);
    };
    mChoices.isovalue = mWorld->side().movableIsovalue();
    if (!mChoices.isovalue) return;
    const ValueSpan& range = mValues.values->range;
    mChoices.isovalueStep = (range.highest - range.lowest) / kIsovalueSteps;
    mChoices.largestSigma = std::max(0.5 * (range.highest - range.lowest), 1e-9);
    setAmbient();
}

// Sets what of the options for studies this one refuses when it is read: the window offers the rest.
void ShownVolume::setLimits() {
    const ColonScene& colon = mWorld->colon();
    const bool inside = mWorld->side().interior() != nullptr, mask = colon.maskSmoothed.has_value();
    const auto refuse = [this](std::initializer_list<const char*> keys) {
        for (const char* const key : keys) mLimits.refused.emplace_back(key, "");
    };
    std::error_code code;
    if (!std::filesystem::is_directory(mFirst.scene, code)) refuse({"series"});
    if (!mask) refuse({"label", "mask-smoothing"});
    if (inside) {
        // A colon's wall stays where it was found, and light from outside never reaches it.
        refuse({"isovalue", "up", "ambient", "ambient-method", "ambient-strength", "ambient-lamp", "modulate",
                "modulate-radius", "modulate-sigma"});
        for (const char* const word : {"lambert-shadows", "phong-shadows"})
            mLimits.refused.emplace_back("shading", word);
        mLimits.refused.emplace_back("light", "lazy-transfer");
        if (mask) refuse({"fluid"});
        return;
    }
    refuse({"seed", "include", "exclude", "backwards", "fluid", "paint"});
    // A little less than the values' range, since the window rounds to six digits.
    const ValueSpan& range = mValues.values->range;
    const double least =
        1e-5 * std::max({std::abs(range.lowest), std::abs(range.highest), range.highest - range.lowest});
    if (range.highest - range.lowest > 2 * least)
        mLimits.ranges["isovalue"] = within(range.lowest + least, range.highest - least);
}

void ShownVolume::setAmbient() {
    const VolumeOptions& volume = mMade.volume;
    const VolumeFrame& frame = mWorld->colon().volume.field.frame;
    const glm::dvec3 extent = glm::dvec3(frame.size) * frame.spacing;
    SurfaceChoices& to = mChoices;
    to.smallestRadius = std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    to.largestRadius = std::min(largestOcclusionRadius(frame), std::max({extent.x, extent.y, extent.z}));
    AmbientChoice ambient;
    ambient.lit = volume.ambient_mm.has_value();
    ambient.method = textOf(volume.ambientMethod);
    ambient.modulateRadius = std::min(modulationRadius(volume, frame), to.largestRadius);
    ambient.radius = ambient.lit ? *volume.ambient_mm / 1000 : ambient.modulateRadius;
    ambient.modulate = modulates(volume) ? nameOf(volume.modulate) : "";
    ambient.sigma = volume.modulateSigma.value_or(0);
    to.ambient = ambient;
    to.chosenSigma = mLighting.modulateSigma.value_or(0);
    if (mMade.light.given()) return;
    for (const OcclusionMethod method : {OcclusionMethod::Gaussian, OcclusionMethod::Reconstructed,
                                         OcclusionMethod::DrawnIn, OcclusionMethod::Chebyshev})
        to.ambientMethods.push_back(textOf(method));
    if (std::find(to.ambientMethods.begin(), to.ambientMethods.end(), ambient.method) ==
        to.ambientMethods.end())
        to.ambientMethods.push_back(ambient.method);
}

// Makes the changed scene. It shares large data that stay valid with this one; light that is computed during
// the flight goes on.
std::shared_ptr<Scene> ShownVolume::changed(const SurfaceChange& change, Progress& progress) const {
    SceneOptions options = mMade;
    applyChange(change, mFirst, options);
    refuseWhatDoesNotApply(options, volumeType().optionsFor(options.scene) & ~scene_type::kMedia);
    Progress changing(progress, 0, 0.5), occluding(progress, 0.5, 0.7), modulating(progress, 0.7, 0.9),
        standing(progress, 0.9, 1);
    LitVolume made;
    made.world = std::make_unique<VolumeWorld>(
        changedScene(mWorld->colon(), colonOptionsOf(options), changing), options);
    ColonScene& colon = made.world->colon();
    made.light = mLighting;
    made.light.traced = nullptr;  // for pictures only
    applyAmbient(options.volume, &mMade.volume, colon, occluding);
    made.light.modulateSigma =
        applyModulation(options.volume, &mMade.volume, mLighting.modulateSigma, colon, modulating);
    applyStudio(options, &mWorld->colon(), colon, standing);
    progress.report(1, "changed");
    const float isovalue = colon.volume.cells.isovalue;
    auto scene =
        std::make_shared<ShownVolume>(std::move(made), mFirst, options, mRenderer.target(), &mValues);
    scene->name = name;
    scene->lens = lens;
    scene->setPaint(mPainters);
    scene->mChoices.ambientMethods = mChoices.ambientMethods;  // an estimate that was given stays in the list
    if (mLighting.lazy) mLighting.lazy->showSurface(isovalue);
    return scene;
}

Facts ShownVolume::describe() const {
    return {factForJson("volume", factsOfVolume(*this))};
}

std::string ShownVolume::whyLightStays() const {
    if (mLight && mLight->turns()) return "";
    if (!mMade.light.given()) return "a lamp lights this volume: --light gives a sky that turns";
    if (mMade.light.kind == LightChoice::Kind::Lazy)
        return "the sky is part of this light: --light lazy-transfer has one that turns";
    return "the sky is baked into this light: bake --what transfer for one that turns";
}

}  // namespace stereonav
