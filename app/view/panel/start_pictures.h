// Pictures of the built-in scenes, made by the program itself and part of it (data/start): eight frames of
// each one's flight, beside each other.
#pragma once

#include <string_view>

struct ImVec2;

namespace stereonav {

constexpr float kStartPictureWidth = 256, kStartPictureHeight = 144;  // pixels of a frame

// Into the current window of Dear ImGui; moving: one frame after another. Decoded beside the window's thread;
// nothing but a grey box until then.
void drawStartPicture(std::string_view scene, const ImVec2& corner, const ImVec2& size, bool moving);
// Lets go of textures, while the context is still there.
void forgetStartPictures();

}  // namespace stereonav
