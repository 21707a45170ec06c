#include "app/scene/medium/medium_loading.h"

#include "app/scene/medium/options.h"
#include "app/scene/medium/shown_medium.h"
#include "app/scene/medium/tone.h"

namespace stereonav {
std::unique_ptr<Scene> loadMediumScene(const SceneType& type, const SceneOptions& options, SimdTarget simd,
                                       Progress& progress) {
    constexpr const char* kMaking = "making the medium";
    progress.report(0, kMaking);
    auto scene = std::make_unique<ShownMedium>();
    Progress loading(progress, 0, 0.9);
    type.makeMedium(options, simd, loading, *scene);
    applyMediumOptions(options.medium, scene->medium());
    if (options.chosenLook) scene->medium().tone = toneOf(*scene, scene->medium(), simd);
    scene->begin(simd);
    progress.report(1, kMaking);
    return scene;
}

}  // namespace stereonav
