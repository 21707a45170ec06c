// Options in a scene file: under [options] the options of the scene and of its look have the same keys as on
// the command line. `scene = "study.nrrd"` in its first lines makes it the file of a study or medium; without
// it the file is a terrain's (terrain/read/scene_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereonav {

struct SceneFileOption {
    std::string key;
    std::vector<std::string> texts;  // values in their order; several where the option is repeated
    bool isFlag = false;             // whether the file has true or false instead
    int line = 0;
};

struct SceneFileOptions {
    std::string scene;  // path with its folder, or a built-in scene's name; "": the file is a terrain's
    std::vector<SceneFileOption> options;
};

// Reads the options. Throws Error for invalid TOML, and for all unknown keys together, each with its line and
// the nearest known key.
SceneFileOptions readSceneFileOptions(const std::filesystem::path& toml);

}  // namespace stereonav
