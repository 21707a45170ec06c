#include "app/view/panel/sun_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "app/view/panel/controls.h"
#include "app/view/panel/ground_paint_panel.h"

namespace stereonav {
namespace {

constexpr double kPlaceDegree = std::numbers::pi / 180;
constexpr double kNoNorth = 0.0005 * kPlaceDegree;  // smaller angles are not shown

// Returns the option for the sun's place; one that takes effect at once is preferred.
const Option* sunOption(const SceneChanges& changes) {
    if (!changes.scene()) return nullptr;
    const Option *const sun = viewOption("sun"), *const light = viewOption("light-from");
    const bool ofSun = sun && changes.settings().applies(*sun);
    // True for ground that is shown as a medium; clouds have no sun by date.
    const bool ofGround = ofSun || changes.scene()->scene->offered<OnEarth>();
    const bool ofLight = light && changes.settings().applies(*light) && ofGround;
    if (ofLight && (!ofSun || (changes.live(*light) && !changes.live(*sun)))) return light;
    return ofSun ? sun : nullptr;
}

// Handles a text field: the text is used when it is finished; invalid text is dropped.
template <typename Take>
bool typed(const char* id, const char* hint, std::string& writing, const std::string& now, const Take& take) {
    std::string text = writing.empty() ? now : writing;
    ImGui::InputTextWithHint(id, hint, &text);
    if (ImGui::IsItemActive()) {
        writing = text;
        return false;
    }
    writing.clear();
    return ImGui::IsItemDeactivatedAfterEdit() && text != now && take(text);
}

bool angleControl(const char* label, double& radians, double most, const char* tip) {
    double degrees = radians / kPlaceDegree;
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    const bool moved =
        ImGui::DragScalar(label, ImGuiDataType_Double, &degrees, 0.05f, nullptr, nullptr, "%.3f");
    tooltip(tip);
    if (moved && std::isfinite(degrees)) radians = std::clamp(degrees, -most, most) * kPlaceDegree;
    return moved;
}

}  // namespace

bool SunPanel::has(const SceneChanges& changes) {
    return sunOption(changes) != nullptr;
}

// Uses the middle of the scene, so that the place stays the same in flight.
void SunPanel::look(ViewSession& session) {
    const auto& scene = session.openShared();
    if (mScene.lock() == scene && mClock) return;
    mScene = scene;
    mTold.reset();
    mNorth = 0;
    const auto* const box = scene->scene->offered<SceneBox>();
    const auto* const earth = scene->scene->offered<OnEarth>();
    std::optional<PlaceOnEarth> place;
    if (earth && box) {
        const glm::dvec3 middle = 0.5 * (box->low + box->high);
        place = earth->placeAt(middle);
        if (place) mNorth = earth->northAt(middle);
    }
    // Settings are kept where the same ground was read again; typed places are always kept.
    const bool first = !mClock || place.has_value() != mOnEarth ||
                       (place && (std::abs(place->latitude - mClock->place.latitude) > kPlaceDegree ||
                                  std::abs(place->longitude - mClock->place.longitude) > kPlaceDegree));
    mOnEarth = place.has_value();
    if (first) {
        const auto now = std::chrono::system_clock::now().time_since_epoch();
        mClock = clockAt(std::chrono::duration<double>(now).count(), place.value_or(PlaceOnEarth{}));
    } else if (place) {
        mClock->place = *place;
    }
}

bool SunPanel::drawClock() {
    SunClock& clock = *mClock;
    const float font = ImGui::GetFontSize();
    bool changed = false;
    const auto take = [&](const std::optional<SunClock>& next) {
        if (next) clock = *next;
        return next.has_value();
    };
    ImGui::SetNextItemWidth(6.2f * font);
    changed |= typed("##date", "2024-06-21", mDate, dateText(clock),
                     [&](const std::string& text) { return take(withDate(clock, text)); });
    tooltip("The date by the local clock, year-month-day.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(3.6f * font);
    changed |= typed("##time", "12:00", mTime, timeText(clock.hour),
                     [&](const std::string& text) { return take(withTime(clock, text)); });
    tooltip("The time by the local clock, hour:minute.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const double before = clock.offset;
    if (ImGui::DragScalar("##offset", ImGuiDataType_Double, &clock.offset, 0.02f, nullptr, nullptr,
                          "UTC%+.2f"))
        clock.offset = std::round(4 * tidy(clock).offset) / 4;
    changed |= clock.offset != before;
    tooltip("Hours that the local clock is ahead of UTC, in steps of a quarter; 0 shows UTC.");
    ImGui::SetNextItemWidth(-FLT_MIN);
    changed |= ImGui::SliderInt("##day", &clock.day, 1, daysIn(clock.year), "day %d of the year");
    tooltip("The day of the year.");
    float hour = static_cast<float>(clock.hour);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##hour", &hour, 0, 24, (timeText(clock.hour) + " o'clock").c_str(),
                           ImGuiSliderFlags_NoRoundToFormat)) {
        clock.hour = std::round(60.0 * static_cast<double>(hour)) / 60;
        changed = true;
    }
    tooltip("The hour of the day.");
    clock = tidy(clock);
    return changed;
}

bool SunPanel::drawPlace() {
    PlaceOnEarth& place = mClock->place;
    if (mOnEarth) {
        const double north = place.latitude / kPlaceDegree, east = place.longitude / kPlaceDegree;
        std::string text = fmt::format("at {:.3f} {}, {:.3f} {}", std::abs(north), north < 0 ? "S" : "N",
                                       std::abs(east), east < 0 ? "W" : "E");
        if (std::abs(mNorth) > kNoNorth)
            text += fmt::format("\ntrue north {:+.2f} degrees from the map's", mNorth / kPlaceDegree);
        quietText(text);
        return false;
    }
    bool changed = angleControl("N##latitude", place.latitude, 90, "Latitude in degrees, south negative.");
    ImGui::SameLine();
    changed |= angleControl("E##longitude", place.longitude, 180, "Longitude in degrees, west negative.");
    return changed;
}

void SunPanel::draw(SceneChanges& changes, ViewSession& session) {
    const Option* const option = sunOption(changes);
    if (!option || !ImGui::TreeNode("Sun by date and time")) return;
    look(session);
    ImGui::BeginGroup();
    bool changed = drawClock();
    changed |= drawPlace();
    ImGui::EndGroup();
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    if (mTold != mClock) {
        mThen = sunThen(*mClock, mNorth);
        mTold = mClock;
    }
    const std::string text = sunOptionText(mThen.world);
    // Effects that have to be computed for each place of the sun are applied when the drag ends.
    if (changes.live(*option) ? changed : done) changes.set(option->key, text);
    quietText(describe(mThen));
    drawHoursButton(changes, dateText(*mClock));
    if (changes.valueOf(*option).value_or("") != text) {
        const auto given = changes.settings().now().find(option->key);
        const bool isSet = given != changes.settings().now().end() && given->second.back() == text;
        if (!isSet && ImGui::Button("Set the sun")) changes.set(option->key, text);
        if (!isSet) tooltip("The light does not follow the date and time now: this sets it to them.");
    }
    ImGui::TreePop();
}

}  // namespace stereonav
