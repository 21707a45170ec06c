// The session's part that changes what is shown: a volume's surface and wall, light that turns, and the
// slices that seeds are set in.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/view_session.h"

namespace stereonav {

bool ViewSession::actOnVolume(ViewCommand command) {
    switch (command) {
        case ViewCommand::LowerIsovalue:
            moveIsovalue(-1);
            return true;
        case ViewCommand::HigherIsovalue:
            moveIsovalue(1);
            return true;
        case ViewCommand::ToggleTranslucent:
            if (!mScene->canBeTranslucent) return true;
            mTranslucent = !mTranslucent;
            mChange = SceneChange{mIsovalue, mTranslucent, std::nullopt};
            notify(mTranslucent ? "translucent" : "opaque");
            return true;
        default:
            return false;
    }
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
    if (!mScene->moveSun)
        return notify(mScene->lightStays.empty()
                          ? "light turns over terrain and volumes where it is baked so, and around media"
                          : mScene->lightStays);
    constexpr double kTurn = 2 * std::numbers::pi, kLowestSun = -0.15;
    const double lowest = mScene->turnsSky ? -0.25 * kTurn : kLowestSun;
    mSun.azimuth = std::fmod(mSun.azimuth + azimuth + kTurn, kTurn);
    mSun.elevation = std::clamp(mSun.elevation + elevation, lowest, 0.25 * kTurn);
    const auto degrees = [](double angle) { return std::round(angle * 360 / kTurn) + 0.0; };  // no -0
    notify(mScene->turnsSky
               ? fmt::format("sky turned by {:.0f} degrees, tilted by {:.0f}",
                             degrees(std::remainder(-mSun.azimuth, kTurn)), degrees(mSun.elevation))
               : fmt::format("sun at {:.0f} degrees, {:.0f} high", degrees(mSun.azimuth),
                             degrees(mSun.elevation)));
}

void ViewSession::moveIsovalue(double steps) {
    if (!mIsovalue) return;
    *mIsovalue += steps * mScene->isovalueStep;
    mChange = SceneChange{mIsovalue, mTranslucent, std::nullopt};
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
            mSlices.reset();
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
            mSlices->removeSeed();
            return true;
        case ViewCommand::FindAgain:
            mChange = SceneChange{std::nullopt, mTranslucent, mSlices->seeds()};
            notify(mSlices->seeds().empty() ? "looking for the colon again, without seeds"
                                            : "looking for the colon again, from the seeds");
            return true;
        default:
            return false;
    }
}

void ViewSession::openSlices() {
    if (mStudy) return showSlices(mStudy);
    if (!mScene->readSlices) return notify("there are no slices of a terrain");
    mStudyWished = true;
    notify("reading the slices");
}

bool ViewSession::takeStudyWish() {
    return std::exchange(mStudyWished, false);
}

void ViewSession::showSlices(std::shared_ptr<const SliceStudy> study) {
    mStudy = std::move(study);
    mSlices.emplace(mStudy, pose().position, mScene->seeds);
}

const Plane<PackedColor>& ViewSession::slicePicture(int width, int height) {
    mSliceWidth = width;
    mSliceHeight = height;
    return mSlices->picture(width, height, pose().position, mScene);
}

std::string ViewSession::click(double x, double y) {
    if (!mSlices) return "";
    const std::string text = mSlices->click(x, y, mSliceWidth, mSliceHeight);
    if (!text.empty()) notify(text);
    return text;
}

}  // namespace stereonav
