#include "app/view/panel/map_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

#include "app/view/panel/controls.h"
#include "engine/base/error.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

constexpr int kMapPixels = 512;   // length of the longer side
constexpr float kTallest = 1.2f;  // greatest height, as a share of the width

ImU32 markColor() {
    return IM_COL32(255, 190, 70, 255);
}

// Draws the eye: a dot, and the sector in view, on a map whose x axis points right and y axis down.
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

// Returns the nearest handle that the pointer can grab.
std::optional<std::size_t> keyframeUnder(const KeyframeEdit& edit, const ImVec2& pointer,
                                         const std::function<ImVec2(const glm::dvec3&)>& placed) {
    std::optional<std::size_t> nearest;
    float best = 0.8f * ImGui::GetFontSize();
    for (std::size_t n = 0; n < edit.keys().size(); ++n) {
        const ImVec2 at = placed(edit.keys()[n].pose.position);
        const float away = std::hypot(at.x - pointer.x, at.y - pointer.y);
        if (away <= best) best = away, nearest = n;
    }
    return nearest;
}

double halfFovAcross(const ViewSession& session, const SizeOption& size) {
    return std::atan(std::tan(session.lens().verticalFov / 2) * size.width / std::max(size.height, 1));
}

}  // namespace

bool MapPanel::has(const ViewSession& session) {
    const Scene& scene = *session.open().scene;
    const auto* const line = scene.offered<LineOnMap>();
    return scene.offered<MapFromAbove>() || (line && line->places.size() > 1);
}

void MapPanel::forget() {
    mMaking.reset();  // waits for its end
    mMap.reset();
    mTexture.reset();
    mScene.reset();
    mFlownVersion = -1;  // other walls are in the way in another scene
}

void MapPanel::look(const std::shared_ptr<const OpenScene>& scene) {
    if (scene != mScene) {
        forget();
        mScene = scene;
        if (const auto* const map = scene->scene->offered<MapFromAbove>())
            mMaking.emplace().start(
                [scene, map](Progress& progress) { return map->makeMap(kMapPixels, progress); }, [] {});
    }
    try {
        auto made = mMaking ? mMaking->take() : std::nullopt;
        if (!made) return;
        mMap = std::move(made);
        mTexture.set(mMap->picture, true);
    } catch (const std::exception&) {
        mMap.reset();  // the panel is useful without a map, too
    }
}

void MapPanel::draw(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye) {
    look(session.openShared());
    const auto* const line = session.open().scene->offered<LineOnMap>();
    if (mMap)
        drawPicture(session, edit, eye);
    else if (line && line->places.size() > 1)
        drawLine(session, edit, eye, *line);
    else
        return quietText(mMaking && mMaking->busy() ? "drawing the map" : "no map");
    if (edit.any() && mFlown.anyBlocked) quietText("Red: a wall is in the way.");
}

void MapPanel::drawPath(ViewSession& session, KeyframeEdit& edit, const Placed& placed) {
    constexpr ImU32 kWay = IM_COL32(255, 255, 255, 150), kBlocked = IM_COL32(255, 60, 60, 255);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool edits = edit.any();
    if (edits && mFlownVersion != edit.version()) try {
            mFlownVersion = edit.version();
            mFlown = flownThrough(edit.keys(), session.flight());
        } catch (const Error&) {
            mFlown = {};  // a flight that is not possible has no line
        }
    const auto& samples = edits ? mFlown.path.samples() : session.paths().path().samples();
    for (std::size_t n = 1; n < samples.size(); ++n)
        list.AddLine(placed(samples[n - 1].pose.position), placed(samples[n].pose.position),
                     edits && mFlown.blocked[n - 1] ? kBlocked : kWay, edits ? 2.0f : 1.5f);
    if (!edits) return;
    const float font = ImGui::GetFontSize();
    const auto handle = [&](std::size_t key, float size, ImU32 color) {
        const ImVec2 at = placed(edit.keys()[key].pose.position);
        list.AddCircleFilled(at, (size + 0.08f) * font, IM_COL32(20, 20, 20, 255));
        list.AddCircleFilled(at, size * font, color);
    };
    for (std::size_t n = 0; n < edit.keys().size(); ++n) handle(n, 0.24f, IM_COL32(255, 255, 255, 255));
    if (edit.chosen()) handle(*edit.chosen(), 0.34f, markColor());  // drawn over its neighbours
}

