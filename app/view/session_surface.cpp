#include "app/view/session_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/text/length_text.h"

namespace stereonav {

SessionSurface::SessionSurface(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice)
    : mScene(scene), mNotice(notice) {
    take();
    if (const SurfaceChoices* const surface = choices()) mTriedTransfer = surface->transfer;
}

void SessionSurface::take() {
    const SurfaceChoices* const surface = choices();
    mIsovalue = surface ? surface->isovalue : std::nullopt;
    mTranslucent = surface && surface->translucent;
    mTransfer = surface ? surface->transfer : "";
    mAmbient = surface ? surface->ambient : std::nullopt;
}

bool SessionSurface::act(ViewCommand command) {
    switch (command) {
        case ViewCommand::LowerIsovalue:
            moveIsovalue(-1);
            return true;
        case ViewCommand::HigherIsovalue:
            moveIsovalue(1);
            return true;
        case ViewCommand::ToggleTranslucent:
            if (!choices()) return true;
            mTranslucent = !mTranslucent;
            askForChange();
            mNotice.say(mTranslucent ? "translucent" : "opaque");
            return true;
        case ViewCommand::NextTransfer:
            nextTransfer();
            return true;
        default:
            return actOnAmbient(command);
    }
}

bool SessionSurface::actOnAmbient(ViewCommand command) {
    constexpr double kStep = 1.25;  // factor on radius and sigma per key press
    const auto act = [&](const auto& what) {
        if (mAmbient)
            what();
        else
            mNotice.say("ambient light needs a volume seen from outside");
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

void SessionSurface::askForChange() {
    mChange.emplace().surface = now();
}

SurfaceChange SessionSurface::now() const {
    SurfaceChange now;
    now.isovalue = mIsovalue;
    now.translucent = mTranslucent;
    now.transfer = mTransfer;
    now.ambient = mAmbient;
    return now;
}

void SessionSurface::set(const SurfaceChange& surface) {
    if (!choices()) return;
    if (surface.isovalue && mIsovalue) mIsovalue = surface.isovalue;
    if (surface.translucent) mTranslucent = *surface.translucent;
    if (surface.transfer) mTransfer = mTriedTransfer = *surface.transfer;
    if (surface.ambient && mAmbient) mAmbient = surface.ambient;
    askForChange();
}

void SessionSurface::forgetChange() {
    if (mChange) return;  // another change was asked for meanwhile
    const std::optional<AmbientChoice> before = mAmbient;
    take();
    if (!before || !mAmbient) return;
    // A radius that is not in use is kept for later.
    if (!mAmbient->lit) mAmbient->radius = before->radius;
    if (mAmbient->modulate.empty() && !mAmbient->lit) mAmbient->modulateRadius = before->modulateRadius;
}

void SessionSurface::nextTransfer() {
    const SurfaceChoices* const surface = choices();
    if (!surface || surface->transfers.empty()) return;
    const std::vector<std::string>& all = surface->transfers;
    const auto at = std::find(all.begin(), all.end(), mTriedTransfer);
    const auto isEmpty = [&](const std::string& name) {
        return std::find(surface->empty.begin(), surface->empty.end(), name) != surface->empty.end();
    };
    std::string leftOut;
    // A surface that is opaque is first shown with the present function.
    if (mTranslucent) {
        std::size_t next = at == all.end() ? all.size() - 1 : static_cast<std::size_t>(at - all.begin());
        for (std::size_t tried = 0; tried < all.size(); ++tried) {
            next = (next + 1) % all.size();
            if (!isEmpty(all[next])) break;
            leftOut += (leftOut.empty() ? "" : ", ") + all[next];
        }
        mTransfer = all[next];
    }
    mTriedTransfer = mTransfer;
    mTranslucent = true;
    askForChange();
    std::string notice = "transfer function: " + (mTransfer.empty() ? "that of the options" : mTransfer);
    if (!leftOut.empty()) notice += fmt::format(" ({} left out: nothing of {})", leftOut, surface->holds);
    mNotice.say(notice);
}

// Steps through off and each method.
void SessionSurface::stepAmbient(int by) {
    const std::vector<std::string>& methods = choices()->ambientMethods;
    if (methods.empty()) return mNotice.say("baked light takes the place of ambient light");
    const auto count = static_cast<int>(methods.size()) + 1;
    const auto now = std::find(methods.begin(), methods.end(),
                               mAmbient->method.empty() ? methods.front() : mAmbient->method);
    const int at = mAmbient->lit ? static_cast<int>(now - methods.begin()) % (count - 1) + 1 : 0;
    const int next = (at + by + count) % count;
    // Opacity may be modulated by the same method: the one before ambient light is restored.
    if (!mAmbient->lit) mMethodUnlit = mAmbient->method;
    mAmbient->lit = next > 0;
    mAmbient->method = next > 0 ? methods[static_cast<std::size_t>(next - 1)] : mMethodUnlit;
    askForChange();
    mNotice.say(mAmbient->lit ? ambientText() : "the lamp in place of ambient light");
}

void SessionSurface::scaleRadius(double factor) {
    const bool modulated = mTranslucent && !mAmbient->modulate.empty();
    if (!mAmbient->lit && !modulated)
        return mNotice.say("the radius is for ambient light (O) and modulated opacity (B)");
    double& radius = mAmbient->lit ? mAmbient->radius : mAmbient->modulateRadius;
    const bool together = mAmbient->lit && mAmbient->modulateRadius == mAmbient->radius;
    const double wanted = std::clamp(radius * factor, choices()->smallestRadius, choices()->largestRadius);
    if (wanted == radius)
        return mNotice.say(
            fmt::format("{} is as {} as it can be", lengthText(radius), factor < 1 ? "small" : "large"));
    radius = wanted;
    if (together) mAmbient->modulateRadius = wanted;
    askForChange();
    mNotice.say(mAmbient->lit ? ambientText() : modulationText());
}

void SessionSurface::nextModulation() {
    if (!mTranslucent) return mNotice.say("modulated opacity needs a translucent volume: T");
    std::string& by = mAmbient->modulate;
    by = by.empty() ? "variance" : by == "variance" ? "gradient" : "";
    mAmbient->sigma = 0;
    askForChange();
    mNotice.say(by.empty() ? "opacity as in the transfer function" : "opacity by " + by);
}

void SessionSurface::scaleSigma(double factor) {
    if (!mTranslucent || mAmbient->modulate.empty() || !(sigmaNow() > 0))
        return mNotice.say("the threshold is for modulated opacity: B");
    const double most = mAmbient->modulate == "gradient" ? 1.0 : choices()->largestSigma;
    mAmbient->sigma = std::clamp(sigmaNow() * factor, most * 1e-6, most);
    askForChange();
    mNotice.say(modulationText());
}

double SessionSurface::sigmaNow() const {
    return mAmbient->sigma > 0 ? mAmbient->sigma : choices()->chosenSigma;
}

std::string SessionSurface::ambientText() const {
    return fmt::format("ambient light {} within {}", mAmbient->method.empty() ? "gaussian" : mAmbient->method,
                       lengthText(mAmbient->radius));
}

std::string SessionSurface::modulationText() const {
    std::string text =
        fmt::format("opacity by {} within {}", mAmbient->modulate, lengthText(mAmbient->modulateRadius));
    if (sigmaNow() > 0) text += fmt::format(", whole from {:.3g}", sigmaNow());
    return text;
}

void SessionSurface::moveIsovalue(double steps) {
    if (!mIsovalue) return;
    *mIsovalue += steps * choices()->isovalueStep;
    askForChange();
    mNotice.say(fmt::format("surface at {:.6g}", *mIsovalue));
}

void SessionSurface::askForPieces(const PieceChoices& pieces) {
    askForChange();
    mChange->surface.isovalue.reset();
    mChange->pieces = pieces;
}

}  // namespace stereonav
