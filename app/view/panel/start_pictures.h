// Pictures of the built-in scenes, rendered by the program and embedded in it (data/start): eight frames of
// each flight, side by side.
#pragma once

#include <string_view>

struct ImVec2;

namespace stereonav {

constexpr float kStartPictureWidth = 256, kStartPictureHeight = 144;  // pixels of a frame

// Draws into the current window of Dear ImGui; moving: one frame after another. Pictures are decoded beside
// the window's thread; until then a grey box is drawn.
void drawStartPicture(std::string_view scene, const ImVec2& corner, const ImVec2& size, bool moving);
// Frees the textures; the context has to exist.
void forgetStartPictures();

}  // namespace stereonav
