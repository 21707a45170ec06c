#include "app/options/scene_file_options.h"

#include <algorithm>
#include <array>
#include <set>

#include "app/options/option_table.h"
#include "engine/base/error.h"
#include "engine/text/toml_document.h"

namespace stereonav {
namespace {

std::string sceneIn(TomlDocument& document, const std::filesystem::path& toml) {
    constexpr std::array kBuiltIn{"terrain", "colon", "cloud", "wax"};
    std::string scene = document.rootText("scene");
    if (scene.ends_with(".toml"))
        throw Error(toml.string(), "",
                    "\"scene\": expected a study or a built-in scene, got another scene file",
                    "name what it shows");
    if (scene.empty() || std::find(kBuiltIn.begin(), kBuiltIn.end(), scene) != kBuiltIn.end()) return scene;
    return (toml.parent_path() / scene).string();
}

}  // namespace

SceneFileOptions readSceneFileOptions(const std::filesystem::path& toml) {
    TomlDocument document(toml);
    SceneFileOptions read;
    read.scene = sceneIn(document, toml);
    TomlSection section = document.section("options");
    std::set<std::string> keys;
    for (const Option& option : optionTable())
        if (option.inFile && keys.insert(option.key).second) {
            SceneFileOption found{option.key, section.texts(option.key), section.isFlag(option.key),
                                  section.line(option.key)};
            if (!found.texts.empty()) read.options.push_back(std::move(found));
        }
    if (read.scene.empty())
        document.finishSection("options");
    else
        document.finish();
    return read;
}

}  // namespace stereonav
