#include "app/view/kept_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/view/raised_ground.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kName = "as it was left";
constexpr std::string_view kMode = "mode=", kOneEye = "one-eye=", kFlight = "flight=";

// Returns the value of the line that begins with `key`; "" where there is none.
std::string lineOf(const std::string& settings, std::string_view key) {
    std::size_t at = 0;
    while (at < settings.size()) {
        const std::size_t end = std::min(settings.find('\n', at), settings.size());
        const std::string_view line = std::string_view(settings).substr(at, end - at);
        if (line.starts_with(key)) return std::string(line.substr(key.size()));
        at = end + 1;
    }
    return "";
}

std::string linesOf(const ShownMode& mode) {
    return fmt::format("{}{}\n", mode.stereo ? kMode : kOneEye, infoOf(mode.mode).shortName);
}

// Returns the names of the ways to fly. One file has places inside and outside: a study as a colon, which is
// flown through, and as a surface that is seen from outside.
std::string flightNames(const ViewSession& session) {
    const Flight& flight = session.flight();
    std::string names;
    for (int n = 0; n < flight.modeCount(); ++n) names += fmt::format("{};", flight.modeName(n));
    return names;
}

// Returns the eyes where somebody has set them; others are fitted or follow again.
std::optional<StereoSetting> eyesByHand(const ViewSession& session) {
    const ViewStereo& eyes = session.eyes();
    const bool fitted = session.followsClearance() || eyes.fits() || eyes.fitted();
    if (fitted || session.eyesWanted() == eyes.begun(*session.open().scene)) return std::nullopt;
    return session.eyesWanted();
}

}  // namespace

std::filesystem::path KeptView::viewsFolder() {
    const std::filesystem::path data = dataFolder();
    return data.empty() ? data : data / "views";
}

KeptView::KeptView(const std::string& scene, const std::filesystem::path& folder) : mViews(scene, folder) {}

std::optional<ShownMode> KeptView::mode() const {
    const Bookmark* const view = mViews.find(kName);
    if (!view) return std::nullopt;
    for (const bool stereo : {true, false})
        if (const auto mode = outputModeFromName(lineOf(view->settings, stereo ? kMode : kOneEye)))
            return ShownMode{*mode, stereo};
    return std::nullopt;
}

bool KeptView::restore(ViewSession& session) const {
    const Bookmark* const view = mViews.find(kName);
    if (!view || lineOf(view->settings, kFlight) != flightNames(session)) return false;
    const Pose here = session.pose(), pose = placeNow(*view, *session.open().scene).pose;
    const bool elsewhere = pose.position != here.position || pose.orientation != here.orientation;
    if (elsewhere) session.goTo(pose);
    if (view->stereo && !session.followsClearance()) session.setEyes(*view->stereo);
    return elsewhere;
}

void KeptView::keep(const ViewSession& session, const std::optional<ShownMode>& mode) {
    const std::optional<ShownMode> shown = mode ? mode : this->mode();
    Bookmark view;
    view.name = kName;
    view.pose = session.pose();
    view.settings = groundSettings(*session.open().scene) +
                    fmt::format("{}{}\n", kFlight, flightNames(session)) + (shown ? linesOf(*shown) : "");
    view.stereo = eyesByHand(session);
    try {
        mViews.remove(kName);
        mViews.add(view);
    } catch (const Error&) {
        // A place beyond what can be kept: the scene begins at its start again.
    }
}

}  // namespace stereonav
