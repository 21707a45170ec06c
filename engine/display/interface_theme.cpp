#include "engine/display/interface_theme.h"

#include <imgui.h>

namespace stereonav {
namespace {

ImVec4 grey(float value, float alpha = 1) {
    return {value, value, value, alpha};
}

// Weights of Rec. 709 on the encoded values: near enough for a grey of the same lightness.
ImVec4 asGrey(const ImVec4& color) {
    return grey(0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z, color.w);
}

ImVec4 shown(const InterfaceLook& look, const ImVec4& dark, const ImVec4& light) {
    const ImVec4 color = look.dark ? dark : light;
    return look.grey ? asGrey(color) : color;
}

void setColors(const InterfaceLook& look) {
    ImVec4* const colors = ImGui::GetStyle().Colors;
    // From the window's grey towards the text's.
    const float back = look.dark ? 0.11f : 0.93f, front = look.dark ? 0.92f : 0.10f;
    const auto between = [&](float share, float alpha = 1) {
        return grey(back + share * (front - back), alpha);
    };
    const ImVec4 accent = accentColor(look);
    const auto accented = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    for (int n = 0; n < ImGuiCol_COUNT; ++n) colors[n] = between(0.2f);
    colors[ImGuiCol_Text] = between(1);
    colors[ImGuiCol_TextDisabled] = quietColor(look);
    colors[ImGuiCol_WindowBg] = between(0);
    colors[ImGuiCol_ChildBg] = between(0, 0);
    colors[ImGuiCol_PopupBg] = between(0.03f);
    colors[ImGuiCol_Border] = between(0.22f);
    colors[ImGuiCol_BorderShadow] = grey(0, 0);
    colors[ImGuiCol_FrameBg] = between(0.11f);
    colors[ImGuiCol_FrameBgHovered] = between(0.18f);
    colors[ImGuiCol_FrameBgActive] = between(0.25f);
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = colors[ImGuiCol_TitleBgCollapsed] =
        between(0.06f);
    colors[ImGuiCol_MenuBarBg] = between(0.04f);
    colors[ImGuiCol_ScrollbarBg] = between(0, 0);
    colors[ImGuiCol_ScrollbarGrab] = between(0.25f);
    colors[ImGuiCol_ScrollbarGrabHovered] = between(0.35f);
    colors[ImGuiCol_ScrollbarGrabActive] = between(0.45f);
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = between(0.55f);
    colors[ImGuiCol_SliderGrabActive] = accent;
    colors[ImGuiCol_Button] = between(0.15f);
    colors[ImGuiCol_ButtonHovered] = between(0.24f);
    colors[ImGuiCol_ButtonActive] = accented(0.6f);
    colors[ImGuiCol_Header] = between(0.10f);
    colors[ImGuiCol_HeaderHovered] = between(0.18f);
    colors[ImGuiCol_HeaderActive] = between(0.25f);
    colors[ImGuiCol_Separator] = between(0.18f);
    colors[ImGuiCol_SeparatorHovered] = colors[ImGuiCol_SeparatorActive] = accent;
    colors[ImGuiCol_ResizeGrip] = between(0, 0);
    colors[ImGuiCol_ResizeGripHovered] = colors[ImGuiCol_ResizeGripActive] = accented(0.6f);
    colors[ImGuiCol_Tab] = between(0.08f);
    colors[ImGuiCol_TabHovered] = between(0.24f);
    colors[ImGuiCol_TabActive] = between(0.20f);
    colors[ImGuiCol_PlotLines] = colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_PlotLinesHovered] = colors[ImGuiCol_PlotHistogramHovered] = warningColor(look);
    colors[ImGuiCol_TableHeaderBg] = between(0.10f);
    colors[ImGuiCol_TableRowBg] = between(0, 0);
    colors[ImGuiCol_TableRowBgAlt] = between(0.04f);
    colors[ImGuiCol_TextSelectedBg] = accented(0.45f);
    colors[ImGuiCol_DragDropTarget] = accent;
    colors[ImGuiCol_NavHighlight] = accent;
    colors[ImGuiCol_ModalWindowDimBg] = colors[ImGuiCol_NavWindowingDimBg] = grey(0, 0.4f);
}

}  // namespace

ImVec4 accentColor(const InterfaceLook& look) {
    return shown(look, {0.45f, 0.68f, 0.88f, 1}, {0.10f, 0.38f, 0.62f, 1});
}

ImVec4 warningColor(const InterfaceLook& look) {
    return shown(look, {0.96f, 0.74f, 0.36f, 1}, {0.55f, 0.32f, 0.02f, 1});
}

ImVec4 quietColor(const InterfaceLook& look) {
    return grey(look.dark ? 0.64f : 0.36f);
}

void applyTheme(const InterfaceLook& look) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowRounding = style.ChildRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
    style.ScrollbarRounding = 3;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.WindowPadding = {8, 8};
    style.FramePadding = {6, 3};
    style.ItemSpacing = {6, 5};
    style.ItemInnerSpacing = {5, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 10;
    style.GrabMinSize = 8;
    style.WindowMinSize = {1, 1};
    style.ColorButtonPosition = ImGuiDir_Left;
    style.ScaleAllSizes(look.scale);
    setColors(look);
}

}  // namespace stereonav
