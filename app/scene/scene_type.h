// The types of scenes that there are: what is theirs, and what the program makes of it. A new type is a
// SceneType in a file of its own and a line in scene_type.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/output_place.h"
#include "app/options/scene_types.h"
#include "engine/base/progress.h"
#include "engine/scene/facts.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

class ShownMedium;  // app/scene/shown_medium.h

struct SceneType {
    std::string_view noun;                       // as messages call one
    std::vector<std::string_view> builtIn = {};  // names that are no files
    // Whether a file or folder, which is there, is its own; asked in the order of sceneTypes().
    bool (*owns)(const std::string& file) = nullptr;  // null: none is
    // Where its own lies below a folder that holds nothing itself, as advice; "" where it does not. Null: it
    // is not looked for.
    std::string (*below)(const std::string& folder) = nullptr;
    // By which options of it are told, however it is shown: cast and as a medium, where it can be both.
    SceneSet (*optionsFor)(const std::string& scene) = nullptr;
    // Files that a file of this type names. Null: none.
    std::vector<NamedPlace> (*filesOf)(const SceneOptions& options) = nullptr;
    // What a file of it is, by its headers: a bounded read of what is there. Null: nothing is known before it
    // is loaded. Throws Error, Cancelled.
    Facts (*glance)(const std::string& file, Progress& progress) = nullptr;
    // Whose rays are cast. Null: it is shown as a medium only. Throws Error, Cancelled.
    std::unique_ptr<Scene> (*load)(const SceneOptions& options, SimdTarget simd,
                                   Progress& progress) = nullptr;
    // Views, flight and medium into `scene`, which has not begun. Throws Error, Cancelled.
    void (*makeMedium)(const SceneOptions& options, SimdTarget simd, Progress& progress,
                       ShownMedium& scene) = nullptr;
    bool hasGround = false, hasLine = false;  // for meshes of it; for the way through it
};

const SceneType& meshType();
const SceneType& terrainType();
const SceneType& volumeType();
const SceneType& builtInMediumType();

std::span<const SceneType* const> sceneTypes();

// Whether it is the name of one that is no file, whatever lies in the present folder.
bool isBuiltIn(const std::string& name);

// That which a name stands for. Throws Error for a name of nothing, with what can be named.
const SceneType& sceneTypeNamed(const std::string& name);

}  // namespace stereonav
