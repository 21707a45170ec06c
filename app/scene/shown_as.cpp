#include "app/scene/shown_as.h"

#include <algorithm>

#include "app/scene/medium/medium_loading.h"
#include "app/scene/medium/options.h"
#include "app/scene/scene_type_table.h"
#include "engine/base/error.h"
#include "engine/frame/cast_frames.h"
#include "engine/medium/sweep/swept_frames.h"

namespace stereonav {
namespace {

bool isNothingElse(const std::string& scene) {
    return std::ranges::any_of(sceneTypes(), [&](const SceneType* type) {
        return !type->load && std::ranges::find(type->builtIn, scene) != type->builtIn.end();
    });
}

}  // namespace

const ShownAs& shownAs(const SceneOptions& options) {
    static const ShownAs cast{.bytesAPixel = &PixelBytes::cast,
                              .methods = CastFrames::allMethods(),
                              .check = [](const SceneOptions&) {},
                              .load = [](const SceneType& type, const SceneOptions& asked, SimdTarget simd,
                                         Progress& progress) { return type.load(asked, simd, progress); }};
    static const ShownAs swept{.swept = true,
                               .bytesAPixel = &PixelBytes::swept,
                               .lightBytes = 24e6,
                               .methods = kSweepMethods,
                               .ofMethods = " of making two eyes of a medium",
                               .check = checkMediumOptions,
                               .load = loadMediumScene};
    return !options.medium.medium.empty() || isNothingElse(options.scene) ? swept : cast;
}

std::optional<SceneSet> sceneTypeOf(const SceneOptions& options) {
    try {
        const SceneSet all = sceneTypeNamed(options.scene).optionsFor(options.scene);
        const SceneSet asked = shownAs(options).swept ? all & scene_type::kMedia : all & ~scene_type::kMedia;
        return asked != 0 ? asked : all;  // a mesh with --medium stays a mesh, which has no media
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace stereonav