bool MapPanel::dragKeyframes(ViewSession& session, KeyframeEdit& edit, const Placed& placed,
                             const Unplaced& unplaced) {
    if (!edit.any()) return false;
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const auto under = keyframeUnder(edit, pointer, placed);
    if (ImGui::IsItemActivated()) {
        if (under) edit.beginDrag(*under);
        mPressedKeyframe = under.has_value();
    }
    if (mPressedKeyframe && ImGui::IsItemActive()) {
        if (edit.dragging() && ImGui::IsMouseDragging(ImGuiMouseButton_Left))
            edit.dragTo(unplaced(pointer, edit.draggedFrom().position));
        return true;
    }
    if (mPressedKeyframe) {  // released in this turn
        edit.endDrag();
        mPressedKeyframe = false;
        return true;
    }
    if (!under || !ImGui::IsItemHovered()) return false;
    const PathSample& key = edit.keys()[*under];
    std::string text = fmt::format("keyframe {} of {}, at {:.1f} s", *under + 1, edit.keys().size(),
                                   key.time - edit.keys().front().time);
    if (const auto height = heightOverGround(session.flight(), key.pose.position))
        text += fmt::format(", {} over the ground", lengthText(*height));
    tooltip(text + "\ndrag it; Del removes the chosen one");
    return true;
}

void MapPanel::drawPicture(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye) {
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
    drawPath(session, edit, placed);
    const Pose pose = session.pose();
    drawEye(placed(pose.position), anglesOf(pose).heading, halfFovAcross(session, eye));
    list.PopClipRect();
    const auto pointed = [&](const ImVec2& at) {
        const glm::dvec2 pixel((at.x - from.x) / scale, (at.y - from.y) / scale);
        const glm::dvec2 most(mMap->picture.width(), mMap->picture.height());
        return mMap->worldFromMap(glm::clamp(pixel, glm::dvec2(0), most));
    };
    const auto dragged = [&](const ImVec2& at, const glm::dvec3& origin) {
        return overGround(session.flight(), origin, pointed(at));
    };
    if (dragKeyframes(session, edit, placed, dragged) || !hovered) return;
    const glm::dvec2 world = pointed(ImGui::GetIO().MousePos);
    const glm::dvec3 there(world.x, world.y, pose.position.z);
    std::string text = fmt::format("{} m east, {} m north", fixedText(world.x, 0), fixedText(world.y, 0));
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

void MapPanel::drawLine(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye,
                        const LineOnMap& line) {
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
    if (edit.any()) drawPath(session, edit, placed);
    const Pose pose = session.pose();
    const glm::dvec3 forward = pose.forward();
    const double heading = std::atan2(glm::dot(forward, line.right), glm::dot(forward, line.up));
    drawEye(placed(pose.position), heading, halfFovAcross(session, eye));
    // The new place is on the line, which is clear of the wall.
    const auto dragged = [&](const ImVec2&, const glm::dvec3& origin) {
        return nearest ? nearest->world : origin;
    };
    if (dragKeyframes(session, edit, placed, dragged) || !hovered || !nearest) return;
    list.AddCircle(placed(nearest->world), 0.35f * ImGui::GetFontSize(), markColor(), 0, 2);
    tooltip(fmt::format("{} from the start; click: fly there", lengthText(nearest->along)));
    if (clicked) session.flyAlong(nearest->along);
}

}  // namespace stereonav
