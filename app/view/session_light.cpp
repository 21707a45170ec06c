#include "app/view/session_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/capabilities.h"

namespace stereonav {

void SessionLight::reset() {
    mSun = mScene->sun;
    mModel = mScene->model;
}

void SessionLight::replaceScene(bool stays) {
    if (!stays) mSun = mScene->sun;
    mModel = mScene->model;
}

void SessionLight::place(const SunPlace& place) {
    if (mScene->scene->offered<TurningLight>()) mSun = place;
}

void SessionLight::choose(int model) {
    const auto* const models = mScene->scene->offered<LightModels>();
    if (models && model >= 0 && model < static_cast<int>(models->names().size())) mModel = model;
}

bool SessionLight::act(ViewCommand command) {
    constexpr double kDegree = std::numbers::pi / 180;
    switch (command) {
        case ViewCommand::LowerSun:
            turn(0, -kDegree);
            return true;
        case ViewCommand::HigherSun:
            turn(0, kDegree);
            return true;
        case ViewCommand::SunAnticlockwise:
            turn(-3 * kDegree, 0);
            return true;
        case ViewCommand::SunClockwise:
            turn(3 * kDegree, 0);
            return true;
        case ViewCommand::NextModel:
            nextModel();
            return true;
        default:
            return false;
    }
}

void SessionLight::turn(double azimuth, double elevation) {
    const auto* const light = mScene->scene->offered<TurningLight>();
    if (!light) {
        const std::string why = mScene->scene->whyLightStays();
        return mNotice.say(
            why.empty()
                ? "light turns over meshes, around media, and over terrain and volumes with baked transfer"
                : why);
    }
    constexpr double kTurn = 2 * std::numbers::pi, kLowestSun = -0.15;
    const double lowest = light->isSky() ? -0.25 * kTurn : kLowestSun;
    mSun.azimuth = std::fmod(mSun.azimuth + azimuth + kTurn, kTurn);
    mSun.elevation = std::clamp(mSun.elevation + elevation, lowest, 0.25 * kTurn);
    const auto degrees = [](double angle) { return std::round(angle * 360 / kTurn) + 0.0; };  // no -0
    mNotice.say(light->isSky()
                    ? fmt::format("sky turned by {:.0f} degrees, tilted by {:.0f}",
                                  degrees(std::remainder(-mSun.azimuth, kTurn)), degrees(mSun.elevation))
                    : fmt::format("sun at {:.0f} degrees, {:.0f} high", degrees(mSun.azimuth),
                                  degrees(mSun.elevation)));
}

void SessionLight::nextModel() {
    const auto* const models = mScene->scene->offered<LightModels>();
    if (!models || models->names().empty()) return mNotice.say("lighting models are for media");
    mModel = (mModel + 1) % static_cast<int>(models->names().size());
    mNotice.say("light: " + models->names()[static_cast<std::size_t>(mModel)]);
}

}  // namespace stereonav
