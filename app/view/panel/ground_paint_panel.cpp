#include "app/view/panel/ground_paint_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include "app/view/panel/controls.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/live_paint.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {

// Share of the slider at its left end that means no contours; then follow intervals from a metre on, on a
// logarithmic scale.
constexpr float kNoneShare = 0.04f;
constexpr double kMostInterval = 1000;  // metres

double intervalAt(float share) {
    if (share < kNoneShare) return 0;
    return std::pow(kMostInterval, double(share - kNoneShare) / (1 - kNoneShare));
}

float shareOf(double interval) {
    if (!(interval > 0)) return 0;
    const double share = std::log(interval) / std::log(kMostInterval);
    return kNoneShare + (1 - kNoneShare) * static_cast<float>(std::clamp(share, 0.0, 1.0));
}

void drawInterval(SceneChanges& changes, const LivePaint& paint) {
    const std::string text = paint.now("contours");
    const auto number = numberOf(text);
    const double interval = number.value_or(0);
    const std::string shown = interval > 0             ? fmt::format("contours every {:.4g} m", interval)
                              : text.empty() || number ? "contours: none"
                                                       : "contours: " + text;
    float share = shareOf(interval);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##interval", &share, 0, 1, shown.c_str(),
                           ImGuiSliderFlags_NoRoundToFormat | ImGuiSliderFlags_NoInput))
        changes.set("contours", fmt::format("{:.0f}", intervalAt(share)));
    tooltip("Metres of height between contour lines; drag to change them, to the left end for none.");
}

// Colours in the place of the ground's own, which no picture holds.
void drawColours(SceneChanges& changes, const LivePaint& paint) {
    constexpr std::array<const char*, 7> kWords{"natural", "hypsometric", "swiss",    "grey",
                                                "slope",   "aspect",      "hillshade"};
    if (!paint.takes("paint", kWords[0])) return;
    const std::string now = paint.now("paint");
    const bool known = std::ranges::find(kWords, now) != kWords.end();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::BeginCombo("##colours", ("colours: " + (known ? now : "usual")).c_str())) {
        if (ImGui::Selectable("usual", !known) && known) changes.set("paint", std::nullopt);
        for (const char* const word : kWords)
            if (ImGui::Selectable(word, now == word)) changes.set("paint", word);
        ImGui::EndCombo();
    }
    tooltip("Colours of the ground. You can fly meanwhile.");
}

void drawSeenFrom(SceneChanges& changes, Instruments& instruments, const ViewSession& session,
                  LivePaint& paint) {
    static double height = 2;
    bool on = instruments.seesFrom().has_value();
    bool changed = ImGui::Checkbox("Clicks paint what is seen", &on);
    tooltip("A click on the ground, while nothing moves, darkens what is hidden from that place.");
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    if (ImGui::DragScalar("above the ground##seen", ImGuiDataType_Double, &height, 0.1f, nullptr, nullptr,
                          "%.4g m")) {
        height = std::isfinite(height) ? std::clamp(height, 0.0, 1e6) : 2;
        changed = true;
    }
    tooltip("Height of the eye at that place.");
    if (changed) instruments.seeFrom(on ? std::optional(height) : std::nullopt);
    if (button("What is seen from below the eye",
               "Darkens what is hidden from the ground below the eye, at that height above it."))
        paint.askSeenFrom(glm::dvec2(session.pose().position), height);
    if (paint.now("paint").empty()) return;
    ImGui::SameLine();
    if (button("None##paint", "Removes the paint.")) changes.set("paint", std::nullopt);
}

}  // namespace

void drawGroundPaint(SceneChanges& changes, Instruments& instruments, const ViewSession& session) {
    auto* const paint = session.open().scene->offered<LivePaint>();
    if (!paint) return;
    drawInterval(changes, *paint);
    drawSeenFrom(changes, instruments, session, *paint);
    drawColours(changes, *paint);
}

void drawHoursButton(SceneChanges& changes, const std::string& date) {
    const Scene& scene = *changes.scene()->scene;
    const auto* const paint = scene.offered<LivePaint>();
    if (!paint || !scene.offered<OnEarth>()) return;
    const std::string text = "hours:" + date;
    if (button("Paint hours of sun",
               "How long the sun reaches each place of the ground on this day. You can fly meanwhile.",
               paint->now("paint") != text))
        changes.set("paint", text);
}

}  // namespace stereonav
