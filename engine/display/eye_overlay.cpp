#include "engine/display/eye_overlay.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <glm/common.hpp>

#include "engine/display/interface.h"

namespace stereonav {
namespace {

constexpr ImU32 kInk = IM_COL32(255, 255, 255, 255), kEdge = IM_COL32(0, 0, 0, 255),
                kPlate = IM_COL32(0, 0, 0, 170);

ImU32 inkOf(const OverlayMark& mark) {
    return IM_COL32(mark.ink.r, mark.ink.g, mark.ink.b, 255);
}

ImVec2 at(const glm::vec2& place) {
    return {place.x, place.y};
}

void drawLabel(ImDrawList& list, const glm::vec2& place, const OverlayMark& mark, float font) {
    const float dot = 0.2f * font, margin = 0.25f * font;
    list.AddCircleFilled(at(place), dot + 1, kEdge);
    list.AddCircleFilled(at(place), dot, inkOf(mark));
    // Rounds to whole pixels in each eye, so that letters are sharp.
    const glm::vec2 corner = glm::round(place + mark.textAt);
    const ImVec2 size = ImGui::CalcTextSize(mark.text.c_str());
    list.AddRectFilled({corner.x - margin, corner.y}, {corner.x + size.x + margin, corner.y + size.y}, kPlate,
                       0.2f * font);
    list.AddText(at(corner), inkOf(mark), mark.text.c_str());
}

void drawMark(ImDrawList& list, const glm::vec2& place, const OverlayMark& mark, const InterfaceLook& look) {
    if (mark.dot) {
        const float dot = 0.1f * ImGui::GetFontSize();
        list.AddCircleFilled(at(place), dot + 1, kEdge);
        return list.AddCircleFilled(at(place), dot, inkOf(mark));
    }
    if (!mark.text.empty()) return drawLabel(list, place, mark, ImGui::GetFontSize());
    ImGui::RenderMouseCursor(&list, at(glm::round(place)), look.scale, ImGuiMouseCursor_Arrow, kInk, kEdge,
                             IM_COL32(0, 0, 0, 48));
}

// Returns a box around all that was drawn since the list had `firstCorner` corners.
EyeLayer::Box boxOf(const ImDrawList& list, int firstCorner) {
    constexpr float kFar = 1e6f;  // wider than any picture
    glm::vec2 low(kFar), high(-kFar);
    for (int n = firstCorner; n < list.VtxBuffer.Size; ++n) {
        const glm::vec2 corner(list.VtxBuffer[n].pos.x, list.VtxBuffer[n].pos.y);
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    return {glm::ivec2(glm::floor(glm::clamp(low, -kFar, kFar))),
            glm::ivec2(glm::ceil(glm::clamp(high, -kFar, kFar)))};
}

void makeLayer(const GlTexture& texture, const glm::ivec2& size) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

}  // namespace

bool EyeOverlay::draw(const Interface& interface, const glm::ivec2& size,
                      const std::vector<OverlayMark>& marks) {
    if (marks.empty() && mMarks.empty()) return false;
    const bool resized = size != mSize;
    if (marks == mMarks && !resized && interface.look() == mLook) return false;
    mMarks = marks;
    mLook = interface.look();
    if (marks.empty()) return true;
    interface.use();
    if (!mLayers) mLayers.emplace();
    if (resized)
        for (const GlTexture& texture : mLayers->textures) makeLayer(texture, size);
    mSize = size;
    drawEye(0, mLook);
    drawEye(1, mLook);
    return true;
}

void EyeOverlay::drawEye(std::size_t eye, const InterfaceLook& look) {
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
    list.PushTextureID(ImGui::GetIO().Fonts->TexID);
    const ImVec2 size(static_cast<float>(mSize.x), static_cast<float>(mSize.y));
    list.PushClipRect({0, 0}, size);
    mBoxes[eye].clear();
    for (const OverlayMark& mark : mMarks) {
        const int first = list.VtxBuffer.Size;
        drawMark(list, eye == 0 ? mark.left : mark.right, mark, look);
        mBoxes[eye].push_back(boxOf(list, first));
    }
    list._PopUnusedDrawCmd();

    GLint before = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, mLayers->target.name());
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           mLayers->textures[eye].name(), 0);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    ImDrawList* lists[] = {&list};
    ImDrawData data;
    data.Valid = true;
    data.CmdLists = lists;
    data.CmdListsCount = 1;
    data.TotalIdxCount = list.IdxBuffer.Size;
    data.TotalVtxCount = list.VtxBuffer.Size;
    data.DisplaySize = size;
    data.FramebufferScale = {1, 1};
    ImGui_ImplOpenGL3_RenderDrawData(&data);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
}

std::optional<std::array<EyeLayer, 2>> EyeOverlay::layers() const {
    if (!mLayers || mMarks.empty()) return std::nullopt;
    return std::array{EyeLayer{mLayers->textures[0].name(), mBoxes[0]},
                      EyeLayer{mLayers->textures[1].name(), mBoxes[1]}};
}

}  // namespace stereonav
