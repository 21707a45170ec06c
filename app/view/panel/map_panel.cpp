#include "app/view/panel/map_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/output/length_text.h"
#include "app/view/panel/controls.h"

namespace stereonav {
namespace {

constexpr int kMapPixels = 512;   // of the longer side
constexpr float kTallest = 1.2f;  // of the width

ImU32 markColor() {
    return IM_COL32(255, 190, 70, 255);
}

// The eye: a dot, and the sector that it sees, on a map whose axes are x to the right and y down.
void drawEye(const ImVec2& at, double heading, double halfFov) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize(), reach = 1.6f * font;
    const auto towards = [&](double angle) {
        return ImVec2(at.x + reach * static_cast<float>(std::sin(angle)),
                      at.y - reach * static_cast<float>(std::cos(angle)));
    };
    list.AddTriangleFilled(at, towards(heading - halfFov), towards(heading + halfFov),
                           IM_COL32(255, 190, 70, 110));
    list.AddCircleFilled(at, 0.3f * font, IM_COL32(20, 20, 20, 255));
    list.AddCircleFilled(at, 0.22f * font, markColor());
}

double halfFovAcross(const ViewSession& session, const SizeOption& size) {
    return std::atan(std::tan(session.lens().verticalFov / 2) * size.width / std::max(size.height, 1));
}

}  // namespace

bool MapPanel::has(PanelHost& host) {
    ViewSession* const session = host.session();
    if (!session) return false;
    const Scene& scene = *session->open().scene;
    const auto* const line = scene.offered<LineOnMap>();
    return scene.offered<MapFromAbove>() || (line && line->places.size() > 1);
}

void MapPanel::forget() {
    if (mProgress) mProgress->cancel();
    if (mMaking.valid()) mMaking.wait();
    mMaking = {};
    mMap.reset();
    mTexture.reset();
    mScene.reset();
}

void MapPanel::look(const std::shared_ptr<const OpenScene>& scene) {
    if (scene != mScene) {
        forget();
        mScene = scene;
        if (const auto* const map = scene->scene->offered<MapFromAbove>()) {
            mProgress = std::make_shared<Progress>();
            mMaking = std::async(std::launch::async, [progress = mProgress, scene, map] {
                return map->makeMap(kMapPixels, *progress);
            });
        }
    }
    if (!mMaking.valid() || mMaking.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    try {
        mMap = mMaking.get();
        mTexture.set(mMap->picture, true);
    } catch (const std::exception&) {
        mMap.reset();  // a panel without a map is still a panel
    }
}

void MapPanel::draw(PanelHost& host) {
    ViewSession* const session = host.session();
    if (!session) return;
    look(session->openShared());
    if (mMap) return drawPicture(host, *session);
    const auto* const line = session->open().scene->offered<LineOnMap>();
    if (line && line->places.size() > 1) return drawLine(host, *session, *line);
    quietText(host, mMaking.valid() ? "drawing the map" : "no map");
}

void MapPanel::drawPicture(PanelHost& host, ViewSession& session) {
    const float width = ImGui::GetContentRegionAvail().x;
    const float scale = std::min(width / static_cast<float>(mMap->picture.width()),
                                 kTallest * width / static_cast<float>(mMap->picture.height()));
    const ImVec2 size(scale * static_cast<float>(mMap->picture.width()),
                      scale * static_cast<float>(mMap->picture.height()));
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton("##map", size);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(mTexture.id(), from, {from.x + size.x, from.y + size.y});
    list.PushClipRect(from, {from.x + size.x, from.y + size.y}, true);
    const auto placed = [&](const glm::dvec3& world) {
        const glm::dvec2 pixel = mMap->mapFromWorld(glm::dvec2(world));
        return ImVec2(from.x + scale * static_cast<float>(pixel.x),
                      from.y + scale * static_cast<float>(pixel.y));
    };
    const auto& samples = session.path().samples();
    for (std::size_t n = 1; n < samples.size(); ++n)
        list.AddLine(placed(samples[n - 1].pose.position), placed(samples[n].pose.position),
                     IM_COL32(255, 255, 255, 150), 1.5f);
    const Pose pose = session.pose();
    drawEye(placed(pose.position), anglesOf(pose).heading, halfFovAcross(session, host.pictureSize()));
    list.PopClipRect();
    if (!hovered) return;
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const glm::dvec2 world = mMap->worldFromMap({(pointer.x - from.x) / scale, (pointer.y - from.y) / scale});
    const glm::dvec3 there(world.x, world.y, pose.position.z);
    std::string text = fmt::format("{:.0f} m east, {:.0f} m north", world.x, world.y);
    if (const auto* const earth = session.open().scene->offered<OnEarth>())
        if (const auto place = earth->placeAt(there)) {
            constexpr double kDegrees = 180 / std::numbers::pi;
            text +=
                fmt::format("\n{:.5f} N {:.5f} E", kDegrees * place->latitude, kDegrees * place->longitude);
        }
    tooltip(text + "\nclick: fly there");
    if (!clicked) return;
    Pose goal = pose;
    goal.position = there;
    session.flyTo(goal);
}

void MapPanel::drawLine(PanelHost& host, ViewSession& session, const LineOnMap& line) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    const auto flat = [&](const glm::dvec3& world) {
        return glm::dvec2(glm::dot(world, line.right), -glm::dot(world, line.up));
    };
    for (const LinePlace& place : line.places) {
        low = glm::min(low, flat(place.world));
        high = glm::max(high, flat(place.world));
    }
    const glm::dvec2 extent = glm::max(high - low, glm::dvec2(1e-6));
    const float width = ImGui::GetContentRegionAvail().x, margin = ImGui::GetFontSize();
    const double scale =
        std::min((width - 2 * margin) / extent.x, (kTallest * width - 2 * margin) / extent.y);
    const ImVec2 size(width, static_cast<float>(scale * extent.y) + 2 * margin);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton("##line", size);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    const float left = from.x + (width - static_cast<float>(scale * extent.x)) / 2;
    const auto placed = [&](const glm::dvec3& world) {
        const glm::dvec2 at = scale * (flat(world) - low);
        return ImVec2(left + static_cast<float>(at.x), from.y + margin + static_cast<float>(at.y));
    };
    const LinePlace* nearest = nullptr;
    float best = std::numeric_limits<float>::infinity();
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    for (std::size_t n = 0; n < line.places.size(); ++n) {
        const ImVec2 at = placed(line.places[n].world);
        if (n > 0 && line.places[n].segment == line.places[n - 1].segment)
            list.AddLine(placed(line.places[n - 1].world), at, ImGui::GetColorU32(ImGuiCol_Text), 1.5f);
        const float away = std::hypot(at.x - pointer.x, at.y - pointer.y);
        if (away < best) best = away, nearest = &line.places[n];
    }
    const Pose pose = session.pose();
    const glm::dvec3 forward = pose.forward();
    const double heading = std::atan2(glm::dot(forward, line.right), glm::dot(forward, line.up));
    drawEye(placed(pose.position), heading, halfFovAcross(session, host.pictureSize()));
    if (!hovered || !nearest) return;
    list.AddCircle(placed(nearest->world), 0.35f * ImGui::GetFontSize(), markColor(), 0, 2);
    tooltip(fmt::format("{} from the start; click: fly there", lengthText(nearest->along)));
    if (clicked) session.flyAlong(nearest->along);
}

}  // namespace stereonav
