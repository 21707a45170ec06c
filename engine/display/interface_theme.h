// The look of the interface: greys and one accent colour, at the screen's scale.
#pragma once

struct ImVec4;

namespace stereonav {

// The look of the interface.
struct InterfaceLook {
    bool dark = true;
    bool grey = false;  // for anaglyphs, whose glasses separate colours
    float scale = 1;    // 1 at 96 dots an inch, within 0.5 to 4
    bool operator==(const InterfaceLook&) const = default;
};

constexpr float kInterfaceFontPixels = 14;  // height at scale 1

// Sets colours, sizes and font of the current Dear ImGui context.
void applyTheme(const InterfaceLook& look);

// Colours with a meaning, sRGB, for this look: accentColor for active or chosen elements, warningColor for
// what needs attention.
ImVec4 accentColor(const InterfaceLook& look);
ImVec4 warningColor(const InterfaceLook& look);
ImVec4 quietColor(const InterfaceLook& look);  // sRGB, for texts that explain

}  // namespace stereonav
