#include "app/view/panel/start_pictures.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <mutex>
#include <span>

#include "app/view/beside_work.h"
#include "app/view/panel/panel_texture.h"
#include "engine/base/error.h"
#include "engine/image/image_file.h"

// Embeds a picture, as engine/display/interface_font.cpp does its font.
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
    std::optional<BesideWork<Plane<PackedColor>>> decoding = {};
    PanelTexture texture = {};
    bool failed = false;
};

std::array<StartPicture, 4>& pictures() {
    static std::array<StartPicture, 4> all{{{"terrain", {kBegin_terrain, kEnd_terrain}},
                                            {"colon", {kBegin_colon, kEnd_colon}},
                                            {"cloud", {kBegin_cloud, kEnd_cloud}},
                                            {"wax", {kBegin_wax, kEnd_wax}}}};
    return all;
}

// Decodes a picture; one that can not be decoded stays grey, and the page remains useful.
void prepare(StartPicture& picture) {
    if (picture.texture.any() || picture.failed) return;
    if (!picture.decoding)
        picture.decoding.emplace().start(
            [file = picture.file](Progress&) {
                static std::mutex oneAfterTheOther;  // one helper thread is enough for all
                const std::lock_guard lock(oneAfterTheOther);
                return decodeColorImage(file, "the start page", "");
            },
            [] {});
    try {
        if (const auto decoded = picture.decoding->take()) picture.texture.set(*decoded, true);
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
        if (!picture.texture.any()) break;
        const int frame =
            moving ? static_cast<int>(std::fmod(ImGui::GetTime() * kFramesPerSecond, kFrames)) : 0;
        // Half a pixel is left out at the sides, so that no neighbouring frame shows.
        const float inset = 0.5f / (kFrames * kStartPictureWidth);
        const float left = static_cast<float>(frame) / kFrames;
        list.AddImage(picture.texture.id(), corner, end, {left + inset, 0},
                      {left + 1.0f / kFrames - inset, 1});
        return;
    }
    list.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
}

void forgetStartPictures() {
    for (StartPicture& picture : pictures()) {
        picture.decoding.reset();  // waits for its end
        picture.texture.reset();
    }
}

}  // namespace stereonav
