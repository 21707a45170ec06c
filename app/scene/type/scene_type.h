// A type of scene: its properties and functions.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/output_place.h"
#include "app/options/scene_options.h"
#include "app/options/scene_types.h"
#include "engine/base/progress.h"
#include "engine/scene/facts.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

class ShownMedium;  // app/scene/medium/shown_medium.h

struct SceneType {
    std::string_view noun;                       // noun for messages
    std::vector<std::string_view> builtIn = {};  // names of scenes that are not files
    // Returns whether an existing file or folder is of this type; asked in the order of sceneTypes(). Null:
    // the type has no files.
    bool (*owns)(const std::string& file) = nullptr;
    // Returns, as advice, where a folder without scenes has files of this type in folders below it; "" where
    // it has none. Null: subfolders are not searched.
    std::string (*below)(const std::string& folder) = nullptr;
    // Returns the types for the choice of options: the one as a surface and the one as a medium, where a
    // scene can be both.
    SceneSet (*optionsFor)(const std::string& scene) = nullptr;
    // Returns the files that a file of this type names. Null: it names none.
    std::vector<NamedPlace> (*filesOf)(const SceneOptions& options) = nullptr;
    // Returns facts from a file's headers by a bounded read. Null: nothing is known before loading. Throws
    // Error, Cancelled.
    Facts (*glance)(const std::string& file, Progress& progress) = nullptr;
    // Loads a scene whose rays are cast. Null: the type is shown as a medium only. Throws Error, Cancelled.
    std::unique_ptr<Scene> (*load)(const SceneOptions& options, SimdTarget simd,
                                   Progress& progress) = nullptr;
    // Sets views, flight and medium of `scene`, which has not begun. Throws Error, Cancelled.
    void (*makeMedium)(const SceneOptions& options, SimdTarget simd, Progress& progress,
                       ShownMedium& scene) = nullptr;
    bool hasGround = false, hasLine = false;  // ground to make meshes of; a line to fly along
};

}  // namespace stereonav
