#include "app/view/panel/slices_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/view/panel/controls.h"
#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

constexpr double kEyeMoves = 2e-4;  // metres: smaller moves are not drawn
constexpr double kMostZoom = 16;
constexpr const char* kAxisNames[] = {"axial", "coronal", "sagittal"};

// Windows in radiology: width and level in Hounsfield units.
struct WindowPreset {
    const char* name;
    double width, level;
};
constexpr WindowPreset kWindows[] = {
    {"colon", 1500, -200}, {"lung", 1500, -600}, {"soft tissue", 400, 40}, {"bone", 1800, 400}};

PackedColor packed(std::size_t red, std::size_t green, std::size_t blue) {
    const auto& channel = packedFromSrgbByte();
    return static_cast<PackedColor>(channel[red]) | static_cast<PackedColor>(channel[green]) << 10 |
           static_cast<PackedColor>(channel[blue]) << 20;
}

PackedColor eyeColor() {
    return packed(255, 190, 70);
}

// Returns the value of the voxel at a place.
std::optional<double> valueOfVoxel(const GreyVolume& grey, const glm::dvec3& world) {
    const glm::dvec3 voxel = glm::round(grey.frame.voxelFromWorld(world));
    for (int k = 0; k < 3; ++k)
        if (!(voxel[k] >= 0 && voxel[k] < grey.frame.size[k])) return std::nullopt;
    return grey.at(glm::ivec3(voxel)) * grey.scale + grey.offset;
}

}  // namespace

void SlicesPanel::forget() {
    mViews = {};
    mStudy.reset();
}

void SlicesPanel::windowControls(const SliceStudy& study) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::BeginCombo("##windows", fmt::format("window {:.0f} at {:.0f}", mWindow, mLevel).c_str())) {
        if (ImGui::Selectable("the study's own")) mWindow = study.windowWidth, mLevel = study.windowLevel;
        for (const WindowPreset& preset : kWindows)
            if (ImGui::Selectable(
                    fmt::format("{}  {:.0f} at {:.0f}", preset.name, preset.width, preset.level).c_str()))
                mWindow = preset.width, mLevel = preset.level;
        ImGui::EndCombo();
    }
    tooltip(
        "Width of the values from black to white, and their middle; drag a slice with the right button to "
        "change them.");
    ImGui::Checkbox("follow the eye", &mFollows);
    tooltip("The slices go through the eye; otherwise through the place that was clicked.");
}

void SlicesPanel::draw(ViewSession& session, StudyReading& reading, Instruments& instruments) {
    const std::shared_ptr<const SliceStudy> study = reading.wanted(session);
    if (!study) return quietText(reading.busy() ? "reading the slices" : "not read: V reads them");
    if (mStudy.lock() != study) {
        mStudy = study;
        mViews = {};
        mWindow = study->windowWidth;
        mLevel = study->windowLevel;
        mZoom = 1;
    }
    if (mFollows) mCross = session.pose().position;
    windowControls(*study);
    for (const SliceAxis axis : {SliceAxis::Axial, SliceAxis::Coronal, SliceAxis::Sagittal})
        drawView(session, instruments, *study, axis);
}

void SlicesPanel::drawView(ViewSession& session, Instruments& instruments, const SliceStudy& study,
                           SliceAxis axis) {
    View& view = mViews[static_cast<std::size_t>(axis)];
    const int width = std::max(static_cast<int>(ImGui::GetContentRegionAvail().x), 16);
    // Enlarged pictures show a part of a larger one around the cross.
    const SliceLayout fitted(study.grey.frame, axis, width, width);
    const int height = width;
    const SliceLayout layout = fitted.zoomed(mZoom, mCross);
    const int slice = layout.sliceAt(mCross);
    const glm::dvec3 eye = session.pose().position;
    const bool stale = !view.texture.any() || view.width != width || view.slice != slice ||
                       view.zoom != mZoom || view.window != mWindow || view.level != mLevel ||
                       view.follows != mFollows || view.scene.lock() != session.openShared() ||
                       glm::length(view.eye - eye) > kEyeMoves ||
                       glm::length(view.cross - mCross) > kEyeMoves;
    if (stale) {
        const SliceSource* const source = session.open().scene->offered<SliceSource>();
        SliceContent content;
        content.grey = &study.grey;
        content.windowWidth = mWindow;
        content.windowLevel = mLevel;
        content.lumen = source ? source->lumen() : nullptr;
        content.marks.push_back({eye, eyeColor(), true});
        if (!mFollows) content.marks.push_back({mCross, packed(110, 170, 225), false});
        view.texture.set(drawSlice(content, layout, slice, width, height), false);
        view.cross = mCross;
        view.eye = eye;
        view.width = width;
        view.slice = slice;
        view.zoom = mZoom;
        view.window = mWindow;
        view.level = mLevel;
        view.follows = mFollows;
        view.scene = session.openShared();
    }
    ImGui::PushID(kAxisNames[static_cast<int>(axis)]);
    const ImVec2 from = ImGui::GetCursorScreenPos(),
                 size(static_cast<float>(width), static_cast<float>(height));
    ImGui::InvisibleButton("##slice", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const bool hovered = ImGui::IsItemHovered();
    ImGui::SetItemUsingMouseWheel();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(view.texture.id(), from, {from.x + size.x, from.y + size.y});
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const auto world = layout.worldAt(pointer.x - from.x, pointer.y - from.y, slice);
    std::string text = fmt::format("{} {:.1f} mm", kAxisNames[static_cast<int>(axis)], layout.placeOf(slice));
    if (hovered && world)
        if (const auto value = valueOfVoxel(study.grey, *world)) text += fmt::format("   {:.0f} HU", *value);
    list.AddText({from.x + 4, from.y + 2}, IM_COL32(235, 235, 235, 255), text.c_str());
    if (hovered) {
        ImGuiIO& io = ImGui::GetIO();
        if (io.MouseWheel != 0 && io.KeyCtrl)
            mZoom = std::clamp(mZoom * std::pow(1.25, io.MouseWheel), 1.0, kMostZoom);
        else if (io.MouseWheel != 0) {
            const int next = std::clamp(slice + (io.MouseWheel > 0 ? -1 : 1), 0, layout.sliceCount() - 1);
            mFollows = false;
            mCross = layout.onSlice(mCross, next);
        }
        if (world && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            Pose goal = session.pose();
            goal.position = *world;
            session.flyTo(goal);
        } else if (world && ImGui::IsMouseDown(ImGuiMouseButton_Left) && ImGui::IsItemActive()) {
            mFollows = false;
            mCross = *world;
        }
        if (world && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::IsItemDeactivated())
            if (const FindingList* const findings = instruments.findings(); findings && findings->clicks())
                instruments.addFinding(*world);
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) && !ImGui::IsMouseDown(ImGuiMouseButton_Right))
            tooltip(
                "click: the other slices through here\ndouble click: fly there\nwheel: slices; Ctrl+wheel: "
                "larger");
    }
    if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        mWindow = std::max(mWindow + 2 * static_cast<double>(ImGui::GetIO().MouseDelta.x), 1.0);
        mLevel += 2 * static_cast<double>(ImGui::GetIO().MouseDelta.y);
    }
    ImGui::PopID();
}

}  // namespace stereonav
