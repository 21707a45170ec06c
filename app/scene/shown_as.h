// The two ways in which a scene can be shown: rays are cast into it, or light is swept through it as a
// medium. The options choose one before anything is read; what then depends on it is asked here.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/options/scene_options.h"
#include "app/options/scene_types.h"
#include "engine/base/progress.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

struct SceneType;  // app/scene/scene_type.h

// Bytes that a command holds for each pixel of one eye beside the scene, measured at 1500x1500 or 2400x2000
// and rounded up: both eyes and the composed picture while it is encoded (some take more: pictureBytes) or
// refined; the same for a video without what its codec holds (app/output/video_file.h), and its libraries;
// every method with its truths and the intermediate pictures of SSIM and Butteraugli; eyes that are measured
// and not composed; a window's frames, its software renderer's textures and a picture that is saved (measured
// at 320x240, 1200x700 and 2400x1400; shaders of all modes take 40 MB, of which half is the 20 MB that every
// program has).
struct PixelBytes {
    double cast = 0, swept = 0;  // of scenes whose rays are cast; of media
    double beside = 0;           // bytes, of pictures of any size
};
constexpr PixelBytes kRenderBytes{60, 132}, kVideoBytes{80, 168, 24e6}, kCompareBytes{400, 736},
    kInfoBytes{48, 128}, kViewBytes{108, 160, 24e6}, kNoPicture{};

// More, where a picture of many rays a pixel is gathered.
constexpr PixelBytes kManyRaysBytes{80, 96};

struct ShownAs {
    // Light of its own goes through it: no other light of the scene has any effect.
    bool swept = false;
    double PixelBytes::*bytesAPixel = nullptr;
    double lightBytes = 0;  // beside any picture, of the size of light that is used where none is given
    // Of its FrameMaker, and how messages call them: "the methods of making ...".
    std::span<const std::string_view> methods;
    const char* ofMethods = "";
    // What can be checked before it is read, of a medium. Throws Error.
    void (*check)(const SceneOptions& options) = nullptr;
    // Throws Error, Cancelled.
    std::unique_ptr<Scene> (*load)(const SceneType& type, const SceneOptions& options, SimdTarget simd,
                                   Progress& progress) = nullptr;
};

// As a medium where the options name one, or a scene that is nothing else.
const ShownAs& shownAs(const SceneOptions& options);

// By which of the types of options the scene is, one bit; none where its name stands for no scene, which is
// said when it is loaded.
std::optional<SceneSet> sceneTypeOf(const SceneOptions& options);

}  // namespace stereonav
