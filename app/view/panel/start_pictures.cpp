#include "app/view/panel/start_pictures.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/error.h"
#include "engine/display/gl_object.h"
#include "engine/image/image_file.h"

// As engine/display/interface_font.cpp has its font.
#define STEREONAV_START_PICTURE(name)                                                                   \
    asm(".section .rodata\n.balign 16\nstereonavStart_" #name ":\n.incbin \"" STEREONAV_START "/" #name \
        ".jpg\"\nstereonavStartEnd_" #name ":\n.byte 0\n.previous\n");                                  \
    extern const unsigned char kBegin_##name[] asm("stereonavStart_" #name);                            \
    extern const unsigned char kEnd_##name[] asm("stereonavStartEnd_" #name)
STEREONAV_START_PICTURE(terrain);
STEREONAV_START_PICTURE(colon);
STEREONAV_START_PICTURE(cloud);
STEREONAV_START_PICTURE(wax);

namespace stereonav {
namespace {

constexpr int kFrames = 8;
constexpr double kFramesPerSecond = 5;

struct StartPicture {
    std::string_view scene;
    std::span<const unsigned char> file;
    std::future<Plane<PackedColor>> decoding = {};
    std::optional<GlTexture> texture = std::nullopt;
    bool failed = false;
};

std::array<StartPicture, 4>& pictures() {
    static std::array<StartPicture, 4> all{{{"terrain", {kBegin_terrain, kEnd_terrain}},
                                            {"colon", {kBegin_colon, kEnd_colon}},
                                            {"cloud", {kBegin_cloud, kEnd_cloud}},
                                            {"wax", {kBegin_wax, kEnd_wax}}}};
    return all;
}

void upload(StartPicture& picture, const Plane<PackedColor>& pixels) {
    const auto& bytes = srgbByteFromPacked();
    std::vector<std::uint8_t> rgb;
    rgb.reserve(static_cast<std::size_t>(pixels.width()) * static_cast<std::size_t>(pixels.height()) * 4);
    for (int y = 0; y < pixels.height(); ++y)
        for (int x = 0; x < pixels.width(); ++x) {
            const PackedColor color = pixels.at(x, y);
            for (int channel = 0; channel < 3; ++channel)
                rgb.push_back(bytes[color >> (10 * channel) & 1023]);
            rgb.push_back(255);
        }
    picture.texture.emplace();
    glBindTexture(GL_TEXTURE_2D, picture.texture->name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, pixels.width(), pixels.height(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 rgb.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// A page without pictures is still a page: what cannot be decoded stays grey.
void prepare(StartPicture& picture) {
    if (picture.texture || picture.failed) return;
    if (!picture.decoding.valid()) {
        picture.decoding = std::async(std::launch::async, [file = picture.file] {
            return decodeColorImage(file, "the start page", "");
        });
        return;
    }
    if (picture.decoding.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    try {
        upload(picture, picture.decoding.get());
    } catch (const std::exception&) {
        picture.failed = true;
    }
}

}  // namespace

void drawStartPicture(std::string_view scene, const ImVec2& corner, const ImVec2& size, bool moving) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    for (StartPicture& picture : pictures()) {
        if (picture.scene != scene) continue;
        prepare(picture);
        if (!picture.texture) break;
        const int frame =
            moving ? static_cast<int>(std::fmod(ImGui::GetTime() * kFramesPerSecond, kFrames)) : 0;
        // Half a pixel inside, so that no neighbour shows.
        const float inset = 0.5f / (kFrames * kStartPictureWidth);
        const float left = static_cast<float>(frame) / kFrames;
        list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(picture.texture->name())),
                      corner, end, {left + inset, 0}, {left + 1.0f / kFrames - inset, 1});
        return;
    }
    list.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
}

void forgetStartPictures() {
    for (StartPicture& picture : pictures()) {
        if (picture.decoding.valid()) picture.decoding.wait();
        picture.decoding = {};
        picture.texture.reset();
    }
}

}  // namespace stereonav
