// The two ways to show a scene: rays are cast into it, or light is swept through it as a medium. The options
// choose one before anything is read; everything that depends on the choice is asked here.
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

struct SceneType;  // app/scene/type/scene_type.h

// Bytes that a command holds per pixel of one eye beside the scene, measured at 1500x1500 or 2400x2000 and
// rounded up. kRenderBytes: both eyes, and the composed picture while it is encoded (some formats take more:
// pictureBytes) or refined. kVideoBytes: the same without the codec (app/output/video_file.h), and its
// libraries. kCompareBytes: every method with its truths and the intermediate pictures of SSIM and
// Butteraugli. kInfoBytes: eyes that are measured and not composed. kViewBytes: a window's frames, its
// software renderer's textures and a picture that is saved (measured at 320x240, 1200x700 and 2400x1400; the
// shaders of all modes take 40 MB, half of which are the 20 MB that every program has).
struct PixelBytes {
    double cast = 0, swept = 0;  // for scenes whose rays are cast; for media
    double beside = 0;           // bytes for pictures of any size
};
constexpr PixelBytes kRenderBytes{60, 132}, kVideoBytes{80, 168, 24e6}, kCompareBytes{400, 736},
    kInfoBytes{48, 128}, kViewBytes{108, 160, 24e6}, kNoPicture{};

// Bytes per pixel while a picture of many rays per pixel is gathered.
constexpr PixelBytes kManyRaysBytes{80, 96};

struct ShownAs {
    // Whether light is swept through the scene; other light of the scene then has no effect.
    bool swept = false;
    double PixelBytes::*bytesAPixel = nullptr;
    double lightBytes = 0;  // bytes of light at its default size, for any picture
    // Methods of its FrameMaker, and their name in messages: "the methods of making ...".
    std::span<const std::string_view> methods;
    const char* ofMethods = "";
    // Checks everything about a medium that needs no scene. Throws Error.
    void (*check)(const SceneOptions& options) = nullptr;
    // Loads the scene. Throws Error, Cancelled.
    std::unique_ptr<Scene> (*load)(const SceneType& type, const SceneOptions& options, SimdTarget simd,
                                   Progress& progress) = nullptr;
};

// Returns the medium where the options ask for one or the scene can be nothing else, otherwise the cast
// scene.
const ShownAs& shownAs(const SceneOptions& options);

// Returns the type of scene that decides about options, one bit; empty where the name stands for no scene,
// which is reported when it is loaded.
std::optional<SceneSet> sceneTypeOf(const SceneOptions& options);

}  // namespace stereonav
