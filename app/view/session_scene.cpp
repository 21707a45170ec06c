// The session's part that changes what is shown: another scene in its place, a volume's surface and wall,
// light that turns, and the slices that pieces are chosen in.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/output/length_text.h"
#include "app/view/live_settings.h"
#include "app/view/raised_ground.h"
#include "app/view/session.h"
#include "app/view/status.h"

namespace stereonav {
namespace {

PieceChoices choicesOf(const Scene& scene) {
    const auto* const source = scene.offered<SliceSource>();
    return source ? source->pieceChoices() : PieceChoices{};
}

}  // namespace

void ViewSession::takeSurface() {
    const auto* const surface = offered<SurfaceChoices>();
    mIsovalue = surface ? surface->isovalue : std::nullopt;
    mTranslucent = surface && surface->translucent;
    mTransfer = surface ? surface->transfer : "";
    mAmbient = surface ? surface->ambient : std::nullopt;
}

void ViewSession::replaceScene(std::shared_ptr<const OpenScene> scene) {
    if (!scene->changed) stopPlaying();
    mGoal.reset();
    const auto raised = RaisedGround::between(shown(), *scene->scene);
    if (raised && recording()) saveFlight();  // of the ground as it was
    const Pose here = raised ? raised->moved(mFlight->pose()) : mFlight->pose();
    const int mode = mFlight->mode();
    std::unique_ptr<Flight> flight = scene->scene->makeFlight();
    if (mode < flight->modeCount()) flight->setMode(mode);
    flight->setPose(here);
    mFlight = std::move(flight);
    // Light that was turned stays so over the same study.
    const auto *const before = offered<TurningLight>(), *const after = scene->scene->offered<TurningLight>();
    const bool lightStays = before && after && before->isSky() == after->isSky();
    const bool methodStays = scene->changed && scene->way.method == mScene->way.method;
    if (choicesOf(shown()) != choicesOf(*scene->scene)) mPieceChoices.reset();
    mStereo.replaceScene(*scene->scene);
    keepPaint(shown(), *scene->scene);
    mScene = std::move(scene);
    if (mOwnPath) {
        takePath(shown().path, PathIs::InFile);
    } else if (raised) {
        stopPlaying();
        takePath(raised->moved(mPath), mPathIs);
        for (PathBefore& step : mPathsBefore) step.path = raised->moved(step.path);
    }
    if (!lightStays) mSun = mScene->sun;
    mModel = mScene->model;
    if (!methodStays) mMethod = mScene->way.method;
    // More may be asked for than a scene made in between shows.
    if (!mScene->changed) forgetSceneChange();
    mResting = false;
    mLooked = true;  // one step at least shows it
    ++mRequest.version;
}

std::optional<SceneChange> ViewSession::takeSceneChange() {
    return std::exchange(mChange, std::nullopt);
}

void ViewSession::forgetSceneChange() {
    if (mChange) return;  // asked for since
    const std::optional<AmbientChoice> before = mAmbient;
    takeSurface();
    if (!before || !mAmbient) return;
    // What is not shown keeps its radius for when it is.
    if (!mAmbient->lit) mAmbient->radius = before->radius;
    if (mAmbient->modulate.empty() && !mAmbient->lit) mAmbient->modulateRadius = before->modulateRadius;
}

bool ViewSession::actOnVolume(ViewCommand command) {
    switch (command) {
        case ViewCommand::LowerIsovalue:
            moveIsovalue(-1);
            return true;
        case ViewCommand::HigherIsovalue:
            moveIsovalue(1);
            return true;
        case ViewCommand::ToggleTranslucent:
            if (!offered<SurfaceChoices>()) return true;
            mTranslucent = !mTranslucent;
            askForChange();
            notify(mTranslucent ? "translucent" : "opaque");
            return true;
        case ViewCommand::NextTransfer:
            nextTransfer();
            return true;
        default:
            return actOnAmbient(command);
    }
}

bool ViewSession::actOnAmbient(ViewCommand command) {
    constexpr double kStep = 1.25;  // of radius and sigma, a key press
    const auto act = [&](const auto& what) {
        if (mAmbient)
            what();
        else
            notify("openness lights volumes that are seen from outside, and takes their opacity");
        return true;
    };
    switch (command) {
        case ViewCommand::NextAmbient:
            return act([&] { stepAmbient(1); });
        case ViewCommand::PreviousAmbient:
            return act([&] { stepAmbient(-1); });
        case ViewCommand::SmallerRadius:
            return act([&] { scaleRadius(1 / kStep); });
        case ViewCommand::LargerRadius:
            return act([&] { scaleRadius(kStep); });
        case ViewCommand::NextModulation:
            return act([&] { nextModulation(); });
        case ViewCommand::LessSigma:
            return act([&] { scaleSigma(1 / kStep); });
        case ViewCommand::MoreSigma:
            return act([&] { scaleSigma(kStep); });
        default:
            return false;
    }
}

void ViewSession::askForChange() {
    SceneChange& change = mChange.emplace();
    change.surface.isovalue = mIsovalue;
    change.surface.translucent = mTranslucent;
    change.surface.transfer = mTransfer;
    change.surface.ambient = mAmbient;
}

SurfaceChange ViewSession::surface() const {
    SurfaceChange now;
    now.isovalue = mIsovalue;
    now.translucent = mTranslucent;
    now.transfer = mTransfer;
    now.ambient = mAmbient;
    return now;
}

void ViewSession::setSurface(const SurfaceChange& surface) {
    if (!offered<SurfaceChoices>()) return;
    if (surface.isovalue && mIsovalue) mIsovalue = surface.isovalue;
    if (surface.translucent) mTranslucent = *surface.translucent;
    if (surface.transfer) mTransfer = mTriedTransfer = *surface.transfer;
    if (surface.ambient && mAmbient) mAmbient = surface.ambient;
    askForChange();
}

void ViewSession::nextTransfer() {
    const auto* const surface = offered<SurfaceChoices>();
    if (!surface || surface->transfers.empty()) return;
    const std::vector<std::string>& all = surface->transfers;
    const auto at = std::find(all.begin(), all.end(), mTriedTransfer);
    // One that is opaque is first seen as it would be.
    if (mTranslucent) mTransfer = at == all.end() || at + 1 == all.end() ? all.front() : *(at + 1);
    mTriedTransfer = mTransfer;
    mTranslucent = true;
    askForChange();
    notify("transfer function: " + (mTransfer.empty() ? "that of the options" : mTransfer));
}

// Off, and then each method.
void ViewSession::stepAmbient(int by) {
    const std::vector<std::string>& methods = offered<SurfaceChoices>()->ambientMethods;
    if (methods.empty()) return notify("baked light takes the place of ambient light");
    const auto count = static_cast<int>(methods.size()) + 1;
    const auto now = std::find(methods.begin(), methods.end(),
                               mAmbient->method.empty() ? methods.front() : mAmbient->method);
    const int at = mAmbient->lit ? static_cast<int>(now - methods.begin()) % (count - 1) + 1 : 0;
    const int next = (at + by + count) % count;
    // Opacity may be modulated by the same: what held without ambient light holds again.
    if (!mAmbient->lit) mMethodUnlit = mAmbient->method;
    mAmbient->lit = next > 0;
    mAmbient->method = next > 0 ? methods[static_cast<std::size_t>(next - 1)] : mMethodUnlit;
    askForChange();
    notify(mAmbient->lit ? ambientText() : "the lamp in place of ambient light");
}

void ViewSession::scaleRadius(double factor) {
    const bool modulated = mTranslucent && !mAmbient->modulate.empty();
    if (!mAmbient->lit && !modulated)
        return notify("a radius is of ambient light (O), or of modulated opacity (B)");
    double& radius = mAmbient->lit ? mAmbient->radius : mAmbient->modulateRadius;
    const bool together = mAmbient->lit && mAmbient->modulateRadius == mAmbient->radius;
    const double wanted = std::clamp(radius * factor, offered<SurfaceChoices>()->smallestRadius,
                                     offered<SurfaceChoices>()->largestRadius);
    if (wanted == radius)
        return notify(
            fmt::format("{} is as {} as it can be", lengthText(radius), factor < 1 ? "near" : "far"));
    radius = wanted;
    if (together) mAmbient->modulateRadius = wanted;
    askForChange();
    notify(mAmbient->lit ? ambientText() : modulationText());
}

void ViewSession::nextModulation() {
    if (!mTranslucent) return notify("opacity is modulated where there is some: T makes it translucent");
    std::string& by = mAmbient->modulate;
    by = by.empty() ? "variance" : by == "variance" ? "gradient" : "";
    mAmbient->sigma = 0;
    askForChange();
    notify(by.empty() ? "opacity as the transfer function has it" : "opacity by " + by);
}

double ViewSession::sigmaNow() const {
    return mAmbient->sigma > 0 ? mAmbient->sigma : offered<SurfaceChoices>()->chosenSigma;
}

void ViewSession::scaleSigma(double factor) {
    if (!mTranslucent || mAmbient->modulate.empty() || !(sigmaNow() > 0))
        return notify("a sigma is of modulated opacity: B");
    const double most = mAmbient->modulate == "gradient" ? 1.0 : offered<SurfaceChoices>()->largestSigma;
    mAmbient->sigma = std::clamp(sigmaNow() * factor, most * 1e-6, most);
    askForChange();
    notify(modulationText());
}

std::string ViewSession::ambientText() const {
    return fmt::format("ambient light {} within {}", mAmbient->method.empty() ? "gaussian" : mAmbient->method,
                       lengthText(mAmbient->radius));
}

std::string ViewSession::modulationText() const {
    std::string text =
        fmt::format("opacity by {} within {}", mAmbient->modulate, lengthText(mAmbient->modulateRadius));
    if (sigmaNow() > 0) text += fmt::format(", whole from {:.3g}", sigmaNow());
    return text;
}

std::string ViewSession::volumeText() const {
    std::string text;
    if (mIsovalue) text += fmt::format("  surface at {:.6g}", *mIsovalue);
    if (mTranslucent && !mTransfer.empty()) text += "  " + mTransfer;
    if (mAmbient && mAmbient->lit) text += "  " + ambientText();
    if (mAmbient && mTranslucent && !mAmbient->modulate.empty()) text += "  " + modulationText();
    return text;
}

bool ViewSession::actOnSun(ViewCommand command) {
    constexpr double kDegree = std::numbers::pi / 180;
    switch (command) {
        case ViewCommand::LowerSun:
            turnSun(0, -kDegree);
            return true;
        case ViewCommand::HigherSun:
            turnSun(0, kDegree);
            return true;
        case ViewCommand::SunAnticlockwise:
            turnSun(-3 * kDegree, 0);
            return true;
        case ViewCommand::SunClockwise:
            turnSun(3 * kDegree, 0);
            return true;
        default:
            return false;
    }
}

void ViewSession::turnSun(double azimuth, double elevation) {
    const auto* const light = offered<TurningLight>();
    if (!light) {
        const std::string why = shown().whyLightStays();
        return notify(
            why.empty()
                ? "light turns over meshes, over terrain and volumes where it is baked so, and around media"
                : why);
    }
    constexpr double kTurn = 2 * std::numbers::pi, kLowestSun = -0.15;
    const double lowest = light->isSky() ? -0.25 * kTurn : kLowestSun;
    mSun.azimuth = std::fmod(mSun.azimuth + azimuth + kTurn, kTurn);
    mSun.elevation = std::clamp(mSun.elevation + elevation, lowest, 0.25 * kTurn);
    const auto degrees = [](double angle) { return std::round(angle * 360 / kTurn) + 0.0; };  // no -0
    notify(light->isSky()
               ? fmt::format("sky turned by {:.0f} degrees, tilted by {:.0f}",
                             degrees(std::remainder(-mSun.azimuth, kTurn)), degrees(mSun.elevation))
               : fmt::format("sun at {:.0f} degrees, {:.0f} high", degrees(mSun.azimuth),
                             degrees(mSun.elevation)));
}

void ViewSession::moveIsovalue(double steps) {
    if (!mIsovalue) return;
    *mIsovalue += steps * offered<SurfaceChoices>()->isovalueStep;
    askForChange();
    notify(fmt::format("surface at {:.6g}", *mIsovalue));
}

// --- slices

bool ViewSession::actOnSlices(ViewCommand command) {
    if (!mSlices) {
        if (command == ViewCommand::Slices) openSlices();
        return command == ViewCommand::Slices || command == ViewCommand::NextSlice ||
               command == ViewCommand::PreviousSlice || command == ViewCommand::RemoveSeed ||
               command == ViewCommand::FindAgain;
    }
    switch (command) {
        case ViewCommand::Quit:
            closeSlices();
            return true;
        case ViewCommand::Slices:
            mSlices->nextAxis(pose().position);
            return true;
        case ViewCommand::NextSlice:
            mSlices->turnPages(1);
            return true;
        case ViewCommand::PreviousSlice:
            mSlices->turnPages(-1);
            return true;
        case ViewCommand::RemoveSeed:
        case ViewCommand::TurnRound:
            mSlices->removeChoice();
            return true;
        case ViewCommand::FindAgain:
            askForChange();
            mChange->surface.isovalue.reset();
            mChange->pieces = mSlices->choices();
            notify(mSlices->choices().empty() ? "looking for the colon again, without changes"
                                              : "looking for the colon again, with the changes");
            return true;
        default:
            return false;
    }
}

void ViewSession::openSlices() {
    if (mStudy) return showSlices(mStudy);
    if (!offered<SliceSource>()) return notify("there are no slices of a terrain");
    mStudyWished = mSliceViewWished = true;
    notify("reading the slices");
}

void ViewSession::wishStudy() {
    if (!mStudy && offered<SliceSource>()) mStudyWished = true;
}

bool ViewSession::takeStudyWish() {
    return std::exchange(mStudyWished, false);
}

void ViewSession::showSlices(std::shared_ptr<const SliceStudy> study) {
    mStudy = std::move(study);
    mSliceViewWished = false;
    mSlices.emplace(mStudy, pose().position, mPieceChoices ? *mPieceChoices : choicesOf(shown()));
}

// What was chosen in it and not looked for yet is there again when it is opened.
void ViewSession::closeSlices() {
    mPieceChoices.reset();
    if (mSlices->choices() != choicesOf(shown())) mPieceChoices = mSlices->choices();
    mSlices.reset();
}

const Plane<PackedColor>& ViewSession::slicePicture(int width, int height) {
    mSliceWidth = width;
    mSliceHeight = height;
    return mSlices->picture(width, height, pose().position, mScene);
}

std::string ViewSession::click(double x, double y) {
    if (!mSlices) return "";
    const std::string text = mSlices->click(x, y, mSliceWidth, mSliceHeight, *mScene);
    if (!text.empty()) notify(text);
    return text;
}

}  // namespace stereonav
